# SPDX-License-Identifier: MIT
import numpy as np

import verify

LENGTH, HEIGHT, E = 100.0, 2.0, 1000.0


def stretch(time):
    return 1 - np.where(time < 5, 1 - np.cos(np.pi * time / 5), 2) / LENGTH


def force(s):
    """Of a neo-Hookean bar without lateral strain, Poisson's ratio 0."""
    return E / 2 * (s - 1 / s) * HEIGHT


def energy(s):
    return E / 2 * ((s**2 - 1) / 2 - np.log(s)) * HEIGHT * LENGTH


def run(case):
    variants = [("FLIP", "quadratic", "1", "mirror"), ("APIC", "uGIMP", "1", "mirror"), ("FLIP", "uGIMP", "0", "0")]
    for transfer, kernel, depth, gradient in variants[: 2 if case.quick else 3]:
        name = f"{transfer} {kernel}" + ("" if gradient == "mirror" else ", no gradient")
        rows = verify.history(case.run(name.replace(" ", "_").replace(",", ""), entities=dict(kernel=kernel, transfer=transfer, depth=depth, gradient=gradient)))
        time = rows["time"]
        s = stretch(time)
        last = energy(s[-1])
        case.check(f"{name}: strain energy at the end", rows["Strain Energy"][-1], last, 5e-3)
        held = time > 5.5
        case.check(f"{name}: force at the end", rows["reactionx"][held].mean(), force(s[-1]), 5e-3)
        case.check(f"{name}: work of the wall less what damping takes", rows["External Work"][-1], last, 2e-2)
        moving = (time > 1.5) & (time < 4)
        error = np.abs(rows["Strain Energy"] - energy(s))[moving].max() / last
        case.check(f"{name}: largest error of the strain energy while it moves", error, 0, 3e-2, "at most")
