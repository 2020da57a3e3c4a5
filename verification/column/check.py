# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

heights = {1e6: 49.0133301, 1e5: 41.3030315, 1e4: 16.1695941}
relaxation = {1e6: dict(end=10, ramp=3, alpha=6), 1e5: dict(end=40, ramp=10, alpha=2), 1e4: dict(end=120, ramp=30, alpha=0.6)}


def solve(case, kernel, E, cells):
    out = case.run(f"{kernel}_{E:g}_{cells}", entities=dict(h=50 / cells, kernel=kernel, E=E, **relaxation[E]))
    data, e = verify.last_particles(out), verify.energy(out)
    case.check(f"{kernel}, E = {E:g}, {cells} cells: residual of the energy over what gravity released", np.abs(e["residual"]).max() / np.abs(e["external_work"] - e["potential"]).max(), 0, 0.02, "at most")
    Y = data["points"][:, 1] - data["displacement"][:, 1]
    error = math.sqrt(((data["stress"][:, 1] + 800 * (50 - Y)) ** 2).mean()) / 40000
    top = Y.argmax()
    # The topmost particle is a quarter cell below the top, where there is no stress and no strain.
    return error, data["points"][top, 1] + (50 - Y[top]), Y, data["stress"][:, 1]


def run(case):
    curves = {}
    for E, demand in ((1e6, 2e-3), (1e5, 1e-2), (1e4, 1e-2)):
        if case.quick and E != 1e6:
            continue
        cells = [32, 64] if case.quick else [16, 32, 64]
        results = [solve(case, "lCPDI", E, n) for n in cells]
        curves[E] = results[-1][2:]
        case.check(f"E = {E:g}, 64 cells: RMS stress error", results[-1][0], 0, demand, "at most")
        case.check(f"E = {E:g}: 1.5 minus order of the stress between 32 and 64 cells", 1.5 - math.log2(results[-2][0] / results[-1][0]), 0, 0.05, "at most")
        case.check(f"E = {E:g}, 64 cells: height", results[-1][1], heights[E], 1e-3)
    if not case.quick:
        case.check("quadratic, E = 1e4, 64 cells: RMS stress error", solve(case, "quadratic", 1e4, 64)[0], 0, 0.01, "at most")

    def draw(axes):
        for E, (Y, stress) in curves.items():
            axes.plot(stress / 1000, Y, ".", markersize=3, label=f"E = {E:g}")
        axes.plot([-40, 0], [0, 50], "k-", linewidth=0.7, label="exact")
        axes.set_xlabel("vertical stress [kPa]")
        axes.set_ylabel("height before [m]")
        axes.legend(fontsize=8)

    case.figure("column", draw)
