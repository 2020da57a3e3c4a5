# SPDX-License-Identifier: MIT
"""Runs, checks, errors and stops from Python, compared with the program."""

import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings

import numpy as np
import tribo
from common import InFolder, run_program, script, sliding_block


class Runs(InFolder):
    def test_same_files_as_the_program(self):
        results = tribo.run("block.fmcmd", set={"v": 3}, threads=2)
        self.assertEqual(run_program("run", "--quiet", "--set", "v=3", "-o", "program", "block.fmcmd").returncode, 0)
        self.assert_same_results(results.folder, "program")
        self.assertEqual(results.status, "finished")
        self.assertEqual(results.folder, "block.out")

    def test_refuses_to_replace_results(self):
        tribo.run("block.fmcmd", folder="here")
        with self.assertRaises(tribo.OutputError) as caught:
            tribo.run("block.fmcmd", folder="here")
        self.assertEqual(str(caught.exception), "'here' already holds a run; overwrite=True replaces it, folder=... names another "
                                                "folder, and tribo.resume('here') continues a run that was stopped")
        self.assertIsInstance(caught.exception, OSError)
        tribo.run("block.fmcmd", folder="here", overwrite=True)

    def test_all_errors_of_the_input_at_once(self):
        pathlib.Path("wrong.fmcmd").write_text(script.replace("nu 0.3", "nu 0.7").replace("rho 2000", "rho x"))
        with self.assertRaises(tribo.InputError) as caught:
            tribo.run("wrong.fmcmd")
        error = caught.exception
        program = run_program("run", "wrong.fmcmd")
        self.assertEqual(program.returncode, 3)
        self.assertEqual(program.stderr.strip(), str(error))
        self.assertEqual(len(error.problems), 2)
        self.assertEqual((error.file, error.line), ("wrong.fmcmd", 18))
        self.assertIsInstance(error, ValueError)

    def test_remedies(self):
        pathlib.Path("wrong.fmcmd").write_text(script.replace("CoulombFriction", "CoulombFrictoin"))
        with self.assertRaises(tribo.InputError) as caught:
            tribo.check("wrong.fmcmd")
        self.assertIn("did you mean 'CoulombFriction'?", caught.exception.remedy)
        with self.assertRaises(tribo.InputError):
            tribo.run("block.fmcmd", set={"vv": 3})
        with self.assertRaises(tribo.OutputError):
            tribo.run("missing.fmcmd")

    def test_numerical_error(self):
        pathlib.Path("far.fmcmd").write_text(script.replace("TimeStep 2e-4,0.02", "TimeStep 2e-3,2"))
        with self.assertRaises(tribo.NumericalError) as caught:
            tribo.run("far.fmcmd", set={"mu": 0})
        self.assertIn("left the grid", str(caught.exception))
        self.assertEqual(tribo.open("far.out").status, "failed")

    def test_check(self):
        check = tribo.check("block.fmcmd")
        program = run_program("check", "block.fmcmd").stdout
        without_times = lambda text: [line for line in text.splitlines() if not line.startswith("estimated time")]
        self.assertEqual(without_times(check.rstrip("\n")), without_times(program.rstrip("\n")))
        self.assertIn("set by 'TimeStep'", check.lines["time step"][0])
        self.assertIsInstance(check.advice, list)

    def test_figures_are_remarks_and_no_warnings(self):
        m = tribo.Model("plane strain")
        m.mpm_method("USL", "B2SPLINE")
        m.transfer("PIC")
        m.grid(x=(0, 1), y=(0, 1), cell=0.1)
        m.material("a", "LinearElastic", rho=1000, E=1e6, nu=0.3)
        m.body("a", tribo.rect(0.3, 0.5, 0.3, 0.7), velocity=(1, 0))
        m.body("a", tribo.rect(0.5, 0.7, 0.3, 0.7), velocity=(-1, 0))
        m.time(0.01, courant=0.4)
        m.output(0.01)
        with warnings.catch_warnings():
            warnings.simplefilter("error", tribo.RunWarning)
            results = m.run()
        self.assertRegex(results.provenance["figures"][0], "the transfer between particles and grid dissipated")
        self.assertNotIn("to_look_at", results.provenance)
        self.assertEqual(results.remarks, results.provenance["figures"])
        run_program("report", "model.out")
        self.assertIn("dissipated", pathlib.Path("model.out/report.html").read_text())

    def test_warnings(self):
        pathlib.Path("twice.fmcmd").write_text(script + "Gravity 0,-9.8\n")
        with self.assertWarns(tribo.ModelWarning):
            tribo.check("twice.fmcmd")

    def test_body_force(self):
        m = sliding_block()
        times = []

        def force(x, t):
            times.append(t)
            return [5.0, 0.0]

        free = tribo.run(m, set={"mu": 0}, folder="free")
        driven = tribo.run(m, set={"mu": 0}, folder="driven", body_force=force)
        gained = driven.history["velx:block"] - free.history["velx:block"]
        np.testing.assert_allclose(gained, 5 * driven.history["time"], rtol=1e-6, atol=1e-9)
        self.assertEqual(times, sorted(times))
        work = driven.energy["external_work"][-1]
        self.assertGreater(work, 0)
        self.assertLess(abs(driven.energy["residual"][-1]), 0.01 * work)
        with self.assertRaises(tribo.OutputError):  # the program does not know the function
            tribo.resume("driven")
        with self.assertRaisesRegex(ValueError, r"must give an array of the shape \(48, 2\)"):
            tribo.run(m, folder="wrong", body_force=lambda x, t: [1, 2, 3])
        with self.assertRaisesRegex(ZeroDivisionError, "division"):
            tribo.run(m, folder="wrong2", body_force=lambda x, t: 1 / 0)

    def test_other_threads_go_on(self):
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)

        other = threading.Thread(target=count)
        other.start()
        pathlib.Path("longer.fmcmd").write_text(script.replace("TimeStep 2e-4,0.02", "TimeStep 2e-5,0.02"))
        before = counted[0]
        tribo.run("longer.fmcmd")
        after = counted[0]
        done.set()
        other.join()
        self.assertGreater(after - before, 3)

    def test_wall_time_and_resume(self):
        whole = tribo.run("block.fmcmd", folder="whole")
        stopped = tribo.run("block.fmcmd", folder="stopped", max_wall=1e-6)
        self.assertEqual(stopped.status, "stopped")
        self.assertEqual(tribo.resume("stopped").status, "finished")
        self.assert_same_results(whole.folder, stopped.folder)


class Interrupts(InFolder):
    def test_interrupt_writes_a_checkpoint(self):
        pathlib.Path("long.fmcmd").write_text(script.replace("TimeStep 2e-4,0.02", "TimeStep 1e-6,0.02"))
        code = ("import sys, tribo\ntry:\n  tribo.run('long.fmcmd', folder='long')\n"
                "except KeyboardInterrupt as stop:\n  print(stop); sys.exit(9)\n")
        child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        while not os.path.exists("long/checkpoint.bin") and child.poll() is None:
            time.sleep(0.02)
        child.send_signal(signal.SIGINT)
        text, _ = child.communicate(timeout=60)
        self.assertEqual(child.returncode, 9)
        self.assertIn("tribo.resume('long')", text)
        self.assertEqual(tribo.open("long").status, "stopped")


if __name__ == "__main__":
    unittest.main()
