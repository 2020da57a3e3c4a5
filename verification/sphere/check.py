# SPDX-License-Identifier: MIT
import numpy as np

import verify

E, R, nu, mass, v0 = 1e6, 0.5, 0.3, 523.5987755982989, 0.1


def meeting(share):
    """Duration and largest force; `share` of the displacement at the centre counts."""
    force = np.linspace(0, 3000, 300001)
    way = (0.75 * force * (1 - nu**2) / (E * np.sqrt(R))) ** (2 / 3) - share * (1 + nu) * (3 - 2 * nu) / (2 * np.pi * E * R) * force
    x, v, t, dt, most = 0.0, v0, 0.0, 1e-5, 0.0
    while x >= 0:
        f = np.interp(x, way, force)
        v -= f / mass * dt
        x += v * dt
        t, most = t + dt, max(most, f)
    return t, most


def run(case):
    if case.quick:
        return
    got = verify.history(case.run("ball"))
    t, force = got["time"], 4 * got["contacty:ball"]
    on = t[force > 1e-3 * force.max()]
    (long, weak), (short, strong) = meeting(0), meeting(1)
    case.check("duration, from the middle of the bounds", on[-1] - on[0], 0.5 * (long + short), 0.5 * (long - short) / (0.5 * (long + short)) + 0.01)
    case.check("largest force, from the middle of the bounds", force.max(), 0.5 * (weak + strong), 0.5 * (strong - weak) / (0.5 * (weak + strong)) + 0.01)
    case.check("speed after the rebound, over the first: below 0.95 by", 0.95 - got["vely:ball"][-1] / v0, 0, 0, "at most")
    case.check("tension over the largest force", -force.min() / force.max(), 0, 1e-9, "at most")
