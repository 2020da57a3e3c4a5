# SPDX-License-Identifier: MIT
import numpy as np

import verify

HALF_SLOTS = (0.25, 0.35, 0.5)
OFFSET = 2.4  # cells by which the slot acts narrower than it is


def rate(case, half, h, **entities):
    """Area of sand per time that flows through the slot, after the start [m^2/s]."""
    out = case.run("_".join([f"slot{2 * half:g}", f"h{h:g}", *entities]), entities=dict(slot=half, h=h) | entities)
    rows = []
    for t, path in verify.vtp.collection(out):
        p = verify.vtp.read(path)
        sand = p["material"] == 2
        rows.append((t, (p["points"][sand, 1] < 2).mean() * 5.0))
    t, area = np.array(rows).T
    steady = t > 0.35
    return np.polyfit(t[steady], area[steady], 1)[0]


def exponent(widths, rates):
    return np.polyfit(np.log(widths), np.log(rates), 1)[0]


def run(case):
    slots = HALF_SLOTS[:2] if case.quick else HALF_SLOTS
    width = 2 * np.array(slots)
    coarse = np.array([rate(case, half, 0.05) for half in slots])
    case.check("h = 0.05 m, slots narrower by 2.4 cells: exponent of the width", exponent(width - OFFSET * 0.05, coarse), 1.5, 0.1)
    if case.quick:
        return
    fine = np.array([rate(case, half, 0.025) for half in slots])
    case.check("h = 0.025 m, slots narrower by 2.4 cells: exponent of the width", exponent(width - OFFSET * 0.025, fine), 1.5, 0.1)
    limit = (2 * fine ** (2 / 3) - coarse ** (2 / 3)) ** 1.5
    case.check("extrapolated to h = 0: exponent of the width", exponent(width, limit), 1.5, 0.1)
    flip = np.array([rate(case, half, 0.05, transfer="<Transfer type='blend' fraction='0.99'/>") for half in slots])
    case.check("FLIP, h = 0.05 m, slots narrower by 2.4 cells: exponent of the width", exponent(width - OFFSET * 0.05, flip), 1.5, 0.1)

    def draw(axes):
        for label, rates, mark in (("h = 0.05 m", coarse, "o"), ("h = 0.025 m", fine, "s"), ("extrapolated", limit, "*"), ("FLIP, h = 0.05 m", flip, "x")):
            axes.loglog(width, rates, mark, label=label)
        axes.loglog(width, limit[0] * (width / width[0]) ** 1.5, "k--", linewidth=0.8, label="Beverloo")
        axes.set(xlabel="width of the slot [m]", ylabel="rate [m$^2$/s]")
        axes.legend()

    case.figure("silo", draw)
