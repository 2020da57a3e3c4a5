# SPDX-License-Identifier: MIT
import numpy as np

import verify
import vtp

LENGTH, HEIGHT, E = 100.0, 2.0, 1000.0


def stretch(time):
    return 1 - np.where(time < 5, 1 - np.cos(np.pi * time / 5), 2) / LENGTH


def force(s):
    """Of a neo-Hookean bar without lateral strain, Poisson's ratio 0."""
    return E / 2 * (s - 1 / s) * HEIGHT


def energy(s):
    return E / 2 * ((s**2 - 1) / 2 - np.log(s)) * HEIGHT * LENGTH


def run(case):
    variants = [("FLIP", "quadratic", "2", "mirror"), ("APIC", "uGIMP", "1", "mirror"), ("FLIP", "uGIMP", "1", "0"), ("APIC", "quadratic", "2", "mirror")]
    for transfer, kernel, depth, gradient in variants[: 3 if case.quick else 4]:
        mirrors = gradient == "mirror"
        name = f"{transfer} {kernel}" + ("" if mirrors else ", no gradient")
        out = case.run(name.replace(" ", "_").replace(",", ""), entities=dict(kernel=kernel, transfer=transfer, depth=depth, gradient=gradient))
        rows, ledger = verify.history(out), verify.table(f"{out}/energy.csv")
        time = rows["time"]
        s = stretch(time)
        last = energy(s[-1])
        case.check(f"{name}: strain energy at the end", rows["Strain Energy"][-1], last, 5e-3)
        case.check(f"{name}: force at the end", rows["reactionx"][time > 5.5].mean(), force(s[-1]), 5e-3)
        case.check(f"{name}: work of the wall less that of damping", ledger["boundary_work"][-1] - ledger["damping"][-1], last, 5e-3)
        moving = (time > 1.5) & (time < 4)
        error = np.abs(rows["Strain Energy"] - energy(s))[moving].max() / last
        case.check(f"{name}: largest error of the strain energy while it moves", error, 0, 1e-2, "at most")
        p = vtp.read(vtp.collection(out)[-1][1])
        near = p["points"][:, 0] > 94
        scatter = np.abs(p["stress"][near, 0] * HEIGHT / force(s[-1]) - 1).max()
        case.check(f"{name}: largest error of the stress within four cells of the wall", scatter, 0, 5e-3 if mirrors else 0.5, "at most")
