# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

symmetry = ("<Horiz nx='2'/>", "<Horiz nx='2' symmin='0'/>")
support = "<BCLine x1='0' x2='0' y1='0' y2='1'><DisBC dir='1' disp='0'/></BCLine>"


def swing(case, label, replace, start):
    periods = 100 if case.quick else 10000
    out = case.run(label, entities=dict(end=2 * math.pi * periods, place=0.3 if replace else 0.5), replace=replace)
    h = verify.history(out)
    v, s = h["velx"][1:] / start, h["sxx"][1:] / start
    case.check(f"{label}: energy, largest departure in {periods} periods", abs(v**2 + s**2 - 1).max(), 0, 1e-4, "at most")
    half = len(v) // 2
    drift = (v**2 + s**2)[half:].mean() - (v**2 + s**2)[:half].mean()
    case.check(f"{label}: energy, drift from the first half to the second", abs(drift), 0, 1e-6, "at most")
    phase = np.unwrap(np.arctan2(s, v))
    frequency = (phase[-1] - phase[0]) / (h["time"][-1] - h["time"][1])
    case.check(f"{label}: frequency", frequency, 160 * math.asin(0.00625), 1e-6)


def run(case):
    swing(case, "symmetry plane", dict([symmetry, ("<GridBCs>", ""), (support, ""), ("</GridBCs>", "")]), 1e-7)
    swing(case, "prescribed velocity", None, 0.5e-7)
