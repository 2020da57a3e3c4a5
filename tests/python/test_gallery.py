# SPDX-License-Identifier: MIT
"""Every script of the gallery as a Python program, which builds the same model."""

import json
import pathlib
import runpy
import unittest
import xml.etree.ElementTree

from common import InFolder, root, run_program

examples = root / "input/examples"


def value(text):
    """A number, or a text: numbers may be written in several ways."""
    try:
        return float(text)
    except (TypeError, ValueError):
        return (text or "").strip()


def elements(text):
    """Names, attributes and texts of all elements in their order, without comments."""
    return [(e.tag, {name: value(given) for name, given in e.attrib.items()}, value(e.text))
            for e in xml.etree.ElementTree.fromstring(text).iter()]


class Programs(InFolder):
    def same_model(self, script):
        name = pathlib.Path(script).stem
        made = run_program("convert", script, "-o", name + ".py")
        self.assertEqual(made.returncode, 0, made.stderr)
        wanted = run_program("convert", script)
        self.assertEqual(wanted.returncode, 0, wanted.stderr)
        built = runpy.run_path(name + ".py")["m"]
        self.assertEqual(elements(built.xml()), elements(wanted.stdout))
        return built

    def test_every_model_of_the_gallery(self):
        for model in json.loads((examples / "gallery.json").read_text()):
            with self.subTest(model["name"]):
                self.same_model(examples / (model["name"] + ".fmcmd"))

    def test_what_has_a_longer_form(self):
        pathlib.Path("long.fmcmd").write_text('''Version 3.2
Comment one,two
Title "A \\"quoted\\" title"&return&"of two lines"
Analysis "Plane Strain MPM","4 Node Quadrilateral"
Gravity 0,-9.81
ConsistentUnits m,kg,s
MaximumTime 1
ArchiveTime 0.5
ArchiveTime 0.25,0.5
GridHoriz 8
GridVert 8
GridRect 0,4,0,4
XMLData MPMHeader
  <!-- a "comment" -->
  <SplitParticles/>
EndXMLData
Material 1,"Steel",IsoPlasticity
  rho 7800
  E 2e11
  nu 0.3
  yield 2e8
  Contact "law",wall
Done
Material "law","law","CoulombFriction"
  coeff 0.3
Done
Material "wall","wall",RigidContact
  SettingFunction "0.1*t"
  SettingFunction2 0
  Friction 0.2,1
Done
Material "bond","bond",SpringNetwork
  kn 1e9
  ks 1e9
Done
Region 1,0,0,1,angle,30
  InitialStress yy,-1000
  Rect 1,2,1,2
  Cut Oval 1.2,1.8,1.2,1.8
EndRegion
Region 1,1,0,1
  PolyPt 2.5,1
  PolyPt 3,1
  PolyPt 3,2
EndRegion
Hole
  Rect 1,1.1,1,1.1
EndHole
Region "wall",0,0,1
EndRegion
Blocks lawname,"bond"
  BoxBlock name,"a b",xmin,0,xmax,1,ymin,0,ymax,0.5,rho,1000,matname,"wall"
  Joint lawname,"bond",blocks,"a b",with,any
    Rect 0,1,0,1
    Cut Rect 0.2,0.3,0,1
  Load Fx,"10*t",blocks,"a b"
  Platen name,"p"
    Line 0,1,0.5,0.5
EndBlocks
Stage 0.5,"later"
  Material 1
    yield 1e8
  Done
  Excavate 1
    Rect 1,1.5,1,2
  EndExcavate
  Blocks damping,0.7
    Platen name,"p",vy,0
  EndBlocks
EndStage
When ratio,0.1,Stop
'''.replace('\\"quoted\\"', "quoted"))
        self.same_model("long.fmcmd")

    def test_a_program_runs_when_it_is_executed(self):
        run_program("convert", "block.fmcmd", "-o", "block.py")
        runpy.run_path("block.py", run_name="__main__")
        run_program("run", "--quiet", "-o", "wanted", "block.fmcmd")
        self.assertEqual(pathlib.Path("block.out/history.csv").read_bytes(), pathlib.Path("wanted/history.csv").read_bytes())

    def test_settings_and_errors(self):
        run_program("convert", "--set", "v=5", "block.fmcmd", "-o", "block.py")
        self.assertIn("velocity=(5, 0)", pathlib.Path("block.py").read_text())
        refused = run_program("convert", "block.fmcmd", "-o", "block.py")
        self.assertIn("already exists", refused.stderr)
        pathlib.Path("model.xml").write_text("<JANFEAInput version='3'/>")
        refused = run_program("convert", "model.xml", "-o", "model.py")
        self.assertEqual(refused.returncode, 3)
        self.assertIn('tribo.run("model.xml")', refused.stderr)
        pathlib.Path("wrong.fmcmd").write_text("Analysis \"Plane Strain MPM\"\nRegoin 1\n")
        self.assertIn("wrong.fmcmd:2:1", run_program("convert", "wrong.fmcmd", "-o", "wrong.py").stderr)


if __name__ == "__main__":
    unittest.main()
