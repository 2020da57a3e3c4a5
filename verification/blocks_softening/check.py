# SPDX-License-Identifier: MIT
import numpy as np

import verify

E, d, length, area, strength, dc = 50e9, 0.005, 0.02, 0.005, 5e6, 4e-6


def run(case):
    out = case.run("pull")
    h, e = verify.history(out), verify.energy(out)
    force, u = h["forcex:left"], h["dispx:right"]
    case.check("peak [kN]", force.max() * 1e-3, strength * area * 1e-3, 1e-3)
    # on the way down the soft bond is stretched by d strength/E + dc (1 - s/strength), the others by s (length - d)/E
    for share in (0.75, 0.25):
        at = (share * (length - d) + d) * strength / E + dc * (1 - share)
        case.check(f"force at {share} of the strength, going down [kN]", np.interp(at, u, force) * 1e-3, share * strength * area * 1e-3, 5e-3)
    case.check("lost by the bond [J]", e["released"][-1], area * strength * (dc + strength * d / E) / 2, 1e-3)
    case.check("stored at the end / lost", e["strain"][-1] / e["released"][-1], 0, 1e-3, "at most")
    case.check("energy that is not accounted for / work", abs(e["residual"]).max() / e["boundary_work"].max(), 0, 1e-6, "at most")
