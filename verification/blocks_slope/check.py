# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify


def slope(angle, friction, end):
    a = math.radians(angle)
    return dict(friction=str(friction), gx=repr(10 * math.sin(a)), gy=repr(-10 * math.cos(a)), end=str(end))


def run(case):
    out = case.run("slides", entities=slope(40, 20, 2.5))
    h = verify.history(out)
    late = h["time"] > 1
    case.check("slides: acceleration [m/s^2]", np.polyfit(h["time"][late], h["velx:block"][late], 1)[0], 3.639702343, 1e-3)
    e = verify.energy(out)
    case.check("slides: energy that is not accounted for / turned over", abs(e["residual"]).max() / e["slip"].max(), 0, 1e-6, "at most")

    rest = {"points='corners'": "points='corners' damping='0.7'"}  # gravity comes at once
    high = {"xmax='10' ymin='0' ymax='5'": "xmax='10' ymin='0' ymax='10'", **rest}
    h = verify.history(case.run("stands", entities=slope(40, 40.1, 4), replace=high))
    weight, area = 2000 * 10 * 10 * 10, 10
    case.check("stands: settles / elastic settlement", np.abs(h["dispy:block"]).max() / (weight * math.cos(math.radians(40)) / (1e7 * area)), 0, 2.1, "at most")
    case.check("stands: velocity at the end [m/s]", abs(h["velx:block"][-1]), 0, 1e-2, "at most")
    case.check("stands: moves along / width", h["dispx:block"][-1] / 10, 0, 5e-2, "at most")

    tall = {"xmax='10' ymin='0' ymax='5'": "xmax='10' ymin='0' ymax='25'", **rest}
    for angle, falls in ((20, 0), (23, 1), (30, 1)):
        h = verify.history(case.run(f"tall {angle}", entities=slope(angle, 40, {20: 12, 23: 7, 30: 4}[angle]), replace=tall))
        tilt = abs(h["turnz:block"])
        case.check(f"25 m high, slope {angle}: topples", float(tilt.max() > 0.15), falls, 0, "absolute")
