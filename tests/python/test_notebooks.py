# SPDX-License-Identifier: MIT
"""Runs the code of the notebooks in docs/notebooks, cell by cell, and looks at what comes out."""

import json
import os
import unittest
import warnings

import numpy as np
from common import InFolder, root

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    matplotlib = None


def run_cells(name):
    """The variables after all cells of a notebook."""
    with open(root / "docs/notebooks" / f"{name}.ipynb", encoding="utf-8") as file:
        book = json.load(file)
    variables = {"__name__": "notebook"}
    for k, cell in enumerate(book["cells"]):
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"{name}, cell {k}", "exec"), variables)
            plt.close("all")
    return variables


@unittest.skipIf(matplotlib is None, "matplotlib is not installed")
class Notebooks(InFolder):
    def setUp(self):
        super().setUp()
        warnings.simplefilter("error", RuntimeWarning)

    def test_all_are_tested(self):
        names = {file.stem for file in (root / "docs/notebooks").glob("*.ipynb")}
        self.assertEqual(names, {"first_run", "landslide", "calibration", "joint_shear", "own_contact_law"})

    def test_first_run(self):
        seen = run_cells("first_run")
        self.assertAlmostEqual(seen["results"].history["velx:left"][-1], -18.5, delta=1)
        self.assertLess(min(seen["gaps"]), 3)
        self.assertTrue(os.path.exists("disks.out"))

    def test_landslide(self):
        table = run_cells("landslide")["table"]
        self.assertEqual(list(table["outcome"]), ["finished"] * 6)
        run_out = table["run_out"].reshape(3, 2)
        self.assertTrue(np.all(run_out[:, 0] > run_out[:, 1]))  # less friction on the ground, more run-out
        self.assertGreater(run_out[0, 0], run_out[2, 0])

    def test_calibration(self):
        seen = run_cells("calibration")
        self.assertAlmostEqual(seen["phi"], 35, delta=1)
        self.assertAlmostEqual(seen["c"] / 1e3, 6, delta=2)
        self.assertAlmostEqual(seen["E"] / 1e6, 16, delta=0.5)
        self.assertAlmostEqual(seen["psi"], 10, delta=4)
        self.assertLess(seen["misfit"][-1], seen["misfit"][0] + 1)
        self.assertLess(seen["misfit"][-1], 3e3)

    def test_joint_shear(self):
        seen = run_cells("joint_shear")
        self.assertAlmostEqual(seen["residual_angle"], 28, delta=0.1)
        self.assertTrue(np.all(np.array(seen["peak"]) > seen["residual"]))

    def test_own_contact_law(self):
        seen = run_cells("own_contact_law")
        self.assertLess(seen["error"], 0.1)
        np.testing.assert_allclose(seen["friction"], seen["law"].coefficient(seen["speeds"]), rtol=0.01)


if __name__ == "__main__":
    unittest.main()
