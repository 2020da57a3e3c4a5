# SPDX-License-Identifier: MIT
import numpy as np

import verify

R0, STRESS = 1.734998, 12.0122124e6


def excavate(case, dilation, h):
    """Undeformed radii, displacements, radial and hoop stresses, and the plastic radius, from the wall outwards."""
    out = case.run(f"dilation{dilation}", entities=dict(dilation=dilation, h=h, first=1 + h / 2, last=25 - h / 2))
    p = verify.last_particles(out)
    u = p["displacement"][:, 0]
    r = p["points"][:, 0] - u
    rings = np.unique(r.round(6))
    mean = lambda q: np.array([q[np.abs(r - ring) < 1e-5].mean() for ring in rings])  # noqa: E731
    plastic = mean(p["plastic_shear"]) > 0
    first = np.argmin(plastic)
    return rings, mean(u), mean(p["stress"][:, 0]), mean(p["stress"][:, 2]), 0.5 * (rings[first - 1] + rings[first])


def run(case):
    h = 0.1 if case.quick else 0.05
    for dilation in (30,) if case.quick else (30, 0):
        r, u, radial, hoop, radius = excavate(case, dilation, h)
        case.check(f"dilation {dilation} degrees: plastic radius [m]", radius, R0, 0.03)
        near = abs(r - R0) < 0.3  # stresses of the particles of a cell alternate
        case.check(f"dilation {dilation} degrees: radial stress at its radius [Pa]", -np.polyval(np.polyfit(r[near], radial[near], 2), R0), STRESS, 0.03)
        if dilation == 30:
            wall = np.polyval(np.polyfit(r[:8], u[:8], 2), 1.0)
            case.check("dilation 30 degrees: displacement of the wall [m]", -wall, 0.002908412, 0.08 if case.quick else 0.05)
            shown = r, radial, hoop

    def draw(axes):
        r, radial, hoop = shown
        x = np.linspace(1, 6, 200)
        q = 2 * 3.45 * np.sqrt(3)
        inside = q / 2 * (x**2 - 1)
        outside = 30 - (30 - STRESS / 1e6) * (R0 / x) ** 2
        axes.plot(x, np.where(x < R0, inside, outside), "k-", lw=1, label="Salencon")
        axes.plot(x, np.where(x < R0, 3 * inside + q, 60 - outside), "k-", lw=1)
        near = r < 6
        axes.plot(r[near], -radial[near] / 1e6, "o", ms=3, label="radial")
        axes.plot(r[near], -hoop[near] / 1e6, "s", ms=3, label="hoop")
        axes.set(xlabel="r [m]", ylabel="pressure [MPa]", title="Stress around a tunnel in Mohr-Coulomb rock, dilation 30 degrees")
        axes.legend()

    case.figure("tunnel", draw)
