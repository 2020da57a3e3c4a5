# SPDX-License-Identifier: MIT
"""Runs that are taken step by step, and the arrays of their particles."""

import gc
import os
import pathlib
import unittest

import numpy as np
import tribo
from common import InFolder, root, script, sliding_block


class Stepping(InFolder):
    def test_same_files_as_a_run(self):
        times = []
        for frame in tribo.simulate("block.fmcmd", folder="stepped"):
            times.append(frame.time)
        results = tribo.run("block.fmcmd")
        self.assert_same_results("stepped", results.folder)
        np.testing.assert_array_equal(times, results.times)

    def test_frames_are_those_of_the_files(self):
        frames = [(f.particles["velocity"], f.particles["position"], f.particles["stress"], f.particles["id"])
                  for f in tribo.simulate("block.fmcmd", set={"v": 1})]
        results = tribo.run("block.fmcmd", set={"v": 1})
        with open("block.fmcmd") as file, open("exact.fmcmd", "w") as exact:
            exact.write(file.read() + 'XMLData "MPMHeader"\n<DoublePrecision/>\nEndXMLData\n')
        full = tribo.run("exact.fmcmd", set={"v": 1})
        self.assertEqual(len(frames), len(results.frames))
        for seen, rounded, written in zip(frames, results.frames, full.frames):
            for array, name in zip(seen, ("velocity", "position", "stress", "id")):
                np.testing.assert_array_equal(array, written[name])
                # Fields of files have single precision by default, positions and numbers do not
                kind = np.float32 if name in ("velocity", "stress") else array.dtype
                self.assertEqual(rounded[name].dtype, kind)
                np.testing.assert_array_equal(array.astype(kind), rounded[name])

    def test_steps(self):
        with tribo.simulate("block.fmcmd") as simulation:
            first = simulation.frame
            self.assertEqual((first.time, first.step), (0.0, 0))
            second = simulation.advance(7)
            self.assertEqual(second.step, 7)
            self.assertGreater(second.time, 0)
            with self.assertRaisesRegex(RuntimeError, "has gone on"):
                first.bodies
            self.assertEqual([f.step for f in simulation][:2], [25, 50])
            self.assertTrue(simulation.finished)
            self.assertIsNone(simulation.advance())
        steps = [f.step for f in tribo.simulate("block.fmcmd", every=30)]
        self.assertEqual(steps[:3], [0, 30, 60])
        with self.assertRaises(ValueError):
            tribo.simulate("block.fmcmd", every=0)

    def test_tables_while_it_stands(self):
        for frame in tribo.simulate("block.fmcmd"):
            history, energy = frame.history, frame.energy
            self.assertLessEqual(history["time"][-1], frame.time + 1e-12)
        self.assertEqual(history.rows, 21)
        self.assertIn("residual", energy)

    def test_close_leaves_a_checkpoint(self):
        whole = tribo.run("block.fmcmd", folder="whole")
        with tribo.simulate("block.fmcmd", folder="part") as simulation:
            simulation.advance(11)
        self.assertEqual(tribo.open("part").status, "stopped")
        tribo.resume("part")
        self.assert_same_results(whole.folder, "part")

    def test_temporary_results_vanish(self):
        simulation = tribo.simulate("block.fmcmd")
        simulation.advance()
        folder = simulation.folder
        self.assertTrue(os.path.exists(folder))
        simulation.close()
        self.assertFalse(os.path.exists(folder))

    def test_stages_and_three_dimensions(self):
        staged = script + 'Stage 0.01,"second"\n  Gravity 0,-20\nEndStage\n'
        pathlib.Path("staged.fmcmd").write_text(staged)
        kept = [f.bodies["block"]["velocity_y"] for f in tribo.simulate("staged.fmcmd", folder="staged")]
        tribo.run("staged.fmcmd", folder="plain")
        self.assert_same_results("staged", "plain")
        self.assertEqual(len(kept), 5)

    def test_three_dimensions(self):
        m = tribo.Model("3D", name="cube")
        m.grid(x=(0, 1), y=(0, 1), z=(0, 1), cell=0.25)
        m.material("cube", "LinearElastic", rho=1000, E=1e6, nu=0.2)
        m.body("cube", tribo.box(0.25, 0.75, 0.25, 0.75, 0.25, 0.75), velocity=(1, 2, 3))
        m.time(1e-3)
        m.output(1e-3)
        frames = list((f.time, f.bodies["cube"]["velocity"], f.particles["velocity"]) for f in m.simulate())
        self.assertEqual(frames[-1][1].shape, (64, 3))
        np.testing.assert_allclose(frames[-1][1], np.tile([1, 2, 3], (64, 1)), rtol=1e-9)


class Columns(InFolder):
    def test_no_copy_while_it_stands(self):
        simulation = tribo.simulate("block.fmcmd")
        body = simulation.advance(3).bodies["block"]
        one, two = body["velocity_x"], body["velocity_x"]
        self.assertEqual(one.__array_interface__["data"][0], two.__array_interface__["data"][0])
        self.assertFalse(one.flags.writeable or one.flags.owndata)
        with self.assertRaises(ValueError):
            one[0] = 1
        np.testing.assert_array_equal(body["velocity"][:, 0], one)
        self.assertEqual(len(body.ids), body.count)

    def test_kept_arrays_keep_their_numbers(self):
        simulation = tribo.simulate("block.fmcmd", folder="kept")
        kept = []
        while (frame := simulation.advance(5)) is not None:
            x = frame.bodies["block"]["position_x"]
            kept.append((x[::2], x[::2].copy()))  # a view of the view
            frame.bodies["floor"]["position_x"]  # not kept
        del simulation, frame, x
        gc.collect()
        for now, then in kept:
            np.testing.assert_array_equal(now, then)
        self.assertGreater(len(kept), 10)
        self.assertFalse(np.array_equal(kept[0][1], kept[-1][1]))
        tribo.run("block.fmcmd")
        self.assert_same_results("kept", "block.out")

    def test_writing(self):
        with tribo.simulate("block.fmcmd", set={"mu": 0}) as simulation:
            body = simulation.frame.bodies["block"]
            velocity = body.writable("velocity_x")
            velocity += 1
            np.testing.assert_array_equal(body["velocity_x"], velocity)
            with self.assertRaisesRegex(KeyError, "cannot be changed; valid: velocity_x"):
                body.writable("mass")
            with self.assertRaisesRegex(KeyError, "none of a rigid body"):
                simulation.frame.bodies["floor"].writable("velocity_x")
            frame = simulation.advance(2)
            np.testing.assert_allclose(frame.bodies["block"]["velocity_x"].mean(), 3, rtol=1e-6)

    def test_fields(self):
        frame = tribo.simulate("block.fmcmd").frame
        self.assertIn("von_mises", list(frame.particles))
        self.assertEqual(frame.particles["mass"].shape, frame.particles["id"].shape)
        with self.assertRaisesRegex(KeyError, "did you mean 'velocity'"):
            frame.particles["velocty"]
        with self.assertRaisesRegex(KeyError, "does not keep what 'strain' needs"):
            frame.particles["strain"]
        with self.assertRaisesRegex(KeyError, "has no column 'speed'; valid: position_x"):
            frame.bodies["block"]["speed"]

    def test_blocks_alone_have_no_particles(self):
        simulation = tribo.simulate(root / "input/examples/toppling.xml")
        frame = simulation.advance(5)
        self.assertEqual(frame.step, 5)
        with self.assertRaisesRegex(ValueError, "rigid blocks alone"):
            frame.bodies
        with self.assertRaisesRegex(ValueError, "rigid blocks alone"):
            tribo.run(root / "input/examples/toppling.xml", body_force=lambda x, t: 0 * x)


if __name__ == "__main__":
    unittest.main()
