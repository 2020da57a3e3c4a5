#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Damaged inputs for every reader of the program: command files, scripts, tables, pictures, surfaces, results, checkpoints.
None may end by a signal or an internal error, take longer than ten seconds, or be accepted where a word that is required is
missing or a number is not possible. Usage: bad_inputs.py TRIBO SOURCE_DIR [COUNT [SEED]]

For a program that was built with AddressSanitizer, set ASAN_OPTIONS=detect_leaks=0; it may take four times as long."""

import os
import random
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

tribo, source = (os.path.abspath(a) for a in sys.argv[1:3])
count = int(sys.argv[3]) if len(sys.argv) > 3 else 120
rng = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
environment = dict(os.environ, OMP_NUM_THREADS="1")
sanitized = "ASAN_OPTIONS" in os.environ
most_seconds = 40 if sanitized else 10
numbers = [b"nan", b"inf", b"-inf", b"1e308", b"-1e308", b"1e-308", b"0", b"-1", b"1e15", b"99999999999", b"", b"1e400", b"0x10", b"1,5"]

flat = """<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
<MPMHeader><GIMP type='uGIMP'/><TimeStep>1e-3</TimeStep><MaxTime>2e-2</MaxTime><ArchiveTime>1e-2</ArchiveTime></MPMHeader>
<Mesh><Grid xmin='0' xmax='10' ymin='0' ymax='4'><Horiz nx='20'/><Vert ny='8'/></Grid></Mesh>
<MaterialPoints>BODIES</MaterialPoints>CRACKS
<Material Type='1' Name='rubber'><rho>1000</rho><E>1e6</E><nu>0.3</nu></Material>
<GridBCs><BCShape><Rect xmin='0' xmax='1' ymin='0' ymax='4'/><DisBC dir='1' style='1' vel='0'/></BCShape></GridBCs>
</JANFEAInput>
"""
plain = flat.replace("BODIES", "<Body matname='rubber'><Rect xmin='2' xmax='5' ymin='1' ymax='3'/></Body>").replace("CRACKS", "")
of_table = plain.replace("<Rect xmin='2'", "<InitialStress file='table.csv'/><Rect xmin='2'", 1)
of_picture = flat.replace("BODIES", "<BMP name='picture' width='4' height='3'><Origin x='2' y='0.5'/>"
                          "<Intensity matname='rubber' imin='0' imax='100'/></BMP>").replace("CRACKS", "")
of_crack = plain.replace("<Material ", "<CrackList><pt x='3' y='2'/><Line xmin='3' ymin='2' xmax='4' ymax='2' resolution='8'/></CrackList><Material ", 1)
of_surface = (flat.replace("<Analysis>10", "<Analysis>12").replace("ymax='4'><Horiz", "ymax='4' zmin='0' zmax='4'><Horiz")
              .replace("<Vert ny='8'/>", "<Vert ny='8'/><Depth nz='8'/>").replace("CRACKS", "")
              .replace("BODIES", "<Body matname='rubber'><STL file='surface.stl'/></Body>")
              .replace("<Rect xmin='0' xmax='1' ymin='0' ymax='4'/>", "<Box xmin='0' xmax='2' ymin='0' ymax='4' zmin='0' zmax='4'/>"))
of_mesh = plain.replace("<Rect xmin='2' xmax='5' ymin='1' ymax='3'/>", "<Surface file='mesh.msh' group='plate' x='2' y='1'/>", 1)
of_solid = of_surface.replace("<STL file='surface.stl'/>", "<Surface file='mesh.msh' group='high' x='2' y='1' z='1'/>")
of_particles = flat.replace("BODIES", "<ParticleTable matname='rubber' file='particles.csv'/>").replace("CRACKS", "")
of_particle_file = of_particles.replace("particles.csv", "particles.vtp")


def png():
    rows = b"".join(b"\0" + bytes((30 * x + 20 * y) % 256 for x in range(8)) for y in range(6))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 6, 8, 0, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def bmp():
    pixels = b"".join(bytes((20 * x + 9 * y) % 256 for x in range(24)) for y in range(6))
    return (b"BM" + struct.pack("<IHHI", 54 + len(pixels), 0, 0, 54) +
            struct.pack("<IiiHHIIiiII", 40, 8, 6, 1, 24, 0, len(pixels), 0, 0, 0, 0) + pixels)


def tetrahedron():
    corners = [(3, 1, 1), (7, 1, 1), (5, 3, 1), (5, 2, 3)]
    return [[corners[k] for k in face] for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))]


def stl():
    return (bytes(80) + struct.pack("<I", 4) +
            b"".join(struct.pack("<12fH", 0, 0, 0, *[x for c in t for x in c], 0) for t in tetrahedron()))


def ascii_stl():
    facet = lambda t: "facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % c for c in t) + "endloop\nendfacet\n"
    return ("solid s\n" + "".join(map(facet, tetrahedron())) + "endsolid s\n").encode()


table = b"x,y,xx,yy\n2,1,-1,-2\n5,1,-1,-2\n2,3,-1,-2\n5,3,-2,-2\n"

particles = (b"x,y,size_x,size_y,vx,xx,yy\n" +
             b"".join(b"%g,%g,0.25,0.25,1,-1,-2\n" % (2.125 + 0.25 * i, 1.125 + 0.25 * j) for i in range(4) for j in range(4)))


def damaged(data, binary):
    """Some bytes changed, removed, doubled or added."""
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 1, 2, 4])):
        at = rng.randrange(len(data) + 1)
        length = rng.choice([1, 2, 8, 64])
        how = rng.randrange(9)
        if how == 0 and data:
            data[at % len(data)] = rng.randrange(256)
        elif how == 1:
            del data[at:at + length]
        elif how == 2:
            data[at:at] = data[at:at + length] * rng.choice([1, 3, 50])
        elif how == 3:
            data[at:at] = bytes(rng.randrange(256) for _ in range(length))
        elif how == 4:
            del data[at:]
        elif how == 5 and data:
            data[at % len(data)] ^= 1 << rng.randrange(8)
        elif how == 6 and binary:
            data[at:at + 4] = rng.choice([b"\0\0\0\0", b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\x80"])
        else:
            found = list(re.finditer(rb"[-+]?\d+\.?\d*(?:e[-+]?\d+)?", bytes(data)))
            if found and not binary:
                one = rng.choice(found)
                data[one.start():one.end()] = rng.choice(numbers)
            elif data:
                data[at % len(data)] ^= 255
    return bytes(data)


def with_new_checksums(data):
    """A checkpoint with numbers changed and every checksum right."""
    magic = data.index(b"\n") + 1
    out, at, entries = data[:magic], magic, []
    while data[at]:
        kind, (name, size) = data[at:at + 1], struct.unpack_from("<QQ", data, at + 1)
        entries.append([kind, data[at + 17:at + 17 + name], bytearray(data[at + 17 + name:at + 17 + name + size])])
        at += 21 + name + size
    counts = [e for e in entries if e[0] == b"i" and len(e[2]) == 8] or entries
    for one in rng.sample(counts, min(len(counts), rng.choice([1, 1, 2]))):
        if rng.random() < 0.8 and len(one[2]) >= 8:
            struct.pack_into("<q", one[2], 0, rng.choice([-1, 0, 1 << 62, 10**9, 10**7, -2**63, 3]))
        else:
            del one[2][rng.randrange(len(one[2]) + 1):]
    if rng.random() < 0.4:
        one = rng.choice([e for e in entries if e[0] == b"d" and len(e[2]) >= 8])
        value = rng.choice([float("nan"), float("inf"), 1e300, -1e300, 1e10, -1.0, 0.0, 1e-300])
        struct.pack_into("<d", one[2], 8 * rng.randrange(len(one[2]) // 8), value)
    for kind, name, content in entries:
        out += kind + struct.pack("<QQ", len(name), len(content)) + name + bytes(content)
        out += struct.pack("<I", zlib.crc32(name + bytes(content)))
    return out + b"\0"


def write(name, data):
    with open(name, "wb") as out:
        out.write(data if isinstance(data, bytes) else data.encode())


failures, tried = [], {}


def limit_resources():
    """No core files; memory is limited unless AddressSanitizer, which reserves address space, has options."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if not sanitized:
        resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))


def run(kind, arguments, must_fail=False):
    """Runs the program; whether it ends as it should is counted."""
    tried[kind] = tried.get(kind, 0) + 1
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run([tribo, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=environment,
                              timeout=12 * most_seconds, preexec_fn=limit_resources, check=False)
        code, text = done.returncode, done.stderr.decode(errors="replace")
    except subprocess.TimeoutExpired:
        code, text = None, ""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = used.ru_utime + used.ru_stime - before.ru_utime - before.ru_stime  # other programs may use the machine
    wrong = ("too slow" if code is None or seconds > most_seconds else
             "crash" if code < 0 or code not in (0, 2, 3, 4, 5, 6) else
             "internal error" if "internal error" in text else
             "no memory" if "not enough memory" in text else
             "silent" if must_fail and code == 0 else
             "long message" if len(text) > 1 << 20 else "")
    if wrong:
        kept = os.path.join(tempfile.gettempdir(), f"bad_input_{len(failures)}")
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(".", kept)
        failures.append(wrong)
        print(f"{wrong}: {kind}: tribo {' '.join(arguments)} in {kept}: {code}, {seconds:.1f} s, {text[:300]!r}")


def command_file(kind, texts, ending):
    write("case" + ending, damaged(rng.choice(texts), False))
    run(kind, ["check", "case" + ending])


def missing_word():
    """A word that is required is missing."""
    word = rng.choice(["<Analysis>10</Analysis>", "<ArchiveTime>1e-2</ArchiveTime>", "<rho>1000</rho>", "<E>1e6</E>", "<nu>0.3</nu>",
                       " xmin='0' xmax='10'", "<Horiz nx='20'/>", "<Vert ny='8'/>", " Type='1'", " dir='1'", "matname='rubber'",
                       "<Rect xmin='2' xmax='5' ymin='1' ymax='3'/>", " ymax='3'", "</Body>", "<MPMHeader>", "</JANFEAInput>"])
    write("case.xml", plain.replace(word, "", 1))
    run("a missing word", ["check", "case.xml"], must_fail=True)


def impossible_number():
    """A number that may only be positive and finite."""
    before, after = rng.choice([("<rho>", "<"), ("<E>", "<"), ("<MaxTime>", "<"), ("<TimeStep>", "<"), ("<ArchiveTime>", "<"), ("nx='", "'"),
                                ("ny='", "'")])
    bad = rng.choice(["-1", "0", "nan", "inf", "-1e300", "1e400", "", "1 2", "1e-320", "x", "1e308"])
    if (bad == "1e308" and before == "<ArchiveTime>") or (bad in ("1e308",) and before in ("<TimeStep>",)):
        bad = "-1"
    write("case.xml", re.sub(re.escape(before) + "[^<']*" + after, before + bad + after, plain, count=1))
    run("an impossible number", ["check", "case.xml"], must_fail=True)


def with_file(kind, text, name, data, binary):
    write("case.xml", text)
    write(name, damaged(data, binary))
    run(kind, ["check", "case.xml"])


def special_file():
    """Not a file at all."""
    kind = rng.randrange(5)
    if kind == 0:
        os.mkfifo("table.csv")
    elif kind == 1:
        os.symlink("table.csv", "table.csv")
    elif kind == 2:
        os.mkdir("table.csv")
    elif kind == 3:
        os.symlink("/dev/zero", "table.csv")
    else:
        write("table.csv", b"")
    write("case.xml", of_table)
    run("a special file", ["check", rng.choice(["case.xml", "table.csv"])], must_fail=True)


def result(folder):
    shutil.copytree(folder, "out")
    files = [os.path.join(where, f) for where, _, names in os.walk("out") for f in names
             if f.endswith((".vtp", ".vtm", ".pvd", ".csv", ".json")) and f != "safety.csv"]
    last = max((f for f in files if f.endswith(".vtp") and os.sep + "contacts" not in f), default="")
    file = rng.choice([f for f in files if not f.endswith(".vtp")] + [last] * 6)
    data = open(file, "rb").read()
    write(file, damaged(data, file.endswith(".vtp")))
    run("results", ["report", "out"] if rng.random() < 0.5 else ["render", "out", "-o", "pictures", "--width", "300", "--time", "1e9"])


def checkpoint(folder):
    shutil.copytree(folder, "out")
    data = open("out/checkpoint.bin", "rb").read()
    if rng.random() < 0.5:
        write("out/checkpoint.bin", with_new_checksums(data))
        run("checkpoints with checksums", ["resume", "--quiet", "out"])
    else:
        write("out/checkpoint.bin", damaged(data, True))
        run("checkpoints", ["resume", "--quiet", "out"])


def main():
    read = lambda paths: [open(p, "rb").read() for p in paths]
    examples = os.path.join(source, "input/examples")
    names = sorted(os.listdir(examples))
    small = {"brick_wall.xml", "toppling.xml", "direct_tension.xml", "simple_shear.xml", "two_disks.xml", "block_on_incline.xml", "two_disks.fmcmd",
             "block_on_incline.fmcmd", "stacked_blocks.xml"}
    files = [os.path.join(examples, n) for n in names if n in small] + [os.path.join(source, "tests/input/legacy_disks.xml")]
    xml = read(f for f in files if f.endswith(".xml")) + [t.encode() for t in (plain, of_crack)]
    blocks = read(os.path.join(examples, n) for n in ("brick_wall.xml", "toppling.xml", "direct_tension.xml"))
    scripts = read(f for f in files if f.endswith(".fmcmd")) + read([os.path.join(source, "tests/input/falling_blocks.fmcmd")])
    meshes = os.path.join(source, "tests/geometry/data")
    plates, solids = (read(os.path.join(meshes, n) for n in (name + ".msh", name + "22.msh")) for name in ("plate", "solid"))
    with tempfile.TemporaryDirectory() as top:
        os.chdir(top)
        write("plain.xml", plain)
        subprocess.run([tribo, "run", "--quiet", "-o", "plain", "plain.xml"], check=True, env=environment)
        tension = open(os.path.join(examples, "direct_tension.xml")).read()
        write("blocks.xml", tension)
        subprocess.run([tribo, "run", "--quiet", "--max-wall", "0.5", "-o", "blocks", "blocks.xml"], check=False, env=environment)
        runs = [os.path.join(top, f) for f in ("plain", "blocks") if os.path.exists(f + "/provenance.json")]
        particle_file = open(os.path.join(top, "plain/particles/run_000001_1.vtp"), "rb").read()
        kinds = [lambda: command_file("XML", xml, ".xml"), lambda: command_file("blocks", blocks, ".xml"),
                 lambda: command_file("cracks", [of_crack.encode()], ".xml"), lambda: command_file("scripts", scripts, ".fmcmd"),
                 missing_word, impossible_number, lambda: with_file("tables", of_table, "table.csv", table, False),
                 lambda: with_file("pictures", of_picture, "picture", rng.choice([png, bmp])(), True),
                 lambda: with_file("surfaces", of_surface, "surface.stl", stl(), True),
                 lambda: with_file("surfaces", of_surface, "surface.stl", ascii_stl(), False), special_file,
                 lambda: with_file("meshes", of_mesh, "mesh.msh", rng.choice(plates), False),
                 lambda: with_file("meshes", of_solid, "mesh.msh", rng.choice(solids), False),
                 lambda: with_file("tables of particles", of_particles, "particles.csv", particles, False),
                 lambda: with_file("files of particles", of_particle_file, "particles.vtp", particle_file, True),
                 lambda: result(rng.choice(runs)), lambda: result(rng.choice(runs)), lambda: checkpoint(rng.choice(runs))]
        begin = time.time()
        for k in range(count):
            os.mkdir("case")
            os.chdir("case")
            kinds[k % len(kinds)]()
            os.chdir(top)
            shutil.rmtree("case")
        seconds = time.time() - begin
    for kind, n in sorted(tried.items()):
        print(f"{n:6d} {kind}")
    print(f"{count} damaged inputs in {seconds:.0f} s: " +
          (", ".join(f"{failures.count(f)} {f}" for f in sorted(set(failures))) if failures else "0 crashes, 0 slow, 0 silent"))
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
