import numpy as np

import verify


def run(case):
    for label, entities in (("no gap", {}), ("gap of 0.01 cells", dict(gap="0.0005")), ("no gap, off the grid by 0.3 cells", dict(shift="0.015")))[: 1 if case.quick else 3]:
        got = verify.history(case.run("".join(c for c in label if c.isalnum()), entities=entities))
        t, v = got["time"], got["velx:slider"]
        # Over the seam from t = 0.62 (front) to 1.22 (end)
        case.check(f"{label}: speed after the seam over that before", v[t > 1.3].mean(), v[(t > 0.4) & (t < 0.55)].mean(), 1e-3)
        case.check(f"{label}: largest vertical speed on the way over the speed", np.abs(got["vely:slider"][t > 0.4]).max() / v[-1], 0, 0.01, "at most")
