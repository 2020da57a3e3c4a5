# SPDX-License-Identifier: MIT
import numpy as np

import verify

COLUMNS = {0.5: (0.025, 3, 0.6, 2), 1: (0.05, 4, 1.2, 2.5), 2: (0.05, 7, 2.4, 3), 3: (0.05, 9, 3.4, 4), 5: (0.1, 14, 5.4, 5)}


def deposit(case, a):
    """Run-out, height and outline (x, depth) of what is left of a column."""
    h, right, top, end = COLUMNS[a]
    out = case.run(f"a{a}", entities=dict(a=a, h=h, right=right, top=top, end=end))
    p = verify.last_particles(out)
    x = p["points"]
    depth = np.bincount((x[:, 0] / h).astype(int)) * a / len(x) / h
    still = verify.history(out)["Kinetic Energy"]
    return (np.nonzero(depth >= h)[0].max() + 1) * h - 1, x[:, 1].max(), (np.arange(len(depth)) + 0.5) * h, depth, still[-1] / still.max()


def run(case):
    outlines = {}
    for a in COLUMNS if not case.quick else (2,):
        front, height, x, depth, rest = deposit(case, a)
        outlines[a] = x, depth
        laws = dict(Lube=1.2 * a if a < 1.8 else 1.9 * a ** (2 / 3), Lajeunesse=1.8 * a if a < 3 else 2.3 * a ** (2 / 3), Lagree=2.2 * a)
        case.check(f"a = {a:g}: kinetic energy left over the largest", rest, 0, 1e-3, "at most")
        if a in (0.5, 2, 3, 5):
            low, high = (2.4, 3.6) if a == 2 else (min(laws.values()), max(laws.values()))
            case.check(f"a = {a:g}: run-out in the published band", front, (low + high) / 2, (high - low) / 2, "absolute")
        if a in (0.5, 1):
            case.check(f"a = {a:g}: run-out after Lube", front, laws["Lube"], 0.15)
        if a == 2:
            case.check("a = 2: height of the deposit", height, 1.25, 0.45, "absolute")

    def draw(axes):
        for a, (x, depth) in outlines.items():
            axes.plot(x, np.convolve(depth, np.full(6, 1 / 6), "same"), label=f"a = {a:g}")
        axes.set(xlabel="x / L0", ylabel="depth / L0", title="Deposits of sand columns of height a L0", aspect=2)
        axes.legend()

    case.figure("collapse", draw)
