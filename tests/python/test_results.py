# SPDX-License-Identifier: MIT
"""Results that are read from the folder of a run."""

import pathlib
import unittest

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


if __name__ == "__main__":
    unittest.main()
