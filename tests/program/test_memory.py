#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Little memory: a program whose address space is limited ends with an error that names what was to be made, and where it comes
from the command file also its place. Usage: test_memory.py TRIBO SOURCE_DIR"""

import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

tribo, source = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
environment = dict(os.environ, OMP_NUM_THREADS="1")
disks = source / "tests/input/legacy_disks.xml"
failed = refused = done = 0

HEAD = """<JANFEAInput version='3'><Header><Analysis>ANALYSIS</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
<MPMHeader><GIMP type='uGIMP'/><MaxTime>2e-2</MaxTime><ArchiveTime>1e-2</ArchiveTime></MPMHeader>
"""
RUBBER = "<Material Type='1' Name='rubber'><rho>1000</rho><E>1e6</E><nu>0.3</nu></Material></JANFEAInput>"
BODY = "<MaterialPoints><Body matname='rubber'><Rect xmin='1' xmax='9' ymin='1' ymax='3'/></Body></MaterialPoints>\n"


def grid(nx, ny):
    return f"<Mesh><Grid xmin='0' xmax='10' ymin='0' ymax='4'><Horiz nx='{nx}'/><Vert ny='{ny}'/></Grid></Mesh>\n"


FLAT = HEAD.replace("ANALYSIS", "10")
MODELS = {  # what the limit is too small for, and the line of its place
    "particles": (FLAT + grid(1600, 640) + BODY + RUBBER, 4),
    "grid": (FLAT + grid(40000, 16000) + BODY.replace("xmax='9'", "xmax='1.001'").replace("ymax='3'", "ymax='1.001'") + RUBBER, 3),
    "table": (FLAT + grid(20, 8) + BODY.replace("<Rect", "<InitialStress file='large.csv'/><Rect") + RUBBER, 4),
    "picture": (FLAT + grid(20, 8) + "<MaterialPoints><BMP name='large.bmp' width='4' height='3'><Origin x='2' y='0.5'/>"
                "<Intensity matname='rubber' imin='0' imax='100'/></BMP></MaterialPoints>\n" + RUBBER, 4)}


def attempt(megabytes, words, line=0):
    """One trial; `line` is the place that the message must name, if there is one."""
    global failed, refused, done
    limit = megabytes << 20
    run = subprocess.run([str(w) for w in (tribo, *words)], capture_output=True, text=True, env=environment, check=False, timeout=100,
                         preexec_fn=lambda: (resource.setrlimit(resource.RLIMIT_AS, (limit, limit)), resource.setrlimit(resource.RLIMIT_CORE, (0, 0))))
    if run.returncode == 127:  # not even the libraries
        return
    good = run.returncode == 0
    if run.returncode in (3, 5):
        good = re.search("not enough memory for .|needs? .* GB|need .* GB", run.stderr) is not None
        if line:
            good = good and re.search(rf"\.xml:{line}:\d+: error: ", run.stderr) is not None
    done, refused = done + (run.returncode == 0), refused + (good and run.returncode != 0)
    if not good or "internal error" in run.stderr:
        failed += 1
        print(f"FAILED: {megabytes} MB, {' '.join(map(str, words))}: {run.returncode}: {run.stderr[:400]}")


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    with open("large.csv", "wb") as table:
        table.write(b"x,y,xx\n"), table.truncate(300 << 20)
    with open("large.bmp", "wb") as picture:
        picture.write(b"BM"), picture.truncate(300 << 20)
    subprocess.run([tribo, "run", "--quiet", "-o", "out", disks], check=True, env=environment)
    subprocess.run([tribo, "run", "--quiet", "--max-wall", "0.1", "-o", "stopped", disks], check=False, env=environment)
    for name, (text, line) in MODELS.items():
        pathlib.Path(name + ".xml").write_text(text)
        for megabytes in (80, 200):
            attempt(megabytes, ["check", name + ".xml"], line)
            attempt(megabytes, ["run", "--quiet", "--overwrite", "-o", "small", name + ".xml"], line)
    for megabytes in (52, 54, 56, 60, 64, 70, 90):
        attempt(megabytes, ["run", "--quiet", "--overwrite", "-o", "small", disks])
        attempt(megabytes, ["resume", "--quiet", "stopped"])
        attempt(megabytes, ["report", "out", "-o", "report.html"])
        attempt(megabytes, ["render", "out", "--width", "4000", "--time", "0"])
        attempt(megabytes, ["check", source / "input/examples/brick_wall.xml"])
        attempt(megabytes, ["convert", disks])
print(f"{done} had enough memory, {refused} were refused with a reason, {failed} failed")
sys.exit(1 if failed or not refused or not done else 0)
