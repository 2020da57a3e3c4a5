# SPDX-License-Identifier: MIT
"""Results that are read from the folder of a run."""

import pathlib
import unittest
import unittest.mock

import numpy as np
import tribo
from common import InFolder, root, run_program


class Reading(InFolder):
    def test_results_of_the_program(self):
        run_program("run", "--quiet", "block.fmcmd")
        results = tribo.open("block.out")
        self.assertEqual(results.status, "finished")
        np.testing.assert_allclose(results.times, [0, 0.005, 0.01, 0.015, 0.02], rtol=1e-2, atol=1e-6)
        frame = results.frames[-1]
        self.assertEqual(frame["velocity"].shape, frame["position"].shape)
        self.assertEqual(frame["stress"].shape, (len(frame["id"]), 6))
        self.assertEqual(frame["id"].dtype, np.int64)
        self.assertEqual(results.frames.at(0.011).time, results.times[2])
        self.assertEqual(list(results.history), ["time", "velx:block", "Kinetic Energy"])
        self.assertIn("residual", results.energy)
        self.assertEqual(results.units["stress"], "Pa")
        self.assertIn("finished", repr(results))

    def test_messages(self):
        with self.assertRaisesRegex(tribo.OutputError, "there is no folder 'nothing'"):
            tribo.open("nothing")
        with self.assertRaisesRegex(tribo.OutputError, "not the folder of a run"):
            tribo.open(".")
        results = tribo.run("block.fmcmd")
        with self.assertRaisesRegex(tribo.OutputError, "has no tips.csv"):
            results.tips
        with self.assertRaisesRegex(KeyError, "there is no column 'vely'; valid: time"):
            results.history["vely"]
        with self.assertRaisesRegex(KeyError, "there is no field 'speed'; valid:"):
            results.frames[0]["speed"]
        path = pathlib.Path(results.frames[0].path)
        path.write_bytes(path.read_bytes()[:-400])
        with self.assertRaisesRegex(tribo.OutputError, "is damaged"):
            tribo.open("block.out").frames[0].particles

    def test_events_of_joints_have_words(self):
        table = tribo.Table({"time": np.array([0.0, 1.0]), "state": np.array(["stick", "slip"], dtype=object)})
        table.write("events.csv")
        again = tribo.Table.read("events.csv")
        self.assertEqual(list(again["state"]), ["stick", "slip"])
        self.assertIn("<td>slip</td>", again._repr_html_())

    def test_pandas(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = tribo.run("block.fmcmd").history.to_pandas()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(len(frame), 21)

    def test_packages_that_are_not_there(self):
        table = tribo.Table({"time": np.array([0.0, 1.0]), "a": np.array([0.0, 1.0])})
        with unittest.mock.patch.dict("sys.modules", {"pandas": None, "matplotlib": None, "matplotlib.pyplot": None}):
            with self.assertRaisesRegex(ModuleNotFoundError, "to_pandas.* needs pandas: .* python3-pandas"):
                table.to_pandas()
            with self.assertRaisesRegex(ModuleNotFoundError, "pictures need matplotlib: .* python3-matplotlib"):
                table.plot()

    def test_pictures(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not installed")
        matplotlib.use("Agg")
        results = tribo.run("block.fmcmd")
        self.assertEqual(results.plot("velocity").get_title(), "time 0.02 s")
        results.plot("stress", component="yy", time=0.01, range=(-1e4, 0)).figure.savefig("stress.png")
        self.assertGreater(pathlib.Path("stress.png").stat().st_size, 1000)
        with self.assertRaisesRegex(ValueError, "name a component"):
            results.plot("stress")
        results.history.plot(y="velx:block")

    def test_blocks_alone(self):
        example = root / "input/examples/toppling.xml"
        results = tribo.run(example, folder="blocks", max_wall=0.5)
        self.assertIn(results.status, ("finished", "stopped"))
        self.assertGreater(len(results.blocks), 0)
        self.assertEqual(len(results.frames), 0)
        with self.assertRaisesRegex(tribo.OutputError, "no files of particles"):
            results.plot(of="particles")
        with self.assertRaisesRegex(ValueError, "of 'particles' or of 'blocks', not of 'grid'"):
            results.plot(of="grid")
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not installed")
        matplotlib.use("Agg")
        for frame in (results.plot(), results.plot("rotation", component="z", time=0, of="blocks")):
            self.assertEqual(len(frame.collections[0].get_paths()), 8)

    def test_blocks_in_space(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not installed")
        matplotlib.use("Agg")
        m = tribo.Model("3d")
        m.time(1e-3, step=1e-3)
        m.output(1e-3)
        m.material("rub", "SpringNetwork", kn=5e7, ks=5e7, fric=0.6)
        with m.blocks(lawname="rub", touchname="rub"):
            m.box_block(name="one", xmin=0, xmax=1, ymin=0, ymax=2, zmin=0, zmax=3, rho=2500)
            m.hold(blocks="one", vx=0, vy=0, vz=0)
        axes = m.run().plot()
        self.assertEqual(len(axes.collections), 1)
        self.assertGreater(axes.get_zlim()[1], 2.9)


if __name__ == "__main__":
    unittest.main()
