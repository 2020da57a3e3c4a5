# SPDX-License-Identifier: MIT
"""Models that are built in Python."""

import inspect
import pathlib
import unittest
import warnings

import tribo
from common import InFolder, run_program, sliding_block


class Models(InFolder):
    def test_same_results_as_the_script(self):
        built = sliding_block().run(folder="built")
        read = tribo.run("block.fmcmd", folder="read")
        for name in ("history.csv", "energy.csv", "particles/run_000004.vtm", "particles/run_000004_2.vtp"):
            self.assertEqual((pathlib.Path(built.folder) / name).read_bytes(), (pathlib.Path(read.folder) / name).read_bytes())

    def test_the_program_reads_what_it_writes(self):
        m = sliding_block()
        m.save("model.fmcmd")
        pathlib.Path("model.xml").write_text(m.xml())
        m.run(set={"v": 2.5}, folder="python")
        self.assertEqual(run_program("run", "--set", "v=2.5", "-o", "script", "model.fmcmd").returncode, 0)
        self.assertEqual(run_program("check", "model.xml").returncode, 0)
        self.assertEqual(pathlib.Path("python/history.csv").read_text(), pathlib.Path("script/history.csv").read_text())

    def test_every_command_is_a_method(self):
        names = dir(tribo.Model)
        for name in ("grid_horiz", "mpm_method", "cfl_factor", "grid_bc", "global_archive", "vel0_x", "stage", "bond"):
            self.assertIn(name, names)
        self.assertIn("time between rows of history.csv", inspect.getdoc(tribo.Model.global_archive_time).lower())
        self.assertIn("Arguments: cells", inspect.getdoc(tribo.Model.grid_horiz))
        with self.assertRaisesRegex(AttributeError, "did you mean 'grid_rect'"):
            tribo.Model().grid_rekt(0, 1, 0, 1)

    def test_errors_name_the_place_in_python(self):
        m = sliding_block()
        m.material("wrong", "LinearElastic", rho=1, E=1e6, nu=0.7)
        line = inspect.currentframe().f_lineno - 1
        with self.assertRaises(tribo.InputError) as caught:
            m.check()
        problem = caught.exception.problems[0]
        self.assertEqual(problem.source, (__file__, line))
        self.assertIn(f"{__file__}:{line}: error: 'nu' is 0.7 but must be in (-1, 0.5)", str(caught.exception))
        self.assertIn(f"(in the script: model:{problem.line}:{problem.column})", str(caught.exception))
        with self.assertRaises(ValueError):
            tribo.Model("plain strain")
        self.assertIn('"3D MPM"', tribo.Model("three-dimensional").script())

    def test_methods_are_described(self):
        for method, function in ((tribo.Model.run, tribo.run), (tribo.Model.check, tribo.check), (tribo.Model.simulate, tribo.simulate)):
            self.assertEqual(inspect.getdoc(method), inspect.getdoc(function))
            own, other = (list(inspect.signature(f).parameters) for f in (method, function))
            self.assertEqual(own, ["self", *other[1:]])
        self.assertIn('grid_edge("xmin", "symmetry", 0)', inspect.getdoc(tribo.Model.grid))

    def test_grid(self):
        m = tribo.Model("plane strain")
        with self.assertRaisesRegex(ValueError, r"along x, not 'symmetry'.*m.grid_edge\(\"xmin\", \"symmetry\", 0\)"):
            m.grid(x=(0, 5, "symmetry"), y=(0, 1), cell=0.1)
        with self.assertRaisesRegex(ValueError, "the size of the cell"):
            m.grid(x=(0, 5, 10), y=(0, 1))
        with self.assertWarnsRegex(tribo.ModelWarning, "3 cells of 0.333333 fill 0 to 1 along x, not cells of 0.3") as caught:
            m.grid(x=(0, 1), y=(0, 0.9), cell=0.3)
        self.assertEqual(caught.filename, __file__)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            m.grid(x=(0, 1.6), y=(-0.3, 0.7), cell=0.1)

    def test_times_of_output(self):
        m = sliding_block()
        with self.assertRaisesRegex(ValueError, r"output\(every, after=time\)"):
            m.output(0.01)
        m.output(0.001, after=0.015)
        times = m.run().times
        self.assertEqual(len(times), 9)  # 0, 0.005, ..., 0.015, 0.016, ..., 0.02

    def test_impulses_of_contact(self):
        m = tribo.Model("plane strain")
        m.multimaterial_mpm("maxvol", impulses="faces")
        with self.assertRaisesRegex(ValueError, "not 'edges'"):
            m.multimaterial_mpm(impulses="edges")
        self.assertIn("Impulses='faces'", m.script())
        m = sliding_block()
        m.multimaterial_mpm(impulses="faces")
        self.assertIn("Impulses='faces'", m.xml())
        self.assertIn("faces", inspect.getdoc(tribo.Model.multimaterial_mpm))

    def test_surfaces(self):
        corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        points = "".join("v %g %g %g\n" % corner for corner in corners)
        pathlib.Path("tetrahedron.obj").write_text(points + "".join("f %d %d %d\n" % tuple(k + 1 for k in face) for face in faces))
        m = tribo.Model("3d")
        m.grid(x=(0, 4), y=(0, 4), z=(0, 4), cell=0.25)
        m.material("rock", "LinearElastic", rho=1, E=100, nu=0.3)
        m.body("rock", tribo.surface("tetrahedron.obj", scale=2, x=1, y=1, z=1), velocity=(0, 0, 1))
        m.time(0.1, courant=0.4)
        m.output(0.1)
        self.assertRegex(m.check().lines["body of 'rock'"][0], r"volume 1\.3[23]")  # 8 / 6

    def test_shapes_conditions_and_xml(self):
        m = tribo.Model("plane strain", name="plate")
        m.grid(x=(0, 10, 20), y=(0, 10), cell=0.5, thickness=2)
        m.material("plate", "LinearElastic", rho=1, E=100, nu=0.3)
        hole = tribo.oval(4, 6, 4, 6)
        m.body("plate", tribo.rect(2, 8, 2, 8) - hole, angle=10)
        m.body("plate", tribo.polygon((8, 2), (9, 2), (9, 3)))
        m.prescribe(tribo.rect(2, 8, 1.5, 2.5), x=0, y="0.1*t")
        with m.particle_bc():
            m.rect(2, 8, 7.5, 8)
            m.load("y", "constant", 1)
        m.xml_data("MPMHeader", "<SinglePrecision/>")
        m.time(0.1)
        m.output(0.1, fields=["velocity", "strain"])
        text = m.script()
        self.assertIn("Cut Oval", text)
        xml = m.xml()
        self.assertIn("<SinglePrecision", xml)
        check = m.check()
        self.assertIn("volume 65.71", check.lines["body of 'plate'"][0])  # 2 (36 - pi)
        self.assertIn("volume 1 ", check.lines["body of 'plate'"][1])

    def test_blocks(self):
        m = tribo.Model("plane strain", name="columns")
        m.time(0.1, step=1e-3)
        m.output(0.1)
        m.material("rub", "SpringNetwork", called="Joints", kn=5e7, ks=5e7, fric=0.6)
        with m.blocks(lawname="rub", touchname="rub"):
            for k in range(3):
                m.box_block(name=f"column{k}", xmin=0.7 * k, xmax=0.7 * k + 0.2, ymin=0, ymax=1.2, rho=2500)
            m.polygon_block(name="wedge", rho=2500)
            m.points((6, 0), (6.8, 0), (6.8, 0.5))
            m.hold("blocks", "column0", vx=0, vy=0)
            m.load(Fy="-10*t")
            m.rect(5, 7, -1, 1)
        m.history("turnz", block="column1")
        m.global_archive("dispx", block="wedge")
        self.assertIn("blocks: 4", str(m.check()))
        xml = m.xml()
        for text in ("Name='Joints'", "<pt x='6.8' y='0.5'/>", "block='column1'", "<Load Fy='-10*t'>", "<Hold blocks='column0' vx='0'"):
            self.assertIn(text, xml)
        self.assertIn("keyword arguments", inspect.getdoc(tribo.Model.box_block))
        m = tribo.Model("plane strain")
        with m.blocks():
            m.ball(x=0, y=0, radios=1)
        with self.assertRaisesRegex(tribo.InputError, "did you mean 'radius'"):
            m.xml()

    def test_texts(self):
        m = tribo.Model(title='a "quoted" title, with a comma')
        self.assertIn('"a "&quote&"quoted"&quote&" title, with a comma"', m.script())
        m = sliding_block()
        m.title('the "second"')
        self.assertIn('the "second"', m.xml())

    def test_lines_of_a_script(self):
        m = sliding_block()
        with m.header():
            m.text("A description, as it is.")
        m.text('Repeat #k,1,2\n  GlobalArchive vely,"block",0.3+0.1*#k,0.1\nEndRepeat'.replace(',"block"', ""))
        history = m.run(set={"v": 1}).history
        self.assertEqual(len(history), 5)
        self.assertIn("A description, as it is.", m.xml())

    def test_manual(self):
        self.assertIn("angle of internal friction", tribo.doc("MohrCoulomb"))
        self.assertIn("<Material Type='MohrCoulomb'", tribo.doc("MohrCoulomb"))
        self.assertIn("MohrCoulomb", tribo.keywords("material"))
        self.assertIn("von_mises", tribo.keywords("field"))
        self.assertIn("E", tribo.parameters("LinearElastic"))
        with self.assertRaisesRegex(tribo.UsageError, "did you mean 'MohrCoulomb'"):
            tribo.doc("MohrColoumb")
        with self.assertRaises(ValueError):
            tribo.keywords("things")


if __name__ == "__main__":
    unittest.main()
