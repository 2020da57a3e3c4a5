# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify
import vtp

weight = 1000 * 10.0
E = 1e8


def column(case, h):
    out = case.run(f"column_{h:g}", entities=dict(h=h))
    files = vtp.collection(out)
    states = [vtp.read(file) for _, file in files]
    profile = []
    for data in states[1:]:
        u = data["displacement"][:, 1]
        profile.append((data["points"][:, 1] - u, u, data["stress"][:, 1], data["material"]))
    rest, dug, filled, light = profile

    def rms(x):
        return math.sqrt((x**2).mean())

    base = 10 * weight
    case.check(f"cells {h:g}: RMS stress error at rest", rms(rest[2] + weight * (10 - rest[0])) / base, 0, 0.005, "at most")
    case.check(f"cells {h:g}: number of particles left", len(dug[0]), len(rest[0]) / 2, 0)
    case.check(f"cells {h:g}: RMS stress error of the lower half", rms(dug[2] + weight * (5 - dug[0])) / base, 0, 0.005, "at most")
    heave = 5 * weight / E
    case.check(f"cells {h:g}: RMS error of the heave", rms(dug[1] - heave * dug[0]) / (5 * heave), 0, 0.01, "at most")
    Y, u, stress, material = filled
    case.check(f"cells {h:g}: number of particles with the fill", len(Y), len(rest[0]), 0)
    case.check(f"cells {h:g}: RMS stress error with the fill", rms(stress + weight * (10 - Y)) / base, 0, 0.01, "at most")
    low, fill = Y < 5, Y > 5
    case.check(f"cells {h:g}: RMS displacement of the lower half under the fill", rms(u[low]) / (5 * heave), 0, 0.02, "at most")
    # The fill goes down with the lower half, which had heaved.
    y = Y[fill] - 5
    settled = -5 * heave - weight * (5 * y - y**2 / 2) / E
    case.check(f"cells {h:g}: RMS error of the settlement of the fill", rms(u[fill] - settled) / np.abs(settled).max(), 0, 0.02, "at most")
    case.check(f"cells {h:g}: RMS stress error with half of gravity", rms(light[2] + 0.5 * weight * (10 - light[0])) / base, 0, 0.01, "at most")
    e = verify.energy(out)
    case.check(f"cells {h:g}: residual of the energy at the end over the elastic energy at rest", abs(e["residual"][-1]) / e["elastic"][0], 0, 0.005, "at most")
    return profile


def run(case):
    profile = column(case, 0.5)
    if not case.quick:
        profile = column(case, 0.25)
    rows = verify.history(case.run("blocks", file="blocks.xml"))
    time, speed = rows["time"], rows["velx:box"]

    def acceleration(begin, end):
        a, b = (np.abs(time - t).argmin() for t in (begin, end))
        return (speed[b] - speed[a]) / (time[b] - time[a])

    friction = math.tan(math.radians(10))
    case.check("box: speed while it holds", np.abs(speed[(time > 0.1) & (time < 0.2)]).max(), 0, 0.02, "at most")
    case.check("box: acceleration with the friction of the stage", acceleration(0.22, 0.3), 4 - 10 * friction, 5e-3)
    case.check("box: deceleration without the push", -acceleration(0.32, 0.4), 10 * friction, 5e-3)

    def draw(axes):
        for (Y, _, stress, _), label in zip(profile, ("at rest", "excavated", "filled", "half of gravity")):
            axes.plot(stress / 1000, Y, ".", markersize=3, label=label)
        axes.set_xlabel("vertical stress [kPa]")
        axes.set_ylabel("height before [m]")
        axes.legend(fontsize=8)

    case.figure("stages", draw)
