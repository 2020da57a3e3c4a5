# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify
import vtp

c, phi, confining = 0.5, math.radians(30), 1.0


def strength(a):
    return confining + 2 * (c + confining * math.tan(phi)) / ((1 - math.tan(phi) / math.tan(a)) * math.sin(2 * a))


def press(case, angle, **entities):
    rise = 6.5 * math.tan(math.radians(angle))
    line = dict(x1="-1.5", y1=str(17 - rise), x2="11.5", y2=str(17 + rise))
    out = case.run(f"angle{angle}", entities=line | entities)
    rows = []
    for t, path in vtp.collection(out, "joints"):
        d = vtp.read(path)
        rows.append([t, d["area"] @ d["slip"] / d["area"].sum()])
    t, slip = np.array(rows).T
    got = verify.history(out)
    return t, slip, got["time"], -got["reactiony:-1"] / 10


def run(case):
    if case.quick:
        return
    curves = {}
    for angle in (45, 52, 60, 68):
        t, slip, time, stress = press(case, angle)
        sliding = time >= np.interp(0.06, slip, t)  # along its whole length
        case.check(f"{angle} degrees: strength [MPa]", stress[sliding].mean(), strength(math.radians(angle)), 2e-2)
        curves[angle] = time, stress
    t, slip, time, stress = press(case, 25, end="42")
    case.check("25 degrees: load [MPa]", stress[-1], 2 * strength(math.radians(45)), 0.25)
    case.check("25 degrees: slip under that load, which is twice the largest of the others [mm]", slip[-1], 0, 1e-4, "at most")

    def draw(axes):
        for angle, (time, stress) in curves.items():
            line, = axes.plot(time, stress, label=f"{angle} degrees")
            axes.axhline(strength(math.radians(angle)), color=line.get_color(), linestyle="--", linewidth=0.8)
        axes.set_xlabel("time [ms]")
        axes.set_ylabel("axial stress [MPa]")
        axes.legend()

    case.figure("joint_weakness", draw)
