# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

GRAVITY, DENSITY, SHEAR_MODULUS = 10, 2000, 2e7


def profile(y, slope, friction, relaxation):
    """Velocity of a layer of unit depth in steady flow."""
    pull = DENSITY * GRAVITY * (math.sin(slope) - math.sin(friction) * math.cos(slope))
    return pull / (SHEAR_MODULUS * relaxation) * (y - y * y / 2)


def flows(case):
    slope, friction, relaxation = math.radians(30), math.radians(20), 5e-5
    top = profile(1.0, slope, friction, relaxation)
    shown = []
    for cells, tolerance in ((20, 0.02),) if case.quick else ((20, 0.02), (40, 0.005)):
        p = verify.last_particles(case.run(f"flow_{cells}", "flow.xml", entities=dict(h=1 / cells, end=4.5 if case.quick else 6)))
        y, v = p["points"][:, 1], p["velocity"][:, 0]
        case.check(f"steady flow, {cells} cells: largest error of the velocity over the surface's", np.abs(v - profile(y, slope, friction, relaxation)).max() / top, 0, tolerance, "absolute")
        shear = p["stress"][:, 3] / (DENSITY * GRAVITY * math.sin(slope))
        case.check(f"steady flow, {cells} cells: largest error of the shear stress over that at the base, five cells and more away from it", np.abs(shear - (1 - y))[y > 5 / cells].max(), 0, tolerance, "absolute")
        shown.append((cells, y, v))
    if case.quick:
        return

    def draw(axes):
        depth = np.linspace(0, 1)
        axes.plot(profile(depth, slope, friction, relaxation), depth, "k-", lw=1, label="closed form")
        for (cells, y, v), mark in zip(shown, "ox"):
            axes.plot(v, y, mark, ms=4, mfc="none", label=f"{cells} cells")
        axes.set(xlabel="velocity [m/s]", ylabel="height [m]", title="Mohr-Coulomb grains that flow down an incline of 30 degrees")
        axes.legend()

    case.figure("layer", draw)


def starts_or_rests(case):
    """Without dilation a layer slides when tan(slope) exceeds sin(friction), not tan(friction)."""
    for friction, slides in ((33, True), (36, False)):
        v = verify.last_particles(case.run(f"threshold_{friction}", "flow.xml", entities=dict(friction=friction, relaxation=0, end=1)))["velocity"][:, 0].mean()
        expected = GRAVITY * (0.5 - math.sin(math.radians(33)) * math.cos(math.pi / 6))
        if slides:
            case.check(f"no dilation, friction {friction} on 30 degrees: slides, velocity after 1 s over that of a block", v / expected, 1, 0.1)
        else:
            case.check(f"no dilation, friction {friction} on 30 degrees: rests, velocity after 1 s", v, 0, 0.01, "absolute")


def safety(case):
    slope, friction = math.radians(20), math.radians(30)
    weight = 2e4 * 5 * math.cos(slope) ** 2 * math.tan(slope)
    associated = math.tan(friction) / math.tan(slope)
    coaxial = math.tan(friction) / math.tan(math.asin(math.tan(slope)))
    rows = (("dilation 30 degrees", dict(), associated), ("no dilation", dict(dilation=0), coaxial),
            ("dilation 30 degrees, cohesion 10 kPa", dict(cohesion=1e4, high=2.4), associated + 1e4 / weight))
    for label, entities, expected in rows[:1] if case.quick else rows:
        out = case.call("safety", case.deck("slope_" + "_".join(map(str, entities)), "slope.xml", entities, None), case.scratch / f"slope_{len(entities)}_{expected:.4f}.out")
        trials = verify.table(f"{out}/safety.csv")
        holds = trials["holds"] > 0
        case.check(f"endless slope, 20 degrees, friction 30, {label}: factor of safety", (trials["factor"][holds].max() + trials["factor"][~holds].min()) / 2, expected, 0.01)


def run(case):
    flows(case)
    if not case.quick:
        starts_or_rests(case)
    safety(case)
