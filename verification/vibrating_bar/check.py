# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

length, modulus = 25.0, 100.0
beta = math.pi / (2 * length)
omega = beta * math.sqrt(modulus)
FMPM, FLIP, APIC = "<Transfer type='FMPM' order='4'/>", "<Transfer type='FLIP'/>", "<Transfer type='APIC'/>"


def error_of(case, kernel, transfer, cells):
    h = length / cells
    out = case.run(f"{kernel}_{cells}_{abs(hash(transfer))}", entities=dict(
        h=h, kernel=kernel, end=20 * 2 * math.pi / omega, sample=2 * math.pi / omega / 50), replace={FMPM: transfer})
    got, content = verify.history(out), verify.energy(out)
    exact = 0.001 / (beta * length) * np.cos(omega * got["time"])
    total = content["kinetic"] + content["elastic"]
    return np.linalg.norm(got["velx"] - exact) / np.linalg.norm(exact), total.min() / total[0], total.max() / total[0]


def run(case):
    kernels = ["uGIMP", "quadratic", "cubic", "lCPDI"] if not case.quick else ["quadratic"]
    curves = {}
    for kernel in kernels:
        cells = [10, 20, 40, 80] if not case.quick else [20, 40]
        results = [error_of(case, kernel, FMPM, n) for n in cells]
        errors = [r[0] for r in results]
        curves[kernel] = (cells, errors)
        at = cells.index(40)
        if kernel in ("quadratic", "cubic"):
            case.check(f"{kernel}, FMPM(4), 40 cells: L2 error of the velocity", errors[at], 0, 2e-3, "at most")
            case.check(f"{kernel}, FMPM(4), 40 cells: energy lost", 1 - results[at][1], 0, 1e-3, "at most")
        case.check(f"{kernel}, FMPM(4): energy gained", results[at][2] - 1, 0, 1e-4, "at most")
        case.check(f"{kernel}, FMPM(4): 2 minus order between 20 and 40 cells", 2 - math.log2(errors[at - 1] / errors[at]), 0, 0.2, "at most")
        if not case.quick:
            case.check(f"{kernel}, FLIP, 20 cells: L2 error of the velocity", error_of(case, kernel, FLIP, 20)[0], 0, 0.16, "at most")

    def draw(axes):
        for kernel, (cells, errors) in curves.items():
            axes.loglog(cells, errors, "o-", label=kernel)
        cells = np.array([10, 80])
        axes.loglog(cells, 0.04 * (10 / cells) ** 2, "k--", linewidth=1, label="second order")
        axes.set_xlabel("cells along the bar")
        axes.set_ylabel("L2 error of the velocity, 20 periods")
        axes.legend(fontsize=8)

    case.figure("vibrating_bar", draw)
