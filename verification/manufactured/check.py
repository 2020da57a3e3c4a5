# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify
import vtp

FMPM, APIC = "<Transfer type='FMPM' order='4'/>", "<Transfer type='APIC'/>"


def axis_aligned(x, t):
    s = 0.05 * math.sin(100 * math.pi * t)
    return np.stack([s * np.sin(2 * math.pi * x[:, 0]), -s * np.sin(2 * math.pi * x[:, 1])], axis=1)


def error_of(out, exact):
    """Largest over the written times of the L2 error of displacement, relative to the largest L2 displacement."""
    worst = size = 0.0
    for t, path in vtp.collection(out):
        data = vtp.read(path)
        u = data["displacement"][:, :2]
        wanted = exact(data["points"][:, :2] - u, t)
        worst = max(worst, np.sqrt(((u - wanted) ** 2).sum(axis=1).mean()))
        size = max(size, np.sqrt((wanted**2).sum(axis=1).mean()))
    return worst / size


def vortex(amplitude):
    def exact(x, t):
        r = np.hypot(x[:, 0], x[:, 1])
        angle = amplitude * (1 - math.cos(2 * math.pi * t)) / 2 * (abs(r - 1) < 0.25) * (1 - 16 * (r - 1) ** 2) ** 2
        c, s = np.cos(angle), np.sin(angle)
        return np.stack([c * x[:, 0] - s * x[:, 1], s * x[:, 0] + c * x[:, 1]], axis=1) - x

    return exact


def ring(x, t):
    r = np.hypot(x[:, 0], x[:, 1])
    k = 0.1 * math.sin(math.pi * math.sqrt(10) * t) * (9.25925925925926 * r**2 - 13.88888888888889 * r + 6.666666666666667)
    return k[:, None] * x


def errors(case, file, grids, exact, transfer=FMPM, **entities):
    """Errors on grids given as entity dictionaries."""
    label = f"{file}_{entities.get('kernel')}_{entities.get('points')}"
    return [error_of(case.run(f"{label}_{k}", file=f"{file}.xml", entities=dict(entities, **grid), replace={FMPM: transfer}), exact)
            for k, grid in enumerate(grids)]


def order(values):
    return math.log2(values[-2] / values[-1])


def run(case):
    squares = [dict(n=n) for n in (8, 16, 32)]
    if case.quick:
        found = errors(case, "axis_aligned", squares[:2], axis_aligned, kernel="lCPDI", points=4)
        case.check("axis aligned, CPDI, 4 points: 2 minus order between 8 and 16 cells", 2 - order(found), 0, 0.1, "at most")
        return

    curves = {}
    for kernel in ("linear", "uGIMP", "quadratic", "cubic", "lCPDI"):
        curves[kernel] = errors(case, "axis_aligned", squares, axis_aligned, kernel=kernel, points=16)
    for kernel, demand in (("uGIMP", 1.8), ("quadratic", 2.0), ("cubic", 2.0), ("lCPDI", 2.0)):
        case.check(f"axis aligned, {kernel}: {demand} minus order between 8 and 16 cells", demand - order(curves[kernel][:2]), 0, 0, "at most")
        case.check(f"axis aligned, {kernel}: error with 32 cells", curves[kernel][-1], 0, 5e-3 if kernel == "uGIMP" else 2e-3, "at most")
    four = errors(case, "axis_aligned", squares + [dict(n=64)], axis_aligned, kernel="lCPDI", points=4)
    case.check("axis aligned, CPDI, 4 points: 2 minus order between 32 and 64 cells", 2 - order(four), 0, 0.1, "at most")

    vortices = [dict(h=1 / n, step=1 / (6 * n)) for n in (8, 16, 32)]
    turning = {}
    for kernel in ("uGIMP", "quadratic", "cubic", "lCPDI"):
        turning[kernel] = errors(case, "vortex", vortices, vortex(0.1), kernel=kernel, points=4, A=0.1)
        case.check(f"vortex, A = 0.1, {kernel}: error with cells of 1/32", turning[kernel][-1], 0, 0.02, "at most")
    for kernel in ("cubic", "lCPDI"):
        case.check(f"vortex, A = 0.1, {kernel}: 1.8 minus order between 1/16 and 1/32", 1.8 - order(turning[kernel]), 0, 0, "at most")
    strong = errors(case, "vortex", [dict(h=1 / 32, step=1 / 768)], vortex(1.0), APIC, kernel="lCPDI", points=16, A=1)
    case.check("vortex, A = 1 (shear 7), CPDI, APIC: error with cells of 1/32", strong[-1], 0, 0.05, "at most")

    rings = [dict(h=0.2 / n) for n in (4, 8, 16)]
    breathing = errors(case, "ring", rings, ring, kernel="lCPDI", points=4)
    case.check("ring, CPDI, USL-: error with 16 cells across", breathing[-1], 0, 0.01, "at most")
    case.check("ring, CPDI, USL-: 1 minus order between 8 and 16 cells", 1 - order(breathing), 0, 0, "at most")
    averaged = errors(case, "ring", rings + [dict(h=0.2 / 32)], ring, kernel="lCPDI", points=4, method="USAVG")
    case.check("ring, CPDI, USAVG-: error with 16 cells across", averaged[-2], 0, 5e-3, "at most")
    for cells, order_found in ((8, order(averaged[:2])), (16, order(averaged[:3])), (32, order(averaged))):
        case.check(f"ring, CPDI, USAVG-: 1 minus order between {cells // 2} and {cells} cells", 1 - order_found, 0, 0, "at most")

    def draw(cells, found, slope, title):
        def plot(axes):
            for kernel, values in found.items():
                axes.loglog(cells, values, "o-", label=kernel)
            axes.loglog(cells, [slope * (cells[0] / n) ** 2 for n in cells], "k--", linewidth=1, label="second order")
            axes.set_xlabel(title)
            axes.set_ylabel("L2 error of displacement, relative")
            axes.set_xticks(cells, [str(n) for n in cells])
            axes.minorticks_off()
            axes.legend(fontsize=8)

        return plot

    case.figure("orders_axis_aligned", draw([8, 16, 32], curves, 0.05, "cells along the square, 16 points per cell"))
    case.figure("orders_vortex", draw([8, 16, 32], turning, 0.3, "cells per unit of length, 4 points per cell"))
