# SPDX-License-Identifier: MIT
import numpy as np

import verify

VISCOSITY, HALF_THICKNESS = 50, 0.6


def force(case, label, **entities):
    """Times and force on the grip over that of the closed form: means of nine intervals of 0.2."""
    h = verify.history(case.run(label, entities=entities))
    ratio = np.abs(h["reactionx:grip"]) / (4 * VISCOSITY * HALF_THICKNESS * np.exp(-h["time"]))
    return h["time"][1:].reshape(9, 10).mean(1), ratio[1:].reshape(9, 10).mean(1)


def run(case):
    ways = {"quadratic, APIC": dict()}
    if not case.quick:
        ways |= {"uGIMP, APIC": dict(kernel="uGIMP"), "quadratic, FLIP": dict(transfer="<Transfer type='blend' fraction='0.99'/>"),
                 "quadratic, APIC, half the cells": dict(h="0.05")}
    shown = []
    for label, entities in ways.items():
        t, ratio = force(case, label.replace(", ", "_").replace(" ", "_"), **entities)
        case.check(f"{label}: largest error of the force from 2.5 to 6 times the length", np.abs(ratio[t > 0.9] - 1).max(), 0, 0.1, "at most")
        shown.append((label, t, ratio))
    if case.quick:
        return
    t, ratio = force(case, "without", split="")
    case.check("without splitting the strip breaks: least force over the exact one", ratio[t > 0.9].min(), 0, 0.2, "at most")
    shown.append(("quadratic, APIC, without splitting", t, ratio))

    def draw(axes):
        axes.axhline(1, color="k", linewidth=0.8)
        for label, t, ratio in shown:
            axes.plot(np.exp(t), ratio, linewidth=1, label=label)
        axes.set(xlabel="length / initial length", ylabel="force / closed form", ylim=(0, 1.4))
        axes.legend()

    case.figure("stretching", draw)
