# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

FRICTION, COHESION = math.radians(30), 0.01
N = math.tan(math.pi / 4 + FRICTION / 2) ** 2
ROUGH_BASE = "<DisBC dir='1' vel='0'/>"


def thrust(case, label, **entities):
    """Mean horizontal force of the wall on the soil in the last third of the run, and the results."""
    out = case.run(label, entities=entities)
    rows = verify.history(out)
    last = rows["time"] > rows["time"].max() * 2 / 3
    return next(rows[name] for name in rows if name.startswith("contactx"))[last].mean(), out


def rankine(case):
    passive, active = N / 2 + 2 * COHESION * math.sqrt(N), 1 / N / 2 - 2 * COHESION / math.sqrt(N)
    runs = (("passive, associated", dict(), passive), ("passive, no dilation", dict(dilation=0), passive), ("active, associated", dict(speed=-0.0003), active))
    for label, entities, expected in runs[:1] if case.quick else runs:
        entities = dict(entities, h=0.125) if case.quick else entities
        force, _ = thrust(case, label.replace(", ", "_").replace(" ", "_"), **entities)
        case.check(f"smooth wall and base, {label}: thrust over Rankine's", force / expected, 1, 0.06 if case.quick else 0.03)


def wedge(case):
    expected = N / 2 + 2 * COHESION * math.sqrt(N)
    force, out = thrust(case, "wedge", h=1 / 32, base=ROUGH_BASE)
    case.check("smooth wall, rough base, 32 cells: thrust over Rankine's", force / expected, 1, 0.0625)
    p = verify.last_particles(out)
    soil = p["points"][:, 0] > 0.03

    def draw(axes):
        x, u = p["points"][soil], np.linalg.norm(p["displacement"][soil], axis=1)
        shown = axes.scatter(x[:, 0], x[:, 1], c=1e3 * u, s=3, cmap="viridis", linewidths=0)
        axes.get_figure().colorbar(shown, label="displacement / height, per mille", shrink=0.6)
        axes.plot([0.016, 0.016 + math.tan(math.pi / 4 + FRICTION / 2)], [0, 1], "w--", lw=1)
        axes.set(xlabel="x / height", ylabel="y / height", aspect=1, title="A smooth wall pushes a wedge up; dashed: Rankine's plane")

    case.figure("wall", draw)
    force, _ = thrust(case, "rough", h=1 / 32, base=ROUGH_BASE, wall=math.tan(FRICTION))
    case.check("rough wall and base: coefficient of thrust between Lancellotta's bound and Coulomb's wedge", 2 * force, (5.026 + 8.743) / 2, (8.743 - 5.026) / 2, "absolute")


def run(case):
    rankine(case)
    if not case.quick:
        wedge(case)
