# SPDX-License-Identifier: MIT
import math

import verify


def run(case):
    for impulses in ("nodes", "faces") if not case.quick else ("nodes",):
        got = verify.history(case.run(impulses, entities=dict(impulses=impulses, end="70" if case.quick else "100")))
        steady = got["time"] > 50
        case.check(f"impulses on {impulses}: T1/T0", got["contacty:belt"][steady].mean() / 5e-5 - 1, math.exp(0.3 * math.pi), 0.05)
