# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify


def solve(case, kernel, cells):
    h = 1 / cells
    data = verify.last_particles(case.run(f"{kernel}_{cells}", entities=dict(h=h, first=1 + h / 2, kernel=kernel)))
    r = data["points"][:, 0] - data["displacement"][:, 0]
    stress, u = data["stress"] / 1e-3, data["displacement"][:, 0] / 1e-3
    return r, stress[:, 0], stress[:, 2], u


def radial(r):
    return (1 - 4 / r**2) / 3


def hoop(r):
    return (1 + 4 / r**2) / 3


def run(case):
    r, rr, tt, u = solve(case, "quadratic", 20)
    inside = (r > 1.05) & (r < 1.95)
    for name, measured, exact in (("radial", rr, radial(r)), ("hoop", tt, hoop(r))):
        error = abs(measured - exact)
        case.check(f"quadratic: {name} stress, interior, error over p", error[inside].max(), 0, 0.01, "at most")
        case.check(f"quadratic: {name} stress, edges, error over p", error.max(), 0, 0.03, "at most")
    for kernel in ("uGIMP", "quadratic", "lCPDI") if not case.quick else ("quadratic",):
        errors = []
        for cells in (10, 20):
            r, rr, tt, u = solve(case, kernel, cells)
            exact = 1.3 / 3000 * (0.4 * r + 4 / r)
            errors.append(abs(u / exact - 1).max())
        case.check(f"{kernel}: displacement, 20 cells, relative error", errors[-1], 0, 1e-3, "at most")
        case.check(f"{kernel}: displacement, 2 minus order between 10 and 20 cells", 2 - math.log2(errors[0] / errors[1]), 0, 0.2, "at most")
        if kernel != "quadratic":
            cell = np.floor(r * 20)
            means = [(rr[cell == k].mean(), radial(r[cell == k]).mean()) for k in np.unique(cell)[1:-1]]
            case.check(f"{kernel}: radial stress, means of cells, interior, error over p", max(abs(a - b) for a, b in means), 0, 0.01, "at most")
