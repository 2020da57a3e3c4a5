# SPDX-License-Identifier: MIT
"""Laboratory tests of single laws."""

import pathlib
import unittest

import numpy as np
import tribo
from common import InFolder, root, run_program

sand = {"rho": 2000, "E": 1e7, "nu": 0.3, "cohesion": 5e3, "friction": 35, "dilation": 5}


class Drives(InFolder):
    def test_same_table_as_the_program(self):
        example = root / "input/examples/triaxial.xml"
        self.assertEqual(run_program("drive", "--quiet", "-o", "table.csv", example).returncode, 0)
        written = tribo.Table.read("table.csv")
        by_file = tribo.drive(example)
        by_law = tribo.drive(law="MohrCoulomb", properties=sand, test="triaxial_compression", strain=0.06, steps=300,
                             pressure=100e3, units=None)
        for name in written:
            np.testing.assert_array_equal(by_file[name], written[name])
            np.testing.assert_allclose(by_law[name], written[name], rtol=1e-6, atol=1e-6)

    def test_contact_law_along_a_path(self):
        table = tribo.drive(law="CoulombFriction", properties={"coeff": 0.5}, mass=1,
                            path={"dt": 0.01, "steps": [10, 10], "N": 100, "vt1": [1, -1]})
        self.assertEqual(table.rows, 21)
        np.testing.assert_allclose(np.abs(table["St1"][-5:]), 50, rtol=1e-6)

    def test_messages(self):
        with self.assertRaisesRegex(tribo.InputError, "did you mean 'MohrCoulomb'"):
            tribo.drive(law="MohrColoumb", properties=sand, test="simple_shear", strain=0.1)
        with self.assertRaisesRegex(ValueError, "needs a command file or a law"):
            tribo.drive()
        with self.assertRaisesRegex(ValueError, "not so 'vt1'"):
            tribo.drive(law="CoulombFriction", properties={"coeff": 0.5}, path={"dt": [0.1, 0.1, 0.1], "vt1": [1, 2]})


if __name__ == "__main__":
    unittest.main()
