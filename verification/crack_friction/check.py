# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

g = 9.81


def run(case):
    for mu in (0.3, 0.6):
        out = case.run(f"mu{mu}", entities=dict(law=f"<Material Type='CoulombFriction' Name='law'><coeff>{mu}</coeff></Material>"))
        got = verify.history(out)
        steady = got["time"] > 0.6
        if mu == 0.3:
            slope = np.polyfit(got["time"][steady], got["velx:block"][steady], 1)[0]
            case.check("mu = 0.3: acceleration", slope, g * (0.5 - mu * math.sqrt(0.75)), 5e-3)
        else:
            way = got["dispx:block"][steady]
            case.check("mu = 0.6: creep in 0.4 s under the whole load [m]", abs(way[-1] - way[0]), 0, 1e-5, "at most")
            case.check("mu = 0.6: speed at the end [m/s]", abs(got["velx:block"][-1]), 0, 1e-4, "at most")
        if case.quick:
            return
