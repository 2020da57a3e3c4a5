# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

WEIGHT, HEIGHT = 2e4, 3.4


def safety(case, label, file, **entities):
    """The bracket of the factor of safety, and the folder of the run that slips."""
    out = case.call("safety", case.deck(label, file, entities, None), case.scratch / f"{label}.out")
    trials = verify.table(f"{out}/safety.csv")
    holds = trials["holds"] > 0
    return trials["factor"][holds].max(), trials["factor"][~holds].min(), out


def critical(number, cohesion, friction):
    """The factor at which a vertical cut of this height fails, if it fails at `number` c tan(45 + phi/2)/gamma."""
    low, high = 0.1, 10.0
    for _ in range(60):
        f = (low + high) / 2
        phi = math.atan(math.tan(friction) / f)
        low, high = (f, high) if number * cohesion / f * math.tan(math.pi / 4 + phi / 2) > WEIGHT * HEIGHT else (low, f)
    return low


def run(case):
    for h in (0.5,) if case.quick else (0.5, 0.25):
        holds, slips, out = safety(case, f"slope_{h}", "case.xml", h=h, tolerance=0.05 if case.quick else 0.01)
        case.check(f"slope 2:1, cells of {h} m: factor of safety between 1.38 and 1.40", (holds + slips) / 2, 1.39, 0.01 + 0.02 * 1.39 + (slips - holds) / 2, "absolute")
    if case.quick:
        return
    p = verify.last_particles(out)

    def draw(axes):
        x, u = p["points"], np.linalg.norm(p["displacement"], axis=1)
        shown = axes.scatter(x[:, 0], x[:, 1], c=1e3 * u, s=2, cmap="viridis", linewidths=0)
        axes.get_figure().colorbar(shown, label="displacement [mm]", shrink=0.5)
        axes.set(xlabel="x [m]", ylabel="y [m]", aspect=1, title=f"A slope that slips: strength divided by {slips:.3g}")

    case.figure("slope", draw)
    for friction, cohesion in ((0, 2e4), (30, 1e4)):
        phi = math.radians(friction)
        low, high = critical(3.776, cohesion, phi), critical(4.0 if friction else 3.83, cohesion, phi)
        holds, slips, _ = safety(case, f"cut_{friction}", "cut.xml", friction=friction, cohesion=cohesion)
        case.check(f"vertical cut, friction {friction} degrees: factor of safety between {low:.4f} and {high:.4f}", (holds + slips) / 2,
                   (low + high) / 2, 1.03 * (high - low) / 2 + 0.03 * (low + high) / 2, "absolute")
