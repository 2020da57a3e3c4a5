# SPDX-License-Identifier: MIT
import numpy as np

import verify


def edge(start, now, at):
    """Where a line through the two particles nearest to the edge takes the point that was at `at`."""
    last = np.argsort(start)[-2:]
    (a, b), (p, q) = start[last], now[last]
    return p + (q - p) / (b - a) * (at - a)


def shape(out):
    p = verify.last_particles(out)
    x = p["points"][:, :2]
    start = x - p["displacement"][:, :2]
    foot = start[:, 1] < start[:, 1].min() + 1e-6
    axis = start[:, 0] < start[:, 0].min() + 1e-6
    return edge(start[axis, 1], x[axis, 1], 32.4), edge(start[foot, 0], x[foot, 0], 3.2), p


def run(case):
    if case.quick:
        length, radius, _ = shape(case.run("coarse", entities=dict(h="0.4")))
        case.check("8 cells along the radius: length [mm]", length, 21.45, 0.5, "absolute")
        return
    for label, entities in (("quadratic splines, 24 cells along the radius", dict(h=repr(3.2 / 24))), ("uGIMP, 16 cells", dict(kernel="uGIMP"))):
        out = case.run(label.replace(" ", "_").replace(",", ""), entities=entities)
        length, radius, p = shape(out)
        case.check(f"{label}: length [mm]", length, 21.45, 0.15, "absolute")
        case.check(f"{label}: radius of the foot [mm]", radius, 7.105, 0.135, "absolute")
        case.check(f"{label}: largest plastic strain", p["plastic_strain"].max(), 2.875, 0.375, "absolute")
        energy = verify.energy(out)
        total = energy["kinetic"] + energy["elastic"] + energy["plastic"]
        case.check(f"{label}: energy lost or gained beside plastic work, over the first", np.abs(total / total[0] - 1).max(), 0, 0.03, "at most")
        if label.startswith("quadratic"):
            picture = p

    def draw(axes):
        x = picture["points"]
        dots = axes.scatter(np.concatenate([x[:, 0], -x[:, 0]]), np.tile(x[:, 1], 2), c=np.tile(picture["plastic_strain"], 2), s=1.2, marker="s", linewidths=0, cmap="inferno")
        axes.set(aspect="equal", title="Plastic strain after 80 microseconds", xlabel="r [mm]", ylabel="z [mm]")
        axes.figure.colorbar(dots)

    case.figure("taylor", draw)
