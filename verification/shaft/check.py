# SPDX-License-Identifier: MIT
import numpy as np

import verify

R, density, spin, mu, pressure = 0.1, 1000, 30, 0.1, 1e5
strain = 1 - np.exp(-pressure * 1.3 * 0.4 / 4e6)
rim = R * (1 - strain)


def torque(out, friction):
    """Mean torque from when the ring has shrunk until just before the shaft stops, over what friction can do; mean
    pressure; spin at the end over that at the beginning."""
    got = verify.history(out)
    t, L = got["time"], got["Lpz:shaft"]
    stopped = t[np.argmax(L <= 0.02 * L[0])] if (L <= 0.02 * L[0]).any() else t[-1]
    slides = (t > 0.0045) & (t < stopped - 3e-4)
    # A disc that spins within a rigid ring presses on it by a quarter of density * (speed of the rim)^2
    press = pressure + density * (spin * L[slides] / L[0] * rim) ** 2 / 4
    measured = -np.polyfit(t[slides], L[slides], 1)[0]
    mean = -0.5 * (got["sxx:shaft"] + got["syy:shaft"])[t > 0.006].mean()
    return measured / (friction * 2 * np.pi * rim**2 * press.mean()), mean, abs(L[-10:]).max() / L[0]


def run(case):
    sizes = ("0.005",) if case.quick else ("0.005", "0.0025")
    for h in sizes:
        for impulses in ("nodes", "faces") if not case.quick else ("faces",):
            cells = round(R / float(h))
            ratio, mean, last = torque(case.run(f"{impulses}{h}", entities={"h": h, "impulses": impulses}), mu)
            label = f"R = {cells} cells, impulses on {impulses}"
            case.check(f"{label}: torque over mu p 2 pi R^2", ratio, 1, 0.03 if impulses == "faces" and cells == 20 else 0.02)
            case.check(f"{label}: pressure", mean, pressure, 0.02)
            case.check(f"{label}: at rest at the end", last, 0, 0.04, "absolute")
    if case.quick:
        return
    # Without friction nothing but the unevenness of the rims resists: as if friction were 0.002 at most
    ratio, mean, _ = torque(case.run("smooth", entities={"mu": "0"}), 1)
    case.check("without friction: torque over p 2 pi R^2", ratio, 0, 0.002, "absolute")
