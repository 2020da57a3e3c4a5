# SPDX-License-Identifier: MIT
import numpy as np

import verify

G, lame, J = 1 / 2.6, 0.3 / (1.3 * 0.4), 0.5
vertical = G / J * (J**2 - 1) + 0.5 * lame * (J - 1 / J)
pressure = -(vertical + lame * (J - 1 / J)) / 3


def press(case, impulses, angle, mode=None):
    """`impulses`: where they act; `mode`: what the command file says about them, by default just that."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turned = dict(c=repr(c), s=repr(s), left="-1.4", high="2") if angle else {}
    if impulses == "nodes":
        turned |= dict(start="-0.2", end="1.2")
    label = f"impulses on {impulses}{', as the program chooses' if mode else ''}" + (f", turned by {angle} degrees" if angle else "")
    out = case.run(f"{impulses}{angle}{'_chosen' if mode else ''}", entities=dict(contact=mode or f"<MultiMaterialMode Impulses='{impulses}'/>", **turned))
    p = verify.last_particles(out)
    filling = p["von_mises"] > 0
    x = p["points"][filling][:, :2] @ np.array([[c, -s], [s, c]])
    past = np.maximum(np.maximum(-x, x - np.array([1, 0.5])), 0).max() / 0.05
    case.check(f"{label}: how far the deepest particle lies past a wall, over the cell", past, 0, 0 if impulses == "nodes" else 0.25, "at most")
    if impulses == "faces":
        got = verify.history(out)
        force = c * got["contacty:filling:piston"][-1] - s * got["contactx:filling:piston"][-1]
        case.check(f"{label}: force on the piston", force, vertical, 0.01)
        case.check(f"{label}: mean pressure", p["pressure"][filling].mean(), pressure, 0.01)


def run(case):
    for impulses in ("faces", "nodes"):
        for angle in (0, 17, 45):
            if impulses == "faces" and angle == 0:
                press(case, impulses, angle, "<MultiMaterialMode/>")
            if case.quick:
                return
            press(case, impulses, angle)
