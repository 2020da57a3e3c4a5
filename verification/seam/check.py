# SPDX-License-Identifier: MIT
import numpy as np

import verify

runs = (
    ("no gap", {}, 0),
    ("gap of 0.01 cells", dict(gap="0.0005"), 0),
    ("no gap, off the grid by 0.3 cells", dict(shift="0.015"), 0),
    ("no gap, turned by 17 degrees", dict(low="-0.9", high="1"), 17),
    ("no gap, turned by 45 degrees", dict(low="-1.4", high="1.6"), 45),
)


def run(case):
    for label, entities, angle in runs[: 1 if case.quick else None]:
        c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        out = case.run("".join(ch for ch in label if ch.isalnum()), entities=dict(entities, c=repr(c), s=repr(s)))
        got = verify.history(out)
        t, vx, vy = got["time"], got["velx:slider"], got["vely:slider"]
        v, across = c * vx + s * vy, c * vy - s * vx
        # Over the seam from t = 0.62 (front) to 1.22 (end)
        case.check(f"{label}: speed after the seam over that before", v[t > 1.3].mean(), v[(t > 0.4) & (t < 0.55)].mean(), 1e-3)
        case.check(f"{label}: largest speed across on the way over the speed", np.abs(across[t > 0.4]).max() / v[-1], 0, 0.01, "at most")
