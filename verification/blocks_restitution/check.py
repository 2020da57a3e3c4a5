# SPDX-License-Identifier: MIT
import math

import verify


def run(case):
    for beta in (0.1, 0.2, 0.4):
        root = math.sqrt(1 - beta * beta)
        whole = math.exp(-math.pi * beta / root)
        free = math.exp(-beta / root * (math.pi - math.atan2(2 * beta * root, 1 - 2 * beta * beta)))
        for mode, expected in ((0, whole), (1, free)):
            out = case.run(f"beta {beta} mode {mode}", entities=dict(beta=str(beta), mode=str(mode)))
            h, e = verify.history(out), verify.energy(out)
            case.check(f"beta {beta}, dp_mode {mode}: restitution", (h["velx:right"][-1] - h["velx:left"][-1]) / 2, expected, 5e-3)
        case.check(f"beta {beta}: energy that is not accounted for / at the start", abs(e["residual"]).max() / e["kinetic"][0], 0, 1e-6, "at most")
