# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

N, K = 0.5e6, 1e7
peak, residual = N * math.tan(math.radians(30)), N * math.tan(math.radians(20))


def run(case):
    out = case.run("push")
    h = verify.history(out)
    force, u, time = -h["forcex:piston"], h["dispx:slider"], h["time"]
    jumps = np.flatnonzero(np.diff(force) < -0.02 * peak)
    starts = [jumps[0]] + [b for a, b in zip(jumps, jumps[1:]) if time[b] - time[a] > 0.2]
    case.check("events", len(starts), 2, 0, "absolute")
    for k, start in enumerate(starts):
        before, after = start - 60, start + 60
        case.check(f"event {k + 1}: force before it [kN]", force[start - 5:start + 1].max() * 1e-3, peak * 1e-3, 2e-2)
        moved = np.median(u[after:after + 200]) - u[start - 5]
        case.check(f"event {k + 1}: slip [mm]", moved * 1e3, 2 * (peak - residual) / K * 1e3, 2e-2)
        low = force[start:after].min()
        case.check(f"event {k + 1}: force after it [kN]", low * 1e-3, (2 * residual - peak) * 1e-3, 4e-2)
    case.check("time between events [s]", time[starts[1]] - time[starts[0]], 2 * (peak - residual) / K / 0.004, 2e-2)
