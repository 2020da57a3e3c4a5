# SPDX-License-Identifier: MIT
"""Small models for the tests of the Python package, and a temporary folder for each test."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import tribo

root = pathlib.Path(__file__).resolve().parents[2]
program = os.environ.get("TRIBO", str(root / "build/release/tribo"))

# A block that slides on a rigid floor.
script = """Title "A sliding block"
#v=2
#mu=0.3
Analysis "Plane Strain MPM"
ConsistentUnits m,kg,s
MPMMethod "USL","B2SPLINE"
TimeStep 2e-4,0.02,0.4
ArchiveTime 0.005
GlobalArchiveTime 0.001
GlobalArchive velx,"block"
GlobalArchive "Kinetic Energy"
MultimaterialMPM
Material "friction","friction","CoulombFriction"
  coeff #mu
Done
ContactMM "friction"
Material "block","block","LinearElastic"
  rho 2000
  E 1e6
  nu 0.3
Done
Material "floor","floor","RigidContact"
Done
GridHoriz 16
GridVert 10
GridRect 0,1.6,-0.3,0.7
Region "floor",0,0
  Rect 0.1,1.5,-0.2,0
EndRegion
Region "block",#v,0
  Rect 0.3,0.7,0,0.3
EndRegion
Gravity 0,-9.81
"""


def sliding_block(**options):
    """The same in Python."""
    m = tribo.Model("2D plane strain", title="A sliding block", **options)
    v, mu = m.variable("v", 2), m.variable("mu", 0.3)
    m.mpm_method("USL", "B2SPLINE")
    m.time(0.02, step=2e-4, courant=0.4)
    m.output(0.005, history_every=0.001)
    m.history("velx", "block")
    m.history("Kinetic Energy")
    m.multimaterial_mpm()
    m.material("friction", "CoulombFriction", coeff=mu)
    m.contact_mm("friction")
    m.material("block", "LinearElastic", rho=2000, E=1e6, nu=0.3)
    m.material("floor", "RigidContact")
    m.grid(x=(0, 1.6), y=(-0.3, 0.7), cell=0.1)
    m.body("floor", tribo.rect(0.1, 1.5, -0.2, 0))
    m.body("block", tribo.rect(0.3, 0.7, 0, 0.3), velocity=(v, 0))
    m.gravity(0, -9.81)
    return m


def run_program(*arguments):
    """Runs the program; returns the completed process with its texts."""
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, "OMP_NUM_THREADS": "1"})


class InFolder(unittest.TestCase):
    """Each test runs in an empty folder, with the file block.fmcmd."""

    def setUp(self):
        self._before = os.getcwd()
        self._folder = tempfile.TemporaryDirectory()
        os.chdir(self._folder.name)
        pathlib.Path("block.fmcmd").write_text(script)

    def tearDown(self):
        os.chdir(self._before)
        self._folder.cleanup()

    def assert_same_results(self, one, other):
        """All files of two runs but their records have the same bytes."""
        skipped = {"provenance.json", "tribo-run.lock", "tribo-model.json"}
        files = lambda folder: {p.relative_to(folder) for p in pathlib.Path(folder).rglob("*")
                                if p.is_file() and p.name not in skipped}
        self.assertEqual(files(one), files(other))
        for name in files(one):
            self.assertEqual((pathlib.Path(one) / name).read_bytes(), (pathlib.Path(other) / name).read_bytes(), name)
