# SPDX-License-Identifier: MIT
import numpy as np

import verify


def alone(points, cell):
    """Particles without another one within one and a half times their size, three quarters of a cell: they lie on the slope, pressed by nothing but their own weight."""
    distance = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    return np.count_nonzero(distance < 0.75 * cell, axis=1) == 1


def slide(case, label, cell=0.2, **entities):
    out = case.run(label.replace(", ", "_").replace(" ", "_"), entities=entities)
    p = verify.last_particles(out)
    sand = p["material"] == 1
    ratio, mass = p["volume_ratio"][sand], p["mass"][sand]
    together = ~alone(p["points"][sand][:, :2], cell)
    moving = verify.history(out)["Kinetic Energy:sand"]
    case.check(f"{label}: kinetic energy left over the largest", moving[-1] / moving.max(), 0, 1e-3, "at most")
    case.check(f"{label}: volume of the deposit over that of the wedge", np.average(ratio, weights=mass), 1, 0.02)
    case.check(f"{label}: largest volume ratio of a particle", ratio[together].max(), 0, 1.3, "at most")
    case.check(f"{label}: particles that lie alone, of {len(ratio)}", np.count_nonzero(~together), 0, 1, "at most")
    balance(case, label, out)
    return p["points"][sand], ratio


def balance(case, label, out):
    e = verify.energy(out)
    released = -e["potential"].min()
    case.check(f"{label}: residual of the energy over what was released", np.abs(e["residual"]).max() / released, 0, 0.02, "at most")
    case.check(f"{label}: energy that transfers created in an interval over what was released", -np.diff(e["transfer"]).min() / released, 0, 1e-3, "at most")


def run(case):
    points, ratio = slide(case, "APIC, 0.2 m")
    if case.quick:
        return
    slide(case, "APIC, 0.1 m", cell=0.1, h="0.1")
    averaged = "<MPMMethod>USAVG</MPMMethod><SkipPostExtrapolation/>"
    slide(case, "FLIP 0.99, 0.2 m", transfer="<Transfer type='blend' fraction='0.99'/>", method=averaged)
    slide(case, "FLIP 0.99, 0.1 m", cell=0.1, h="0.1", transfer="<Transfer type='blend' fraction='0.99'/>", method=averaged)
    last = "<MPMMethod>USL</MPMMethod><SkipPostExtrapolation/>"
    slide(case, "FMPM(2), 0.2 m, 10 s", transfer="<Transfer type='FMPM' order='2'/>", method=last, end="10")
    for label, transfer in (("FLIP 0.99, USL+", "type='blend' fraction='0.99'"), ("FMPM(2)", "type='FMPM' order='2'")):
        balance(case, label, case.run(label, entities=dict(transfer=f"<Transfer {transfer}/>", end="1.5")))

    def draw(axes):
        axes.plot([2, 10, 19.6], [6.6, 1, 1], "k-", linewidth=1)
        shown = axes.scatter(points[:, 0], points[:, 1], c=ratio, s=6)
        axes.figure.colorbar(shown, ax=axes, label="volume ratio")
        axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", xlim=(6, 17))

    case.figure("landslide", draw)
