# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

g, slope = 9.81, math.radians(30)
mass = 2500 * 0.5
press, pull = mass * g * math.cos(slope), mass * g * math.sin(slope)


def turned(degrees):
    """Entities that turn bed, block and gravity by an angle against the grid."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    gx, gy = g * math.sin(slope), -g * math.cos(slope)
    return dict(c=repr(c), s=repr(s), angle=repr(degrees), gx=repr(c * gx - s * gy), gy=repr(s * gx + c * gy),
                along_x=repr(c * gx), along_y=repr(s * gx))


def along(got, kind, degrees):
    """Components of a history along and against the bed."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    x, y = got[kind.format("x")], got[kind.format("y")]
    return c * x + s * y, c * y - s * x


def stress_against_the_bed(out, degrees):
    """Normal stress of the block across the bed, at rest."""
    import vtp

    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    path = [path for time, path in vtp.collection(out, "blocks") if abs(time - 0.4) < 1e-3][0]
    xx, yy, _, xy = vtp.read(path)["stress"][0][:4]
    return s * s * xx + c * c * yy - 2 * s * c * xy


def slide(case, degrees, mu):
    name = f"{degrees} degrees, mu = {mu}"
    folder = case.run(f"bed{degrees}_{mu}", "bed.xml", dict(turned(degrees), mu=str(mu)))
    got = verify.history(folder)
    t = got["time"]
    speed, _ = along(got, "vel{}:boulder", degrees)
    tangential, normal = along(got, "contact{}:boulder", degrees)
    rest = (t > 0.35) & (t < 0.4)
    case.check(f"{name}: weight carried / weight", normal[rest].mean() / press, 1, 5e-3)
    case.check(f"{name}: stress of the block across the bed / -weight height/(2 volume)",
               stress_against_the_bed(folder, degrees) / (-press * 0.25 / 0.5), 1, 2e-2)
    late = t > 0.6
    if mu < math.tan(slope):
        rate = np.polyfit(t[late], speed[late], 1)[0]
        case.check(f"{name}: acceleration [m/s^2]", rate, g * (math.sin(slope) - mu * math.cos(slope)), 5e-3)
        case.check(f"{name}: friction / (mu weight)", -tangential[late].mean() / (mu * press), 1, 5e-3)
    else:
        way, _ = along(got, "disp{}:boulder", degrees)
        case.check(f"{name}: creeps by [m]", abs(way[late][-1] - way[late][0]), 0, 1e-5, "at most")
    out = verify.table(f"{case.scratch}/bed{degrees}_{mu}.out/block_energy.csv")
    case.check(f"{name}: residual of the block's energy / work of gravity",
               np.abs(out["residual"]).max() / np.abs(out["potential"]).max(), 0, 1e-6, "at most")


def roll(case, cells, E, tolerance):
    """A disc on the bed. It sinks by less than a hundredth of its radius."""
    folder = case.run(f"disc{cells}_{E}", "disc.xml", dict(h=repr(0.5 / cells), E=E))
    got = verify.history(folder)
    t, speed = got["time"], got["velx:boulder"]
    late = t > 0.55
    case.check(f"disc with a radius of {cells} cells on a bed of {float(E) / 1e6:g} MPa: acceleration [m/s^2]",
               np.polyfit(t[late], speed[late], 1)[0], g * math.sin(slope) / 1.5, tolerance)


def run(case):
    slide(case, 0, 0.3)
    roll(case, 5, "1e8", 2e-2)
    if case.quick:
        return
    slide(case, 0, 0.7)
    roll(case, 5, "1e7", 2e-2)
    roll(case, 10, "1e8", 2e-2)
    roll(case, 10, "1e7", 2e-2)
    slide(case, 17, 0.3)
    slide(case, 17, 0.7)
