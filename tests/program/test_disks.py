#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Folders of other users, read-only folders and full disks: every command ends with code 5 and says why, and nothing that was
there is lost. Usage: test_disks.py TRIBO SOURCE_DIR

Needs root: other users are taken with setpriv, small disks are tmpfs. What is not possible is left out, and named."""

import contextlib
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import checks

tribo, source = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
environment = dict(os.environ, OMP_NUM_THREADS="1")
check, left_out = checks.Checks(), []
NOT_RESULTS = {"provenance.json", "tribo-run.json", "tribo-run.lock", "tribo-model.json", "tribo-model.xml"}


def call(*words, user=None, cwd=None):
    """The exit code of a command and its errors; `user` is a number."""
    other = ["setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups"] if user else []
    done = subprocess.run([*other, program, *map(str, words)], capture_output=True, text=True, env=environment, cwd=cwd or work, check=False)
    return done.returncode, done.stderr


def contents(folder):
    """Names, contents, owners and times of everything in a folder."""
    out = {}
    for path in sorted(folder.rglob("*")):
        status = path.lstat()
        data = hashlib.sha1(path.read_bytes()).hexdigest() if path.is_file() else ""
        time = status.st_mtime_ns if path.is_file() else 0  # temporary files come and go in folders
        out[str(path.relative_to(folder))] = (time, status.st_mode, status.st_uid, data)
    return out


def refused(what, words, reasons, kept, **options):
    """The command ends with code 5, names a reason, and leaves everything in the folder `kept` as it was."""
    before = contents(kept)
    code, errors = call(*words, **options)
    check(code == 5, f"{what}: '{' '.join(map(str, words))}' ended with {code}, not 5: {errors}")
    check(re.search(reasons, errors, re.I), f"{what}: the message does not say why: {errors}")
    check("internal error" not in errors, f"{what}: {errors}")
    after = contents(kept)
    check(after == before, f"{what}: '{words[0]}' changed {sorted(k for k in before.keys() | after.keys() if before.get(k) != after.get(k))}")


@contextlib.contextmanager
def disk(size):
    """A small disk, or None if none can be mounted."""
    place = work / "disk"
    place.mkdir(exist_ok=True)
    mounted = shutil.which("mount") and subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", place], capture_output=True, check=False).returncode == 0
    if not mounted and "full disks" not in left_out:
        left_out.append("full disks")
    try:
        yield place if mounted else None
    finally:
        if mounted:
            subprocess.run(["umount", place], check=True)


def remount(place, options):
    subprocess.run(["mount", "-o", f"remount,{options}", place], check=True)


def fill(place, leave=0):
    """Fills a disk but for some bytes."""
    with contextlib.suppress(OSError), open(place / "filler", "wb", buffering=0) as out:
        while True:
            out.write(bytes(4096))
    os.truncate(place / "filler", max(0, (place / "filler").stat().st_size - leave))


def results(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*"))
            if p.is_file() and p.name not in NOT_RESULTS and p.name not in ("report.html", "filler") and "pictures" not in p.parts}


def writers(folder, new):
    """Every command that writes: into the folder of a run, and a new file."""
    return {"run": ["run", "--quiet", "-o", new / "new.out", deck], "run --overwrite": ["run", "--quiet", "--overwrite", "-o", folder, deck],
            "resume": ["resume", "--quiet", folder], "render": ["render", folder, "--width", "200", "--time", "0", "-o", new / "pictures"],
            "report": ["report", folder, "-o", new / "report.html"],
            "convert": ["convert", deck, "--overwrite", "-o", new / "model.xml"],
            "drive": ["drive", triaxial, "--overwrite", "-o", new / "triaxial.csv"]}


def stopped_run(folder):
    """A run with some results and a checkpoint, which is not finished."""
    code, errors = call("run", "--quiet", "--max-wall", "0.05", "-o", folder, deck)
    check(code == 6, f"the run was not stopped: {code}, {errors}")


def other_users():
    if os.geteuid() != 0 or not shutil.which("setpriv"):
        left_out.append("other users (needs root and setpriv)")
        return
    reasons = "permission|not permitted"
    mine = work / "mine"
    mine.mkdir(mode=0o755)
    stopped_run(mine / "out")
    for name, words in writers(mine / "out", mine).items():
        refused(f"the folder of another user, {name}", words, reasons, mine, user=65534)
    # The folder may be written by all, but the files are of one
    for path in (mine, mine / "out", mine / "out/particles"):
        path.chmod(0o777)
    refused("the files of another user, run", ["run", "--quiet", "-o", mine / "out", deck], "already holds a run", mine, user=65534)
    for name in ("run --overwrite", "resume"):
        refused(f"the files of another user, {name}", writers(mine / "out", mine)[name], reasons, mine, user=65534)
    mine.chmod(0o1777)  # the sticky bit: files of others cannot be removed
    (mine / "model.xml").write_text("mine")
    refused("a file of another user, convert", writers(mine / "out", mine)["convert"], reasons, mine, user=65534)
    check((mine / "model.xml").read_text() == "mine", "the file of another user is there")
    # A folder without the permission to write is the same for its owner
    own = work / "own"
    own.mkdir()
    os.chown(own, 65534, 65534)
    own.chmod(0o555)
    for name, words in writers(mine / "out", own).items():
        if name in ("run", "convert", "drive"):
            refused(f"a read-only folder, {name}", words, reasons, own, user=65534)
    # Nor may a command file be read that is secret
    secret = work / "secret.xml"
    shutil.copy(deck, secret)
    secret.chmod(0o600)
    refused("a secret command file", ["run", "--quiet", "-o", work / "x.out", secret], "no permission to read", mine, user=65534)


def read_only_disk():
    with disk("8m") as place:
        if not place:
            return
        stopped_run(place / "out")
        remount(place, "ro")
        for name, words in writers(place / "out", place).items():
            refused(f"a read-only disk, {name}", words, "read-only", place)
        remount(place, "rw")
        code, errors = call("resume", "--quiet", place / "out")
        check(code == 0 and results(place / "out") == whole, f"a run continues once it can write: {code} {errors}")


def full_disk():
    reasons = "no space left"
    with disk("8m") as place:
        if not place:
            return
        stopped_run(place / "out")
        (place / "model.xml").write_text("mine")
        check(call("report", place / "out", "-o", place / "report.html")[0] == 0, "a report")
        check(call("render", place / "out", "--width", "200", "--time", "0", "-o", place / "pictures")[0] == 0, "a picture")
        for leave in (0, 4096, 12288):  # the second and third leave room for the first files only
            fill(place, leave)
            for name in ("render", "report", "convert", "drive"):
                if leave == 0 or name == "report" or (name == "render" and leave < 12288):
                    refused(f"{leave} bytes left, {name}", writers(place / "out", place)[name], reasons, place)
            (place / "filler").unlink()
        fill(place)
        before = results(place / "out")
        code, errors = call("run", "--quiet", "-o", place / "new.out", deck)
        check(code == 5 and re.search(reasons, errors, re.I), f"a full disk, run: {code} {errors}")
        check(results(place / "out") == before, "a run on a full disk leaves other runs alone")
        for again in range(2):
            code, errors = call("resume", "--quiet", place / "out")
            check(code == 5 and re.search(reasons, errors, re.I), f"a full disk, resume: {code} {errors}")
        (place / "filler").unlink()
        code, errors = call("resume", "--quiet", place / "out")
        check(code == 0 and results(place / "out") == whole, f"a run continues once there is room: {code} {errors}")


def disk_that_fills():
    """The disk fills while a run writes, at different places; the run continues to the same bits."""
    for size in ("128k", "256k", "400k", "600k"):
        with disk(size) as place:
            if not place:
                return
            code, errors = call("run", "--quiet", "-o", place / "out", deck)
            check(code == 5 and re.search("no space left", errors, re.I), f"a disk of {size}: {code} {errors}")
            usable = (place / "out/checkpoint.bin").exists()
            check(("tribo resume " if usable else "run --overwrite") in errors, f"a disk of {size}: what to do is not told: {errors}")
            status = (place / "out/provenance.json").read_text() if (place / "out/provenance.json").exists() else '"failed"'
            check('"failed"' in status, f"a disk of {size}: the record does not say failed")
            remount(place, "size=64m")
            again = ["resume", "--quiet", place / "out"] if usable else ["run", "--quiet", "--overwrite", "-o", place / "out", deck]
            code, errors = call(*again)
            check(code == 0, f"a disk of {size}, with room again: {code} {errors}")
            check(results(place / "out") == whole, f"a disk of {size}: other results after it had room again")


def order_on_disk():
    """All that is older than a checkpoint is flushed to the disk before the checkpoint gets its name."""
    trace = work / "trace"
    if not shutil.which("strace") or subprocess.run(["strace", "-o", "/dev/null", "true"], capture_output=True, check=False).returncode:
        left_out.append("the order on the disk (needs strace)")
        return
    done = subprocess.run(["strace", "-f", "-y", "-e", "trace=fsync,write,rename", "-o", trace, program, "run", "--quiet", "-o", work / "traced", deck],
                          env=environment, cwd=work, capture_output=True, check=False)
    check(done.returncode == 0, "the traced run")
    dirty, checkpoints = set(), 0
    for line in trace.read_text(errors="replace").splitlines():
        found = re.search(r"(write|fsync)\(\d+<(.*?)>", line)
        renamed = re.search(r'rename\("([^"]*)", "([^"]*)"\)', line)
        if found and "/traced" in found[2]:
            (dirty.add if found[1] == "write" else dirty.discard)(found[2])
        elif renamed and renamed[2].endswith("checkpoint.bin"):
            checkpoints += 1
            late = [d for d in dirty if not d.endswith((".json", ".lock"))]
            check(not late, f"a checkpoint is on the disk before {late}")
            dirty.add(str(pathlib.Path(renamed[2]).parent))
        elif renamed and not renamed[2].endswith(".json"):
            dirty.add(str(pathlib.Path(renamed[2]).parent))
    check(checkpoints > 1, "the traced run writes checkpoints")


with tempfile.TemporaryDirectory() as folder:
    work = pathlib.Path(folder)
    work.chmod(0o755)
    program, deck, triaxial = work / "tribo", work / "disks.xml", work / "triaxial.xml"
    shutil.copy(tribo, program)
    shutil.copy(source / "tests/input/legacy_disks.xml", deck)
    shutil.copy(source / "input/examples/triaxial.xml", triaxial)
    for readable in (program, deck, triaxial):
        readable.chmod(0o755)
    check(call("run", "--quiet", "-o", work / "whole", deck)[0] == 0, "the whole run")
    whole = results(work / "whole")
    for part in (other_users, read_only_disk, full_disk, disk_that_fills, order_on_disk):
        part()
print(f"{check.passed} passed, 0 failed" + "".join(f"; left out: {what}" for what in left_out))
