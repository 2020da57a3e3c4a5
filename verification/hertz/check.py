# SPDX-License-Identifier: MIT
import numpy as np

import verify


def pressure(out, h):
    """Places along the face, pressure from the traction on it, and pressure from the stress normal to it, of the lowest row
    of particles. The plane pushes upwards, so the traction on the lower face is positive; the stress is tension positive."""
    p = verify.last_particles(out)
    X = p["points"] - p["displacement"]
    row = np.flatnonzero((p["von_mises"] > 0) & (p["contact_state"] > 0) & (X[:, 1] - 0.5 * X[:, 0] ** 2 < 0.6 * h))
    row = row[np.argsort(X[row, 0])]
    return p["points"][row, 0], p["contact_traction"][row, 1], -p["stress"][row, 1]


def fit(x, p, a):
    """Largest pressure and half width of the half ellipse through the inner part."""
    slope, square = np.polyfit(x[abs(x) < 0.8 * a] ** 2, (p * abs(p))[abs(x) < 0.8 * a], 1)  # no number if p < 0
    return np.sqrt(square), np.sqrt(-square / slope)


def half_width(x, p):
    """Half width of the half ellipse with the same second moment as all the pressures."""
    return 2 * np.sqrt(np.sum(p * x**2) / np.sum(p))


def run(case):
    curves = []
    runs = (("cylinder", 10, 0.02, 0.02), ("cylinder", 10, 0.01, 0.0125), ("ball", 13, 0.01, 0.0125))
    for name, analysis, h, way in runs[:1] if case.quick else runs:
        out = case.run(f"{name}{h}", entities=dict(analysis=str(analysis), h=repr(h), way=repr(way)))
        force = verify.history(out)["contacty:cylinder"][-1]
        if name == "cylinder":  # Johnson, Contact Mechanics, 1985, section 4.2(c); half of it is modelled
            P = 2 * force
            a = np.sqrt(4 * P * 0.91 / np.pi)
            p0 = 2 * P / (np.pi * a)
        else:  # section 4.2(a); forces are per radian
            P = 2 * np.pi * force
            a = (0.75 * P * 0.91) ** (1 / 3)
            p0 = 1.5 * P / (np.pi * a**2)
        x, traction, stress = pressure(out, h)
        label = f"{name}, a = {a / h:.1f} cells"
        case.check(f"{label}: largest pressure, from contact tractions", fit(x, traction, a)[0] / p0, 1, 0.05)
        if h == 0.02:
            case.check(f"{label}: half width, from the second moment of the stresses of the first particles",
                       half_width(x, stress) / a, 1, 0.05)
        if h < 0.02:
            case.check(f"{label}: half width, from the stresses of the first particles", fit(x, stress, a)[1] / a, 1, 0.05)
            case.check(f"{label}: largest pressure, from those stresses", fit(x, stress, a)[0] / p0, 1, 0.05)
            case.check(f"{label}: half width, from contact tractions", fit(x, traction, a)[1] / a, 1, 0.05)
        curves.append((label, x / a, traction / p0))
    if case.quick:
        return

    def draw(axes):
        for label, x, p in curves:
            axes.plot(x, p, ".", label=label, markersize=4)
        s = np.linspace(0, 1, 200)
        axes.plot(s, np.sqrt(1 - s**2), "k--", linewidth=0.8, label="Hertz")
        axes.set_xlabel("distance from the middle / a")
        axes.set_ylabel("pressure / p0")
        axes.legend(fontsize=8)

    case.figure("hertz", draw)
