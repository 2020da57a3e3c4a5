# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

E, depth = 12000.0, 1.0
bending, stretching, shearing = E * depth**3 / 12, E * depth, E / 2 * depth * 5 / 6


def beam(load, length, slack=True, steps=2000):
    """Tip displacement of Reissner's beam, or of the elastica, under a dead load downwards."""

    def tip(curvature):
        state = np.array([0.0, curvature, 0.0, 0.0])  # rotation, its slope, x, y
        ds = length / steps

        def rate(q):
            c, s = math.cos(q[0]), math.sin(q[0])
            stretch = 1 - (load * s / stretching if slack else 0.0)
            shear = -load * c / shearing if slack else 0.0
            dx, dy = stretch * c - shear * s, stretch * s + shear * c
            return np.array([q[1], load * dx / bending, dx, dy])

        for _ in range(steps):
            a = rate(state)
            b = rate(state + ds / 2 * a)
            c = rate(state + ds / 2 * b)
            state = state + ds / 6 * (a + 2 * b + 2 * c + rate(state + ds * c))
        return state

    low, high = -load * length / bending, 0.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if tip(middle)[1] < 0 else (low, middle)
    end = tip((low + high) / 2)
    return end[2] - length, end[3]


def solve(case, length, load, **entities):
    tip = length - 0.1
    out = case.run(f"beam_{length}_{load}", entities=dict(length=length, wide=length + 0.5, tip=tip, load=load, **entities))
    data = verify.last_particles(out)
    chosen = data["points"][:, 0] - data["displacement"][:, 0] > tip
    return data["displacement"][chosen].mean(axis=0)


def run(case):
    assert abs(beam(10.0, 10.0, slack=False)[1] / 10 + 0.301720774) < 1e-6 and abs(beam(100.0, 10.0, slack=False)[0] / 10 + 0.554995598) < 1e-6
    if case.quick:
        return
    for load in (10.0, 100.0):
        u, v, _ = solve(case, 10, load, end=20, ramp=4)
        x, y = beam(load, 10 - 0.0625)
        case.check(f"L = 10, a = {load / 10:g}: tip down, Reissner", v, y, 0.01)
        case.check(f"L = 10, a = {load / 10:g}: tip back, Reissner, over L", u / 10, x / 10, 0.01, "absolute")
    u, v, _ = solve(case, 20, 25.0, end=45, ramp=10, alpha=0.5)
    x, y = beam(25.0, 20 - 0.0625, slack=False)
    case.check("L = 20, a = 10: tip down, elastica", v, y, 0.01)
    case.check("L = 20, a = 10: tip back, elastica, over L", u / 20, x / 20, 0.01, "absolute")
