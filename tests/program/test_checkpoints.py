#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Checkpoints with right check sums and numbers that are not possible are refused with code 5 and a message, and the files of the
run stay as they are. Usage: test_checkpoints.py TRIBO SOURCE_DIR"""

import math
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

tribo, source = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
environment = dict(os.environ, OMP_NUM_THREADS="1")
BIG = 1 << 40
# Model, seconds it runs, and per entry the numbers that are put into it
MODELS = {
    "tests/input/legacy_disks.xml": (0.1, {
        "dimension": (3,), "run.archive": (-1,), "run.dt": (math.nan, -1.0), "stepper.system.step": (-5,), "stepper.system.time": (-1.0, math.inf),
        "stepper.system.body0.particles.position_x": (math.nan, math.inf, 1e300, -1e6), "stepper.system.body0.particles.mass": (-1.0, math.nan),
        "stepper.system.body0.particles.volume": (-1.0,), "stepper.system.body0.bins.list.end": (-1, BIG, 3),
        "stepper.system.body0.bins.list.block": (-1, BIG), "stepper.system.sorted": (7,)}),
    "verification/joint_patch/case.xml": (0.2, {
        "stepper.system.joints0.x": (math.nan, 1e300), "stepper.system.joints0.joints.area": (-1.0, math.nan),
        "stepper.system.joints0.joints.Fn": (1e300,), "stepper.system.joints0.joints.state": (-3, BIG),
        "stepper.system.joints0.joints.kn": (-1.0,), "stepper.system.joints0.joints.slips": (2,),
        "stepper.system.joints0.axes.n": (5.0, math.nan), "stepper.system.joints0.mass1": (-7.0,)}),
    "verification/joint_shear/case.xml": (0.2, {
        "stepper.system.crack0.pieces": (-1, BIG, 100000), "stepper.system.crack0.points": (-1, BIG), "stepper.system.crack0.x": (1e300, math.nan),
        "stepper.system.crack0.drawn_points": (BIG,), "stepper.system.joints0.joints.gap": (math.inf, -1e200)}),
    "verification/fracture/growth.xml": (0.3, {"stepper.system.crack0.tips.point": (-1, BIG), "stepper.system.crack0.tips.body": (BIG,)}),
    "verification/rolling/case.xml": (0.3, {
        "stepper.kept.faces.faces.count_a": (-1, BIG, 1 << 30), "stepper.kept.faces.particles": (-1, BIG, 1 << 30)}),
    "input/examples/brick_wall.xml": (0.3, {
        "blocks.motion.x": (math.nan, 1e200), "blocks.motion.v": (1e200,), "blocks.motion.R": (3.0,), "blocks.joints.area": (-1.0,),
        "blocks.contacts.axes.n": (9.0,), "blocks.step": (-1,)})}


def entries(data):
    at, out = data.index(b"\n") + 1, {}
    while data[at]:
        name, size = struct.unpack_from("<QQ", data, at + 1)
        begin = at + 17
        out[data[begin:begin + name].decode()] = (data[at:at + 1], bytearray(data[begin + name:begin + name + size]))
        at = begin + name + size + 4
    return out


def written(parts):
    out = b"Tribo checkpoint 2\n"
    for name, (kind, content) in parts.items():
        key = name.encode()
        out += kind + struct.pack("<QQ", len(key), len(content)) + key + bytes(content) + struct.pack("<I", zlib.crc32(key + bytes(content)))
    return out + b"\0"


tried = failed = 0
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for number, (path, (seconds, wrong)) in enumerate(MODELS.items()):
        out = pathlib.Path(f"out{number}")
        checkpoint = out / "checkpoint.bin"
        words = ["run", "--quiet", "-o", out, source / path]
        for _ in range(8):  # until it has begun
            subprocess.run([tribo, *words, "--max-wall", str(seconds)], env=environment, check=False, capture_output=True)
            sound, words, seconds = checkpoint.read_bytes(), ["resume", "--quiet", out], 1.5 * seconds
            if all(len(entries(sound).get(name, (b"", b""))[1]) >= 8 for name in wrong):
                break
        history = (out / "history.csv").read_bytes()
        if written(entries(sound)) != sound:
            sys.exit("FAILED: a checkpoint that is written again is another one")
        for name, values in wrong.items():
            kind, content = entries(sound).get(name, (b"", b""))
            if len(content) < 8:
                print(f"FAILED: {path} has no entry {name}: {[n for n in entries(sound) if n.startswith(name[:18])][:40]}")
                failed += 1
                continue
            # A position is checked in another way if the next step sorts the particles into bins
            for value, unsorted in [(value, False) for value in values] + [(value, True) for value in values if "position" in name]:
                parts = entries(sound)
                if unsorted:
                    struct.pack_into("<q", parts["stepper.system.sorted"][1], 0, 0)
                struct.pack_into("<q" if kind == b"i" else "<d", parts[name][1], 0, value)
                checkpoint.write_bytes(written(parts))
                done = subprocess.run([tribo, "resume", "--quiet", "--max-wall", "0.5", out], env=environment, check=False, capture_output=True, text=True, timeout=60)
                tried += 1
                if done.returncode != 5 or not re.search("checkpoint", done.stderr) or (out / "history.csv").read_bytes() != history:
                    print(f"FAILED: {path}: {name} = {value}: {done.returncode}: {done.stderr[:300]}")
                    failed += 1
                    (out / "history.csv").write_bytes(history)
                checkpoint.write_bytes(sound)
print(f"{tried} impossible numbers, {failed} failed")
sys.exit(1 if failed else 0)
