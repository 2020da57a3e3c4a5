#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Runs in several processes give the same bytes as a run in one, and end in an orderly way when something fails.

Usage: test_processes.py TRIBO SOURCE_DIR [--ranks N ...] [--threads N ...] [--models NAME ...]

Without options the short form for ctest, with 2 and 3 processes.
"""

import argparse
import filecmp
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

PLANE = "<Grid xmin='-40' xmax='100' ymin='-20' ymax='60'><Horiz cellsize='1'/><Vert cellsize='1'/></Grid>"
CORNER = ("<Grid xmin='0' xmax='60' ymin='0' ymax='40'><Horiz cellsize='1' symmin='0'/><Vert cellsize='1' symmin='0'/>"
          "</Grid>")
SPACE = ("<Grid xmin='-10' xmax='40' ymin='-10' ymax='20' zmin='-10' zmax='20'><Horiz cellsize='1'/>"
         "<Vert cellsize='1'/><Depth cellsize='1'/></Grid>")
DISCS = ("<Body mat='1' vx='1' vy='-0.2'><Rect xmin='0' xmax='30' ymin='0' ymax='20'/></Body>"
         "<Body mat='2' vx='-1'><Oval xmin='40' xmax='60' ymin='0' ymax='20'/></Body>")
SPHERES = ("<Body mat='1' vx='0.5' vy='-0.2'><Box xmin='0' xmax='12' ymin='0' ymax='9' zmin='0' zmax='7'/></Body>"
           "<Body mat='2' vx='-0.5'><Sphere xmin='16' xmax='26' ymin='0' ymax='10' zmin='0' zmax='10'/></Body>")
HELD = ("<GridBCs><BCBox xmin='-0.5' xmax='0.5' ymin='-5' ymax='40' zmin='-9' zmax='20'>"
        "<DisBC dir='1' style='1' disp='0'/><DisBC dir='2' style='1' disp='0'/></BCBox></GridBCs>")
LOADED = ("<ParticleBCs><BCBox xmin='28' xmax='31' ymin='-1' ymax='21' zmin='-1' zmax='1'>"
          "<LoadBC dir='2' style='1' load='0.01'/></BCBox></ParticleBCs>")
FRICTION = "<MultiMaterialMode Impulses='nodes'><Friction law='law'/></MultiMaterialMode>"
PAIR = ("<Body mat='1' vx='0.1' vy='-0.05'><Rect xmin='0' xmax='30' ymin='0' ymax='20'/></Body>"
        "<Body mat='2' vx='-0.1'><Oval xmin='31' xmax='51' ymin='0' ymax='20'/></Body>")
PAIR_IN_SPACE = ("<Body mat='1' vx='0.1'><Box xmin='0' xmax='12' ymin='0' ymax='9' zmin='0' zmax='7'/></Body>"
                 "<Body mat='2' vx='-0.1'><Sphere xmin='12.5' xmax='22.5' ymin='0' ymax='10' zmin='0' zmax='10'/></Body>")
ON_FLOOR = ("<Body mat='1' vy='-0.1'><Rect xmin='10' xmax='40' ymin='1' ymax='16'/></Body>"
            "<Body mat='3'><Rect xmin='-10' xmax='80' ymin='-8' ymax='0'/></Body>")
COULOMB = "<Material Type='CoulombFriction' Name='law'><coeff>0.3</coeff>{}</Material>"
RIGID = "<Material Type='Rigid' Name='floor'><SetDirection>2</SetDirection></Material>"
FLOOR = "<Material Type='RigidContact' Name='floor'/>"
WALL = ("<GridBCs><BCBox xmin='-0.5' xmax='0.5' ymin='-5' ymax='40' zmin='-9' zmax='20'>"
        "<DisBC dir='1' style='1' vel='0.2' depth='-3'/></BCBox></GridBCs>")
FACES = "<MultiMaterialMode><Friction law='law'/></MultiMaterialMode>"
CRACK = ("<CrackList><Line xmin='-1' xmax='20' ymin='9.7' ymax='10.2' resolution='40'/>"
         "<Line xmin='48' xmax='55' ymin='5' ymax='14' resolution='20'/></CrackList>")
PERIODIC = "<Grid xmin='0' xmax='64' ymin='-20' ymax='60'><Horiz cellsize='1' periodic='1'/><Vert cellsize='1'/></Grid>"
TRACTION = ("<ParticleBCs><BCBox xmin='28' xmax='31' ymin='-1' ymax='21' zmin='-1' zmax='1'>"
            "<TractionBC dir='1' face='2' style='1' stress='0.02'/></BCBox></ParticleBCs>")
FLUX = TRACTION.replace("<TractionBC dir='1' face='2' style='1' stress='0.02'/>", "<HeatFluxBC dir='1' face='2' value='0.5'/>")
PLANES = "<GlobalArchive type='reactionx' material='-10'/><GlobalArchive type='reactiony' material='-20'/>"
ADAPTED = "<CustomTasks><Schedule name='AdjustTimeStep'/></CustomTasks>"

# Name, and what differs from a model in the plane with quadratic splines, FLIP and USF
MODELS = {
    "usl": {"order": "USL-", "more": HELD},
    "usavg": {"order": "USAVG+", "more": HELD + LOADED},
    "gimp": {"order": "USL+", "shape": "uGIMP", "header": "<Damping>0.05</Damping>"},
    "cpdi": {"shape": "lCPDI", "more": HELD},
    "apic": {"order": "USAVG-", "header": "<Transfer type='APIC'/><PDamping>0.05</PDamping>", "more": HELD},
    "fmpm": {"order": "USL-", "header": "<Transfer type='FMPM' order='2'/>", "more": HELD + ADAPTED},
    "corner": {"grid": CORNER, "header": "<Transfer type='XPIC' order='2'/>", "order": "USL-"},
    "heat": {"more": "<Thermal><Conduction/></Thermal>"},
    "space": {"space": True, "order": "USL-", "more": HELD},
    "cubic": {"space": True, "order": "USAVG-", "shape": "B3SPLINE"},
    "friction": {"order": "USL-", "header": FRICTION, "bodies": PAIR, "more": COULOMB.format("")},
    "static": {"order": "USAVG+", "header": FRICTION, "bodies": PAIR,
               "more": COULOMB.format("<coeffStatic>0.5</coeffStatic>")},
    "contact_cpdi": {"order": "USL-", "shape": "lCPDI", "header": FRICTION, "bodies": PAIR, "more": COULOMB.format("")},
    "contact_in_space": {"space": True, "order": "USAVG-", "header": FRICTION, "bodies": PAIR_IN_SPACE,
                         "more": COULOMB.format("")},
    "contact_cubic": {"space": True, "order": "USL-", "shape": "B3SPLINE", "header": FRICTION, "bodies": PAIR_IN_SPACE,
                      "more": COULOMB.format("")},
    "floor": {"order": "USL-", "header": FRICTION, "bodies": ON_FLOOR, "third": FLOOR,
              "more": COULOMB.format("")},
    "velocity": {"order": "USAVG+", "bodies": ON_FLOOR, "third": RIGID},
    "wall": {"order": "USL-", "more": WALL},
    "faces": {"order": "USAVG+", "header": FACES, "bodies": PAIR, "more": COULOMB.format("")},
    "faces_in_space": {"space": True, "order": "USL-", "header": FACES, "bodies": PAIR_IN_SPACE, "more": COULOMB.format("")},
    "heat_in_contact": {"order": "USL-", "header": FACES, "bodies": PAIR,
                        "more": COULOMB.format("") + "<Thermal><Conduction/><ContactHeating/></Thermal>"},
    "crack": {"order": "USAVG-", "header": "<Cracks><Friction law='law'/></Cracks>", "more": CRACK + COULOMB.format("")},
    "periodic": {"order": "USL-", "grid": PERIODIC, "bodies": DISCS.replace("vx='-1'", "vx='1'")},
    "traction": {"order": "USL+", "more": HELD + TRACTION},
    "traction_in_space": {"space": True, "order": "USL-", "more": HELD + TRACTION.replace("xmin='28' xmax='31'", "xmin='11' xmax='13'")
                          .replace("zmin='-1' zmax='1'", "zmin='-1' zmax='8'")},
    "flux": {"more": "<Thermal><Conduction/></Thermal>" + FLUX},
    "planes": {"grid": CORNER, "order": "USL-", "header": PLANES},
    "mirror": {"order": "USL-", "more": WALL.replace("depth='-3'", "depth='-1' gradfxn='mirror'")},
    "space_apic": {"space": True, "order": "USL+", "header": "<Transfer type='APIC'/>"},
}
EXAMPLES = ("dam_break", "granular_column", "simple_shear", "slope_failure", "taylor_bar")  # of the gallery
COMPARED = ("checkpoint.bin", "history.csv", "energy.csv", "run.pvd")


class Failure(Exception):
    pass


def deck(name):
    m = MODELS[name]
    space = m.get("space", False)
    return f"""<?xml version='1.0'?>
<JANFEAInput version='3'>
<Header><Analysis>{12 if space else 10}</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
<MPMHeader><MPMMethod>{m.get("order", "USF")}</MPMMethod>{m.get("header", "")}<GIMP type='{m.get("shape", "B2SPLINE")}'/>
<MaxTime>{6 if space else 15}</MaxTime><TimeFactor>0.4</TimeFactor><ArchiveTime>5</ArchiveTime>
<GlobalArchiveTime>1</GlobalArchiveTime><GlobalArchive type='Kinetic Energy'/><GlobalArchive type='sxx'/>
<GlobalArchive type='Grid Kinetic Energy'/><GlobalArchive type='posx' mat='1'/></MPMHeader>
<Mesh>{m.get("grid", SPACE if space else PLANE)}</Mesh>
<MaterialPoints>{m.get("bodies", SPHERES if space else DISCS)}</MaterialPoints>
<Material Type='Mooney' Name='m'><rho>1</rho><K>3</K><G1>1</G1><kCond>1</kCond><Cv>1</Cv></Material>
<Material Type='LinearElastic' Name='n'><rho>1</rho><E>1</E><nu>0.3</nu><kCond>1</kCond><Cv>1</Cv></Material>
{m.get("third", "")}
<Gravity><BodyYForce>-0.01</BodyYForce></Gravity>
{m.get("more", "")}
</JANFEAInput>
"""


class Tester:
    def __init__(self, tribo, source, work):
        self.tribo, self.source, self.work = tribo, source, work
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                                OMP_WAIT_POLICY="passive", OMPI_MCA_btl="self,vader",
                                OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_hwloc_base_binding_policy="none")

    def command(self, ranks, *arguments):
        launcher = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
        return [*launcher, self.tribo, *map(str, arguments)]

    def call(self, ranks, *arguments, code=0, **options):
        done = subprocess.run(self.command(ranks, *arguments), env=self.environment, cwd=self.work, text=True,
                              capture_output=True, timeout=120, **options)
        if done.returncode != code:
            raise Failure(f"{ranks} processes, {' '.join(map(str, arguments))}: exit code {done.returncode}, not {code}\n"
                          + done.stderr[-2000:])
        return done.stderr

    def write(self, name):
        file = self.work / f"{name}.xml"
        file.write_text(deck(name))
        return file

    def compare(self, one, other):
        files = [f.relative_to(one) for f in sorted((one / "particles").iterdir())]
        for file in [*COMPARED, *files]:
            if not filecmp.cmp(one / file, other / file, shallow=False):
                raise Failure(f"{other.name}/{file} differs from that of {one.name}")

    def same_bits(self, name, file, rank_counts, thread_counts):
        serial = self.work / f"{name}.1"
        self.call(1, "run", "--quiet", "-o", serial, file)
        for ranks in rank_counts:
            for threads in thread_counts:
                out = self.work / f"{name}.{ranks}.{threads}"
                self.call(ranks, "run", "--quiet", "--threads", threads, "-o", out, file)
                self.compare(serial, out)

    def restarts(self):
        """From 3 processes to 2, to one, and to 2 again."""
        for name in ("usavg", "contact_in_space", "faces", "crack", "periodic"):
            self.restart(self.write(name), self.work / f"{name}.whole", self.work / f"{name}.parts")

    def restart(self, file, whole, parts):
        self.call(1, "run", "--quiet", "-o", whole, file)
        self.call(3, "run", "--quiet", "--threads", 1, "--max-steps", 6, "-o", parts, file, code=6)
        for ranks in (2, 1):
            self.call(ranks, "resume", "--quiet", "--threads", 1, "--max-steps", 4, parts, code=6)
        self.call(2, "resume", "--quiet", "--threads", 1, parts)
        self.compare(whole, parts)

    def errors(self):
        """Told once, with the code of a single process."""
        wrong = self.work / "wrong.xml"
        wrong.write_text(deck("usl").replace("<rho>1</rho>", "<rhoo>1</rhoo>", 1))
        told = self.call(2, "run", "-o", self.work / "wrong", wrong, code=3)
        if told.count("rhoo") != self.call(1, "run", "-o", self.work / "wrong", wrong, code=3).count("rhoo"):
            raise Failure("an error of the command file is not told once\n" + told)
        used = self.work / "used"
        self.call(1, "run", "--quiet", "--overwrite", "-o", used, self.write("usl"))
        if self.call(2, "run", "-o", used, self.write("usl"), code=5).count("--overwrite") != 1:
            raise Failure("a used folder is not told once")
        leaving = self.work / "leaving.xml"
        leaving.write_text(deck("usl").replace("vx='-1'", "vx='9'").replace("vx='1'", "vx='0'"))
        for ranks in (2, 3):
            told = self.call(ranks, "run", "--threads", 1, "--quiet", "-o", self.work / f"leaving{ranks}", leaving, code=4)
            if told.count("left the grid") != 1 or "checkpoint.bin" not in told:
                raise Failure("a particle that left the grid is not told once\n" + told)
        deep = self.work / "deep.xml"
        deep.write_text(deck("mirror").replace("depth='-1'", "depth='-3'"))
        told = self.call(2, "run", "-o", self.work / "deep", deep, code=3)
        if "runs in a single process only" not in told:
            raise Failure("a model that cannot be distributed is not refused with a reason\n" + told)

    def full_disk(self):
        """A disk without space for the results, if a small one can be mounted."""
        disk = self.work / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", disk], capture_output=True).returncode != 0:
            print("left out: full disks, which need root")
            return
        try:
            told = self.call(2, "run", "--threads", 1, "-o", disk / "full", self.write("usl"), code=5)
            if told.count("error: ") != 1:
                raise Failure("a full disk is not told once\n" + told)
        finally:
            subprocess.run(["umount", disk], check=True)

    def process_of_rank(self, launcher, rank):
        for _ in range(200):
            for process in pathlib.Path("/proc").glob("[0-9]*"):
                try:
                    variables = (process / "environ").read_bytes().split(b"\0")
                    parent = int((process / "stat").read_text().rpartition(")")[2].split()[1])
                except (OSError, ValueError, IndexError):
                    continue
                if parent == launcher.pid and f"OMPI_COMM_WORLD_RANK={rank}".encode() in variables:
                    return int(process.name)
            time.sleep(0.02)
        raise Failure(f"process {rank} did not start")

    def deaths(self):
        """A process that is killed ends the run; a signal to rank 0 stops it with a checkpoint."""
        text = deck("usl").replace("<MaxTime>15<", "<MaxTime>400<").replace("vx='1' vy='-0.2'", "").replace("vx='-1'", "")
        file = self.work / "long.xml"
        file.write_text(text.replace("<BodyYForce>-0.01<", "<BodyYForce>-0.0001<"))
        for rank, what in ((1, signal.SIGKILL), (0, signal.SIGTERM)):
            out = self.work / f"death{rank}"
            run = subprocess.Popen(self.command(2, "run", "--threads", 1, "--quiet", "-o", out, file), cwd=self.work,
                                   env=self.environment, stderr=subprocess.PIPE, text=True)
            number = self.process_of_rank(run, rank)
            while not (out / "checkpoint.bin").exists() and run.poll() is None:
                time.sleep(0.02)
            time.sleep(0.3)
            os.kill(number, what)
            told = run.communicate(timeout=60)[1]
            if run.returncode == 0 or (what == signal.SIGTERM and run.returncode != 6):
                raise Failure(f"signal {what} to process {rank}: exit code {run.returncode}\n{told}")
            if not told:
                raise Failure(f"the death of process {rank} is not told")
            self.call(2, "resume", "--threads", 1, "--quiet", "--max-wall", 0.05, out, code=6)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tribo", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("source", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--ranks", type=int, nargs="+", default=[2, 3])
    parser.add_argument("--threads", type=int, nargs="+", default=[1])
    parser.add_argument("--models", nargs="+", default=[*MODELS, *EXAMPLES])
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        tester = Tester(a.tribo, a.source, pathlib.Path(work))
        parts = [tester.restarts, tester.errors, tester.full_disk, tester.deaths]
        parts += [lambda n=n: tester.same_bits(n, tester.write(n) if n in MODELS else a.source / f"input/examples/{n}.xml",
                                               a.ranks, a.threads) for n in a.models]
        failures = 0
        for part in parts:
            try:
                part()
            except Failure as failure:
                failures += 1
                print(f"FAILED: {failure}\n")
    print(f"{len(parts) - failures} of {len(parts)} parts passed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
