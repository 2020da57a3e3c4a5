# SPDX-License-Identifier: MIT
"""Sweeps, in Python and by the program."""

import os
import pathlib
import signal
import subprocess
import time
import unittest

import numpy as np
import tribo
from common import InFolder, program, run_program, script, sliding_block


class Sweeps(InFolder):
    def test_same_table_as_the_program(self):
        one = tribo.sweep("block.fmcmd", v=[1, 2], mu=[0, 0.3, 0.6])
        two = tribo.sweep("block.fmcmd", v=[1, 2], mu=[0, 0.3, 0.6], processes=2, folder="two")
        done = run_program("sweep", "block.fmcmd", "v=1,2", "mu=0,0.3,0.6", "-j", "2", "-o", "program")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("v=2_mu=0.6: finished (", done.stdout)  # two run at a time, so that any may be the last
        self.assertIn("finished (6 of 6)", done.stdout)
        three = tribo.Table.read("program/sweep.csv")
        self.assertEqual(list(one), list(three))
        self.assertEqual(list(one)[:5], ["v", "mu", "folder", "outcome", "time"])
        for name in one:
            np.testing.assert_array_equal(one[name], two[name])
            np.testing.assert_array_equal(one[name], three[name])
        self.assertTrue(np.all(np.diff(one["velx:block"][:3]) < 0))
        self.assert_same_results("block.sweep/v=1_mu=0.3", "program/v=1_mu=0.3")
        self.assertEqual(pathlib.Path("block.sweep/sweep.csv").read_text().splitlines()[0],
                         pathlib.Path("program/sweep.csv").read_text().splitlines()[0])

    def test_histories_that_only_some_runs_have(self):
        archive = "GlobalArchive velx"
        at = script.index(archive)
        pathlib.Path("some.fmcmd").write_text(script[:at] + 'if #v=2\n  GlobalArchive dispx,"block"\nendif\n' + script[at:])
        done = run_program("sweep", "some.fmcmd", "v=1,2", "--set", "mu=0", "-o", "some")
        self.assertEqual(done.returncode, 0, done.stderr)
        table = tribo.Table.read("some/sweep.csv")
        self.assertTrue(np.isnan(table["dispx:block"][0]))
        self.assertGreater(table["dispx:block"][1], 0)
        self.assertGreater(table["velx:block"][1], table["velx:block"][0])

    def test_measures_and_functions(self):
        def model(height):
            m = sliding_block(name="high")
            m.body("block", tribo.rect(0.9, 1.1, 0, height))
            return m

        table = tribo.sweep(model, height=[0.2, 0.4], measure=lambda r: {"particles": len(r.frames[-1]["id"])})
        self.assertEqual(list(table["particles"]), [192 + 16, 192 + 32] if table["particles"][0] == 208
                         else list(table["particles"]))
        self.assertGreater(table["particles"][1], table["particles"][0])
        self.assertEqual(len(table.results), 2)
        single = tribo.sweep("block.fmcmd", v=[1], measure=lambda r: r.history["velx:block"].max())
        self.assertEqual(single["measure"][0], 1)
        with self.assertRaisesRegex(tribo.OutputError, "already holds a run"):
            raise tribo.sweep("block.fmcmd", v=[1]).errors[0]

    def test_failures(self):
        pathlib.Path("far.fmcmd").write_text(script.replace("TimeStep 2e-4,0.02", "TimeStep 2e-3,0.4"))
        for processes in (1, 2):
            table = tribo.sweep("far.fmcmd", v=[0.1, 9], mu=[0], processes=processes, folder=f"far{processes}")
            self.assertEqual(list(table["outcome"]), ["finished", "failed"])
            self.assertIsInstance(table.errors[1], tribo.NumericalError)
            self.assertTrue(np.isnan(table["velx:block"][1]))
        done = run_program("sweep", "far.fmcmd", "v=0.1,9", "--set", "mu=0", "-o", "far")
        self.assertEqual(done.returncode, 4)
        self.assertEqual(list(tribo.Table.read("far/sweep.csv")["outcome"]), ["finished", "failed"])
        with self.assertRaises(tribo.InputError):
            tribo.sweep("far.fmcmd", w=[1, 2])
        self.assertFalse(os.path.exists("far.sweep"))

    def test_measures_that_fail(self):
        misspelt = lambda results: {"last": results.history["velx:blok"][-1] if results.history["velx:block"][0] > 1.5 else 1}
        with self.assertWarnsRegex(tribo.RunWarning, "the measure of v=2 failed: KeyError: there is no column 'velx:blok'"):
            table = tribo.sweep("block.fmcmd", v=[1, 2], measure=misspelt)
        self.assertEqual(list(table["outcome"]), ["finished", "finished"])
        self.assertEqual(table["last"][0], 1)
        self.assertTrue(np.isnan(table["last"][1]))
        self.assertIsNone(table.errors[0])
        self.assertIsInstance(table.errors[1], KeyError)
        self.assertIn("no column 'velx:blok'", table["measure_error"][1])
        self.assertIn("no column 'velx:blok'", pathlib.Path("block.sweep/sweep.csv").read_text())

        again = table.measure(lambda results: {"last": results.history["velx:block"][-1]})
        self.assertNotIn("measure_error", again)
        self.assertEqual(again.errors, [None, None])
        np.testing.assert_array_equal(again["last"], again["velx:block"])
        self.assertNotIn("measure_error", pathlib.Path("block.sweep/sweep.csv").read_text())
        with self.assertWarnsRegex(tribo.RunWarning, "TypeError"):
            self.assertIsInstance(table.measure(lambda results: results.history).errors[0], TypeError)

    def test_measures_of_runs_that_were_done_before(self):
        self.assertEqual(run_program("sweep", "block.fmcmd", "v=1,2", "mu=0", "-o", "done").returncode, 0)
        table = tribo.open_sweep("done")
        self.assertEqual(table.parameters, ["v", "mu"])
        self.assertEqual([results.status for results in table.results], ["finished", "finished"])
        self.assertEqual(list(table.measure(lambda r: r.history["velx:block"][0])["measure"]), [1, 2])
        self.assertEqual(list(tribo.open_sweep("done")["measure"]), [1, 2])
        pathlib.Path("far.fmcmd").write_text(script.replace("TimeStep 2e-4,0.02", "TimeStep 2e-3,0.4"))
        run_program("sweep", "far.fmcmd", "v=0.1,9", "--set", "mu=0", "-o", "far")
        far = tribo.open_sweep("far")
        self.assertIsNone(far.results[1])
        self.assertIsInstance(far.errors[1], tribo.TriboError)
        self.assertTrue(np.isnan(far.measure(lambda r: 3)["measure"][1]))
        with self.assertRaises(tribo.OutputError):
            tribo.open_sweep("nothing")

    def test_laws_of_python_need_one_process(self):
        @tribo.register
        class SweptFriction(tribo.ContactLaw):
            """Faces without friction."""

            parameters = {"coeff": tribo.Parameter(low=0)}

            def response(self, s):
                return s.frictional(0.0) if s.normal_contact().closed else None

        pathlib.Path("own.fmcmd").write_text(script.replace("CoulombFriction", "SweptFriction"))
        with self.assertRaisesRegex(tribo.UsageError, r"the laws SweptFriction are written in Python .* processes=1"):
            tribo.sweep("own.fmcmd", v=[1, 2], processes=2)
        self.assertFalse(os.path.exists("own.sweep"))
        self.assertEqual(list(tribo.sweep("own.fmcmd", v=[1, 2])["outcome"]), ["finished"] * 2)
        self.assertEqual(list(tribo.sweep("block.fmcmd", v=[1, 2], processes=2)["outcome"]), ["finished"] * 2)

    def test_picture(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("matplotlib is not installed")
        ax = tribo.sweep("block.fmcmd", v=[1, 2], mu=[0, 0.5]).plot("v", "velx:block")
        self.assertEqual(len(ax.lines), 2)

    def test_usage_of_the_program(self):
        for wrong in (["v"], ["=1"], ["v="], ["v=1,,2"], ["v=1,1"], ["v=1", "v=2"], []):
            done = run_program("sweep", "block.fmcmd", *wrong)
            self.assertEqual(done.returncode, 2, wrong)
        self.assertEqual(run_program("sweep", "block.fmcmd", "w=1").returncode, 3)
        self.assertEqual(run_program("sweep", "block.fmcmd", "v=1", "--quiet").returncode, 0)
        self.assertEqual(run_program("sweep", "block.fmcmd", "v=1").returncode, 5)
        self.assertEqual(run_program("sweep", "block.fmcmd", "v=1", "--overwrite").returncode, 0)

    def test_stop_of_the_program(self):
        pathlib.Path("long.fmcmd").write_text(script.replace("TimeStep 2e-4,0.02", "TimeStep 1e-6,0.02"))
        child = subprocess.Popen([program, "sweep", "long.fmcmd", "v=1,2,3", "-j", "2"], stdout=subprocess.PIPE, text=True)
        begun = lambda: all(os.path.exists(f"long.sweep/v={v}/checkpoint.bin") for v in (1, 2))
        while not begun() and child.poll() is None:
            time.sleep(0.02)
        child.send_signal(signal.SIGTERM)
        child.communicate(timeout=60)
        self.assertEqual(child.returncode, 6)
        self.assertEqual(list(tribo.Table.read("long.sweep/sweep.csv")["outcome"]), ["stopped", "stopped", "not run"])


if __name__ == "__main__":
    unittest.main()
