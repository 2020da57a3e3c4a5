# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify
import vtp

area, height, E = 0.05**2, 0.1, 50e9


def even(case, nu):
    """Pulled to a strain of 5e-5 below all strengths, then held."""
    out = case.run(f"even{nu}", entities=dict(nu=str(nu), tension="1e12", speed="t&lt;0.5 ? 1e-5 : 0", end="1.5"))
    h = verify.history(out)
    strain = h["dispz:top"][-1] / height
    name = f"60 cells, nu = {nu}"
    case.check(f"{name}: E [GPa]", 0.5 * (h["forcez:bottom"][-1] - h["forcez:top"][-1]) / area / strain * 1e-9, 50, 1e-3)
    if nu:
        case.check(f"{name}: Poisson's ratio, x", -h["exx"][-1] / h["ezz"][-1], nu, 1e-2)
        case.check(f"{name}: Poisson's ratio, y", -h["eyy"][-1] / h["ezz"][-1], nu, 1e-2)
    got = vtp.read(vtp.collection(out, "blocks")[-1][1])
    stress = got["stress"][:, 2]
    case.check(f"{name}: spread of the blocks' stresses / mean", np.ptp(stress) / stress.mean(), 0, 1e-3, "at most")


def tension(case):
    out = case.run("tension", entities=dict(speed="t&lt;0.3 ? 3.1e-5 : (t&lt;0.4 ? 0 : 2e-6)", end="1.2"))
    h = verify.history(out)
    stress = -h["forcez:top"] / area
    peak = stress.argmax()
    case.check("60 cells, tension: strength / tensile strength", stress[peak] / 5e6, 1, 2e-2)
    case.check("60 cells, tension: bonds broken in shear at the peak", h["broken in shear"][peak], 0, 0, "absolute")
    case.check("60 cells, tension: stress at the end / strength", abs(stress[-1]) / 5e6, 0, 0.1, "at most")
    e = verify.energy(out)
    case.check("60 cells, tension: energy that is not accounted for / work",
               np.abs(e["residual"]).max() / np.abs(e["boundary_work"]).max(), 0, 1e-6, "at most")


def land(case):
    h = verify.history(case.run("land", "land.xml"))
    m, speed, turned = 2500, 2, math.radians(30)
    r = 0.5 * (math.sin(turned) - math.cos(turned))
    impulse = 2 * m * speed / (1 + 6 * r * r)
    case.check("cube on an edge: velocity afterwards [m/s]", h["vely:cube"][-1], impulse / m - speed, 5e-3)
    case.check("cube on an edge: spin afterwards [rad/s]", h["spinz:cube"][-1], 6 * r * impulse / m, 5e-3)
    case.check("cube on an edge: velocity along the floor [m/s]", abs(h["velx:cube"][-1]), 0, 1e-9, "at most")
    case.check("cube on an edge: spin about the other axes [rad/s]", abs(h["spinx:cube"][-1]), 0, 1e-9, "at most")


def run(case):
    land(case)
    even(case, 0)
    if case.quick:
        return
    even(case, 0.2)
    tension(case)
