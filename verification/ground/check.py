# SPDX-License-Identifier: MIT
import numpy as np

import verify

# settlement of the surface if the weight came suddenly to rest: sum of the layers' strains, modulus M of one-dimensional compression
M = 0.7 / (1.3 * 0.4)
settlement = 18e3 * 8**2 / 2 / (1e7 * M) + (18e3 * 8 * 2 + 22e3 * 2**2 / 2) / (1e8 * M)


def run(case):
    for kernel in ("uGIMP", "quadratic") if not case.quick else ("uGIMP",):
        p = verify.last_particles(case.run("rest" + kernel, entities=dict(kernel=kernel)))
        u = p["displacement"][:, 1]
        y = p["points"][:, 1] - u
        weight = np.where(y > 2, 18e3 * (10 - y), 18e3 * 8 + 22e3 * (2 - y))
        case.check(f"{kernel}: largest movement over the settlement without initial stress", np.abs(p["displacement"][:, :2]).max() / settlement, 0, 0.01, "at most")
        case.check(f"{kernel}: vertical stress, largest error over that at the bottom", np.abs(p["stress"][:, 1] + weight).max() / weight.max(), 0, 0.01, "at most")
        case.check(f"{kernel}: horizontal stress, largest error over that at the bottom", np.abs(p["stress"][:, 0] + 0.8 * weight).max() / weight.max(), 0, 0.01, "at most")
    # the same from a borehole: a table of one column of points
    depth = np.arange(0, 10.01, 0.25)
    vertical = -np.where(depth > 2, 18e3 * (10 - depth), 18e3 * 8 + 22e3 * (2 - depth))
    hole = case.scratch / "borehole.csv"
    hole.write_text("x, y, xx, yy, zz\n" + "".join(f"0, {y:g}, {0.8 * s:g}, {s:g}, {0.8 * s:g}\n" for y, s in zip(depth, vertical)))
    p = verify.last_particles(case.run("borehole", entities=dict(stress=f"<InitialStress file='{hole}'/>")))
    case.check("from a borehole: largest movement over the settlement without initial stress", np.abs(p["displacement"][:, :2]).max() / settlement, 0, 0.01, "at most")
    if case.quick:
        return
    p = verify.last_particles(case.run("settles", entities=dict(stress="", damping="<PDamping>20</PDamping>", end="6")))
    u = p["displacement"][:, 1]
    case.check("without initial stress: settlement of the surface", -u.min(), settlement, 0.03)
