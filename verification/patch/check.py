# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify


def press(case, label, turned=0.0, **entities):
    """Particles at rest, away from the free sides: height over the lower platen, and stress along it over the exact one."""
    c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
    entities |= dict(c=repr(c), s=repr(s))
    if turned:
        entities["grid"] = "<Grid xmin='-1.8' xmax='1.8' ymin='-1.2' ymax='2'><Horiz cellsize='0.05'/><Vert cellsize='0.05'/></Grid>"
    p = verify.last_particles(case.run(label, entities=entities))
    x, t = p["points"][:, 0] * c + p["points"][:, 1] * s, p["stress"]
    normal = s * s * t[:, 0] + c * c * t[:, 1] - 2 * c * s * t[:, 3]
    middle = (p["von_mises"] > 0) & (abs(x - 0.5) < 0.4)
    return normal[middle] / (-1e-3 / (0.5 * 0.91 * (1 + 1 / float(entities["E"]))))


def run(case):
    for turned in (0, 17, 45) if not case.quick else (0, 17):
        for E in (1, 10) if not case.quick else (1,):
            stress = press(case, f"E{E}_{turned}", turned, E=str(E))
            case.check(f"E 1 : {E}, turned by {turned} degrees: mean stress", stress.mean(), 1, 2e-3)
            case.check(f"E 1 : {E}, turned by {turned} degrees: spread of the stress (RMS)", stress.std(), 0, 0.015 if turned < 45 else 0.025, "at most")
