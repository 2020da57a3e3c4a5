# SPDX-License-Identifier: MIT
import numpy as np

import verify
import vtp

along, against, R = 4.905, 8.49570921, 0.5


def disc(case, label, turned=0, **entities):
    """Time, speed and spin of the disc, and its moment of inertia over m R^2."""
    c, s = np.cos(np.radians(turned)), np.sin(np.radians(turned))
    if turned:
        x, y = 2.9 * c + 0.2, 2.9 * s + 1.4 * c
        grid = f"<Grid xmin='-1.6' xmax='{x}' ymin='-0.9' ymax='{y}'><Horiz cellsize='&h;'/><Vert cellsize='&h;'/></Grid>"
        entities = entities | dict(c=repr(c), s=repr(s), grid=grid)
    out = case.run(label, entities=entities)
    p = vtp.read(vtp.collection(out)[-1][1])
    x = p["points"][p["von_mises"] > 0][:, :2]
    inertia = ((x - x.mean(0)) ** 2).sum(1).mean() / R**2
    got = verify.history(out)
    mass = np.hypot(got["px:disc"][-1], got["py:disc"][-1]) / np.hypot(got["velx:disc"][-1], got["vely:disc"][-1])
    spin = got["Lpz:disc"] - (got["posx:disc"] * got["py:disc"] - got["posy:disc"] * got["px:disc"])
    return got["time"], c * got["velx:disc"] + s * got["vely:disc"], -spin / (mass * inertia * R**2), inertia


def slope(t, q):
    return np.polyfit(t[t > 0.5], q[t > 0.5], 1)[0]


def run(case):
    # Half the cell with four times the stiffness: the contact is 2.8 cells wide in both
    for h, E, tolerance in (("0.025", "1e6", 0.02), ("0.0125", "4e6", 0.01)) if not case.quick else (("0.05", "1e6", 0.05),):
        t, v, w, k = disc(case, f"roll{h}", h=h, E=E)
        cells = round(R / float(h))
        case.check(f"rolling, R = {cells} cells: acceleration", slope(t, v), along / (1 + k), tolerance)
        case.check(f"rolling, R = {cells} cells: spin", slope(t, w), along / (1 + k) / R, tolerance)
    if case.quick:
        return
    for angle in (17, 45):
        t, v, w, k = disc(case, f"turned{angle}", angle)
        case.check(f"rolling, R = 20 cells, turned by {angle} degrees: acceleration", slope(t, v), along / (1 + k), 0.02)
        case.check(f"rolling, R = 20 cells, turned by {angle} degrees: spin", slope(t, w), along / (1 + k) / R, 0.02)
    slippery = "<Material Type='CoulombFriction' Name='law'><coeff>{}</coeff></Material>"
    t, v, w, k = disc(case, "slip", law=slippery.format(0.1))
    case.check("sliding, mu = 0.1: acceleration", slope(t, v), along - 0.1 * against, 3e-3)
    case.check("sliding, mu = 0.1: spin", slope(t, w), 0.1 * against / (k * R), 0.08)
    t, v, w, k = disc(case, "turned_slip", 17, law=slippery.format(0.1))
    case.check("sliding, mu = 0.1, turned by 17 degrees: acceleration", slope(t, v), along - 0.1 * against, 3e-3)
    t, v, w, k = disc(case, "grip", law=slippery.format(0.2), pull="0", press="min(t/0.2,1)", speed="1", end="0.6", h="0.0125", E="4e6")
    case.check("sliding at 1 m/s on the level, mu = 0.2: speed when it rolls", v[t > 0.4].mean(), 1 / (1 + k), 0.02)
