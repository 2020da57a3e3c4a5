# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

G, DIP, PHI, RHO, HEIGHT, RATE = 10.0, math.radians(20), math.radians(35), 2000.0, 1.0, 1e4
WEIGHT = RHO * HEIGHT * G  # per area of the joint
# at the limit the shear stress is the effective normal stress times tan(phi)
START = 1 + (WEIGHT * math.cos(DIP) - WEIGHT * math.sin(DIP) / math.tan(PHI)) / RATE


def slid(time):
    return math.tan(PHI) * RATE / (RHO * HEIGHT) * np.maximum(time - START, 0) ** 3 / 6


def compare(case, what, rows, column):
    time, x = rows["time"], rows[column]
    x = x - x[np.abs(time - 1).argmin()]
    case.check(f"{what}: slip at the end [m]", x[-1], slid(time[-1]), 0.02)
    before = (time > 1) & (time < START - 0.02)
    case.check(f"{what}: largest slip before the limit, of that at the end", np.abs(x[before]).max() / x[-1], 0, 0.02, "at most")
    # the slip grows with the third power of the time since the limit
    late = time > START + 0.2
    begin = np.polyfit(time[late], np.cbrt(x[late]), 1)
    case.check(f"{what}: time at which the block begins to slide [s]", -begin[1] / begin[0], START, 0.01)


def run(case):
    for transfer, h in (("APIC", 0.25),) if case.quick else (("APIC", 0.25), ("FLIP", 0.25), ("APIC", 0.125)):
        rows = verify.history(case.run(f"{transfer}_{h}", entities=dict(transfer=transfer, h=h)))
        compare(case, f"grid, {transfer}, cells of {h} m", rows, "dispx:block")
    compare(case, "rigid blocks", verify.history(case.run("blocks", "blocks.xml")), "dispx:block")
