# SPDX-License-Identifier: MIT
import numpy as np

import verify
import vtp


def change(case, kernel, h, points):
    files = vtp.collection(case.run(f"{kernel}_{h}_{points}", entities=dict(h=h, kernel=kernel, points=points)))

    def stress(path):
        data = vtp.read(path)
        return data["stress"][np.argsort(data["id"])]

    start = stress(files[0][1])
    return max(np.sqrt(((stress(path) - start) ** 2).mean() / (start**2).mean()) for _, path in files[1:])


def run(case):
    case.check("uGIMP, 20 cells: RMS change of stress", change(case, "uGIMP", 0.1, 16), 0, 1e-2, "at most")
    case.check("CPDI, 20 cells: RMS change of stress", change(case, "lCPDI", 0.1, 16), 0, 1e-3, "at most")
    if not case.quick:
        case.check("cubic, 40 cells: RMS change of stress", change(case, "cubic", 0.05, 16), 0, 1e-3, "at most")
        case.check("quadratic, 80 cells: RMS change of stress", change(case, "quadratic", 0.025, 16), 0, 1e-3, "at most")
