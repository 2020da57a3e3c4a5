# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify
import vtp

FMPM, FLIP, APIC = "<Transfer type='FMPM' order='4'/>", "<Transfer type='FLIP'/>", "<Transfer type='APIC'/>"


def error_of(case, kernel, transfer, order, cells):
    out = case.run(f"{kernel}_{order}_{cells}", entities=dict(h=1 / cells, kernel=kernel, order=order), replace={FMPM: transfer})
    times, amplitudes = [], []
    for t, path in vtp.collection(out):
        data = vtp.read(path)
        mode = np.cos(math.pi * (data["points"][:, 0] - data["displacement"][:, 0] - 0.3 / cells))
        amplitudes.append((data["velocity"][:, 0] * mode).sum() / (mode**2).sum() / (1e-5 * math.pi))
        times.append(t)
    exact = np.cos(math.pi * np.array(times))
    return np.linalg.norm(amplitudes - exact) / np.linalg.norm(exact)


def run(case):
    case.check("quadratic, FMPM(4), stress last, 20 cells: error of the mode", error_of(case, "quadratic", FMPM, "USL", 20), 0, 0.02, "at most")
    if case.quick:
        return
    for kernel, transfer, name, published in [("uGIMP", FLIP, "FLIP", 0.34), ("quadratic", FLIP, "FLIP", 0.43),
                                              ("uGIMP", APIC, "APIC", 0.18), ("quadratic", APIC, "APIC", 0.21)]:
        case.check(f"{kernel}, {name}, 20 cells: error of the mode", error_of(case, kernel, transfer, "USL", 20), published, 0.1)
    for kernel in ("uGIMP", "quadratic", "cubic", "lCPDI"):
        for transfer, name, order in [(FLIP, "FLIP", "USL"), (FMPM, "FMPM(4), USAVG", "USAVG")]:
            coarse, fine = (error_of(case, kernel, transfer, order, n) for n in (20, 40))
            case.check(f"{kernel}, {name}: 2 minus order between 20 and 40 cells", 2 - math.log2(coarse / fine), 0, 0.2, "at most")
