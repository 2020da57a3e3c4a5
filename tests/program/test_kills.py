#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Runs that are killed or stopped at random moments continue to the same bits, and stops are prompt.

Usage: test_kills.py TRIBO SOURCE_DIR [--kills N] [--stops N] [--models NAME ...] [--seed N] [--seconds N]

Without options the short form for ctest: three models, a few kills and stops each. `--kills 10` kills each of all
models ten times. A kill is SIGKILL, which the program cannot notice; a stop is SIGINT, SIGTERM or SIGHUP, after which
it must end within a second with the exit code 6 (or 0, if it has just finished).
"""

import argparse
import filecmp
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

# Name, command file, share of its duration that is run, variables, replaced texts
MODELS = [
    ("rolling", "verification/rolling/case.xml", 0.1, {"h": "0.05"}),                  # cached faces, impulses on faces
    ("wall", "input/examples/brick_wall.xml", 0.02, {}),                               # rigid blocks
    ("stretching", "verification/stretching/case.xml", 0.25, {}),                      # particles split
    ("disks", "tests/input/legacy_disks.xml", 1.0, {}),                                # contact at nodes
    ("capstan", "verification/capstan/case.xml", 0.02, {}),                            # cached faces
    ("sphere", "verification/sphere/case.xml", 0.1, {"h": "0.1"}),                     # cached faces in space
    ("rubbing", "verification/rubbing/case.xml", 0.05, {}),                            # heat of friction
    ("flux", "verification/conduction/contact.xml", 0.2, {}),                          # heat across contact
    ("growth", "verification/fracture/growth.xml", 0.004, {}),                           # crack that grows
    ("crack", "verification/crack_friction/case.xml", 0.02, {}),                        # crack with friction
    ("joints", "verification/joint_shear/case.xml", 0.01, {}),                          # crack with joints
    ("patch", "verification/joint_patch/case.xml", 0.05, {}),                           # joints between bodies
    ("bed", "verification/blocks_on_matter/bed.xml", 0.1, {}),                         # blocks in the grid
    ("stick_slip", "verification/blocks_stick_slip/case.xml", 0.2, {}),                # blocks with joints
    ("toppling", "input/examples/toppling.xml", 0.1, {}),                              # blocks that find contacts
    ("cutting", "input/examples/cutting.fmcmd", 0.1, {"cell": "0.05"}),                # rigid tool, plasticity
    ("dam", "input/examples/dam_break.fmcmd", 0.03, {}),                                # liquid
    ("column", "input/examples/granular_column.fmcmd", 0.02, {}),                      # sand
    ("ring", "input/examples/rubber_ring.fmcmd", 0.02, {}),                            # CPDI
    ("taylor", "input/examples/taylor_bar.fmcmd", 0.03, {}),                            # impact
    ("seam", "verification/seam/case.xml", 0.1, {}),                                   # joints of a seam
    ("incline", "input/examples/block_on_incline.fmcmd", 0.03, {}),                     # sliding
]
SHORT = ("rolling", "wall", "disks")
FRAMES = 8
NOT_RESULTS = {"provenance.json", "tribo-run.json", "tribo-run.lock", "tribo-model.json", "tribo-model.xml"}


class Failure(Exception):
    pass


def deck(tribo, source, work, path, share, settings):
    """The command file as XML, with a part of its duration and some files of results and checkpoints."""
    text = subprocess.run([tribo, "convert", *(f"--set={k}={v}" for k, v in settings.items()), source / path],
                          capture_output=True, text=True, check=True).stdout
    found = re.search(r"<MaxTime([^>]*)>\s*([0-9.eE+-]+)\s*</MaxTime>", text)
    end = float(found.group(2)) * share
    text = text.replace(found.group(0), f"<MaxTime{found.group(1)}>{end!r}</MaxTime>")
    text = re.sub(r"<ArchiveTime([^>]*)>[^<]*</ArchiveTime>", f"<ArchiveTime\\1>{end / FRAMES!r}</ArchiveTime>", text)
    text = re.sub(r"<GlobalArchiveTime([^>]*)>[^<]*</GlobalArchiveTime>",
                  f"<GlobalArchiveTime\\1>{end / 40!r}</GlobalArchiveTime>", text)
    file = work / "model.xml"
    file.write_text(text)
    return file


def results(folder):
    return {p.relative_to(folder) for p in folder.rglob("*")
            if p.is_file() and p.name not in NOT_RESULTS and not p.name.startswith(".")}


def compare(one, other, what):
    if results(one) != results(other):
        raise Failure(f"{what}: other files: {sorted(map(str, results(one) ^ results(other)))}")
    for name in results(one):
        if not filecmp.cmp(one / name, other / name, shallow=False):
            raise Failure(f"{what}: '{name}' differs")


class Model:
    def __init__(self, tribo, source, work, spec):
        self.tribo, self.work = tribo, work
        self.name, path, share, settings = spec
        self.deck = deck(tribo, source, work, path, share, settings)
        self.whole, self.folder = work / "whole", work / "run"
        begin = time.monotonic()
        done = subprocess.run([tribo, "run", "--quiet", "-o", self.whole, self.deck], capture_output=True, text=True)
        if done.returncode != 0:
            raise Failure(f"{self.name}: the uninterrupted run ended with {done.returncode}: {done.stderr}")
        self.seconds = time.monotonic() - begin

    def start(self):
        """Starts the run, or continues it from its last checkpoint."""
        if (self.folder / "checkpoint.bin").exists():
            words = ["resume", "--quiet", self.folder]
        else:
            words = ["run", "--quiet", "--overwrite", "-o", self.folder, self.deck]
        return subprocess.Popen([self.tribo, *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def finish(self, process):
        _, errors = process.communicate()
        if process.returncode != 0:
            raise Failure(f"{self.name}: ended with {process.returncode}: {errors}")

    def clear(self):
        subprocess.run(["rm", "-rf", self.folder], check=True)

    def kill(self, count, limit):
        """Kills the run `count` times at random moments, then lets it end. Returns the number of kills."""
        killed = 0
        while killed < count and time.monotonic() < limit:
            self.clear()
            while True:
                process = self.start()
                try:
                    if killed >= count:
                        raise subprocess.TimeoutExpired("", 0)
                    process.wait(timeout=random.uniform(0.02, 0.7 * self.seconds))
                except subprocess.TimeoutExpired:
                    if killed < count:
                        process.kill()
                        process.communicate()
                        killed += 1
                        continue
                self.finish(process)
                break
            compare(self.whole, self.folder, f"{self.name}, killed")
        return killed

    def running(self, process):
        """Waits until the process has begun to compute; False if it ends before."""
        while process.poll() is None:
            try:
                record = json.loads((self.folder / "provenance.json").read_text())
                if record.get("process") == process.pid and record["status"] == "running":
                    return True
            except (OSError, ValueError):
                pass
            time.sleep(0.005)
        return False

    def stop(self, count):
        """Stops the run `count` times, and resumes it. Returns the longest time that a stop took, and their number."""
        self.clear()
        longest, stopped = 0.0, 0
        for k in range(count):
            process = self.start()
            if self.running(process):
                time.sleep(random.uniform(0, 0.4 * self.seconds))
            asked = time.monotonic()
            name = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)[k % 3]
            process.send_signal(name)
            _, errors = process.communicate()
            took = time.monotonic() - asked
            if process.returncode == 0:
                compare(self.whole, self.folder, f"{self.name}, stopped")
                self.clear()
                continue
            if process.returncode != 6:
                raise Failure(f"{self.name}: {name.name} ended it with {process.returncode}: {errors}")
            if took > 1.0:
                raise Failure(f"{self.name}: {name.name} took {took:.2f} s")
            if json.loads((self.folder / "provenance.json").read_text())["status"] != "stopped":
                raise Failure(f"{self.name}: the record does not say that it was stopped")
            longest, stopped = max(longest, took), stopped + 1
        if self.folder.exists():
            self.finish(self.start())
            compare(self.whole, self.folder, f"{self.name}, stopped")
        return longest, stopped


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tribo", type=pathlib.Path)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=0, help="kills of each model")
    parser.add_argument("--stops", type=int, default=3, help="stops of each model")
    parser.add_argument("--models", nargs="+", default=[])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=1e9, help="no further kills after this time")
    a = parser.parse_args()
    random.seed(a.seed)
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    names = a.models or ([m[0] for m in MODELS] if a.kills else SHORT)
    limit = time.monotonic() + a.seconds
    kills = stops = failures = 0
    longest = 0.0
    for spec in MODELS:
        if spec[0] not in names:
            continue
        with tempfile.TemporaryDirectory() as work:
            try:
                model = Model(a.tribo.resolve(), a.source.resolve(), pathlib.Path(work), spec)
                took, stopped = model.stop(a.stops)
                killed = model.kill(a.kills or 3, limit)
                print(f"{model.name}: a run of {model.seconds:.1f} s, {killed} kills, {stopped} stops, "
                      f"the longest {took:.2f} s", flush=True)
                kills, stops, longest = kills + killed, stops + stopped, max(longest, took)
            except Failure as failure:
                print(f"FAILED: {failure}", flush=True)
                failures += 1
    print(f"{kills} kills and {stops} stops of {len(names)} models, the longest stop {longest:.2f} s: "
          f"{failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
