# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

G = K = 200e6
lame = K - 2 * G / 3
cohesion, friction = 1e6, math.radians(30)
strength = cohesion * math.cos(friction)
# relaxation time [s], published relative error of the whole curve
runs = [(1e-6, 6.076e-3), (1e-3, 2.350e-3), (5e-3, 8.188e-4), (1e-2, 5.447e-4), (2e-2, 4.168e-4), (10.0, 2.920e-4)]


def march(eta, p0=0.0, s=0.0, dt=1e-5, end=0.03):
    """s = (sxx - syy)/2, t = sxy of the discrete scheme from s, 0; psi = 0 keeps the mean stress."""
    t = 0.0
    limit = strength - p0 * math.sin(friction)
    half = -0.5 * dt / 2  # spin of v_x = y, half a step
    c2, s2 = math.cos(2 * half), math.sin(2 * half)
    b = dt / eta
    out = [(s, t)]
    for _ in range(round(end / dt)):
        s, t = c2 * s - s2 * t, s2 * s + c2 * t
        t += G * dt
        s, t = c2 * s - s2 * t, s2 * s + c2 * t
        radius = math.hypot(s, t)
        if radius > limit:
            shrink = (1 + b * limit / radius) / (1 + b)
            s, t = s * shrink, t * shrink
        out.append((s, t))
    return np.array(out)


def closed_form(time, eta):
    start = strength / G
    after = np.maximum(time - start, 0)
    return np.where(time <= start, G * time, strength + G * eta * -np.expm1(-after / eta))


CUT = "<Rect xmin='0.11' xmax='0.89' ymin='0.11' ymax='0.89'/>"


def deck(case, label, eta, replace=None, free=False):
    """The example with all nodes prescribed, or with its interior free."""
    changes = dict(replace or {})
    if not free:
        changes[CUT] = ""
    return case.run(label, "../../input/examples/simple_shear.xml", {"relaxation": eta}, changes)


def run(case):
    curves = []
    for eta, published in runs if not case.quick else runs[1:2]:
        out = deck(case, f"eta_{eta:g}", eta)
        h = verify.history(out)
        exact = march(eta)
        step = np.rint(h["time"] / 1e-5).astype(int)
        scale = np.abs(exact[:, 1]).max()
        case.check(f"eta = {eta:g} s: sigma_xy against the discrete scheme", np.abs(h["sxy"] - exact[step, 1]).max() / scale, 0, 1e-6, "at most")
        case.check(f"eta = {eta:g} s: (sigma_xx - sigma_yy)/2 against the discrete scheme",
                   np.abs((h["sxx"] - h["syy"]) / 2 - exact[step, 0]).max() / scale, 0, 1e-6, "at most")
        stress = verify.last_particles(out)["stress"][:, 3]
        case.check(f"eta = {eta:g} s: spread of sigma_xy over the particles", np.ptp(stress) / abs(stress.mean()), 0, 1e-8, "at most")
        # The published norm: 31 rows interpolated to 2999 samples
        rows = np.linspace(0, 0.03, 31)
        samples = np.arange(1, 3000) * 1e-5
        coarse = np.interp(rows, h["time"], h["sxy"])
        analytic = closed_form(samples, eta)
        norm = np.linalg.norm(analytic - np.interp(samples, rows, coarse)) / np.linalg.norm(analytic)
        case.check(f"eta = {eta:g} s: the published norm", norm, 0, published, "at most")
        curves.append((eta, h))

    h = verify.history(deck(case, "free", 1e-3, free=True))
    exact = march(1e-3)
    case.check("free interior, eta = 0.001 s: sigma_xy against the discrete scheme",
               np.abs(h["sxy"] - exact[np.rint(h["time"] / 1e-5).astype(int), 1]).max() / exact[-1, 1], 0, 1e-6, "at most")

    # The published case has no mean stress and cannot see the sign of the pressure dependence; these can
    for p0 in (-1e6, 1e6):
        body = "<vel0X>y</vel0X>"
        out = deck(case, f"p_{p0:g}", 1e-6, {body: body + f"<InitialStress xx='{p0}' yy='{p0}' zz='{p0}'/>"})
        h = verify.history(out)
        exact = march(1e-6, p0)
        step = np.rint(h["time"] / 1e-5).astype(int)
        case.check(f"mean stress {p0:g} Pa: sigma_xy against the discrete scheme", np.abs(h["sxy"] - exact[step, 1]).max() / 1e6, 0, 1e-6, "at most")
        case.check(f"mean stress {p0:g} Pa: yield stress", h["sxy"][-1], strength - 0.5 * p0 + G * 1e-6, 5e-5)
        case.check(f"mean stress {p0:g} Pa: sigma_zz keeps it", h["szz"][-1], p0, 1e-6)

    # Principal axes that turn, edges of the pyramid near: from a K0 stress
    start = "<vel0X>y</vel0X><InitialStress xx='-1e6' yy='-2e6' zz='-1.5e6'/>"
    h = verify.history(deck(case, "K0", 1e-6, {"<vel0X>y</vel0X>": start}))
    exact = march(1e-6, -1.5e6, 0.5e6)
    step = np.rint(h["time"] / 1e-5).astype(int)
    case.check("K0 stress: sigma_xy against the discrete scheme", np.abs(h["sxy"] - exact[step, 1]).max() / 1e6, 0, 1e-6, "at most")
    case.check("K0 stress: (sigma_xx - sigma_yy)/2 against the discrete scheme", np.abs((h["sxx"] - h["syy"]) / 2 - exact[step, 0]).max() / 1e6, 0, 1e-6, "at most")

    # Closed forms of small strain; the rotation of the axes by the shear of 0.03 changes them by its square, 9e-4
    h = verify.history(deck(case, "dilation", 1e-6, {"<dilation>0<": "<dilation>10<"}))
    psi = math.radians(10)
    a = G + (lame + G) * math.sin(friction) * math.sin(psi)
    plastic = (0.03 - strength / G) * G / a
    case.check("psi = 10: sigma_xy", h["sxy"][-1], strength + (0.03 - strength / G) * G - G * plastic, 1e-3)
    case.check("psi = 10: mean stress", (h["sxx"][-1] + h["syy"][-1]) / 2, -(lame + G) * math.sin(psi) * plastic, 1e-3)
    case.check("psi = 10: sigma_zz", h["szz"][-1], -lame * math.sin(psi) * plastic, 1e-3)
    h = verify.history(deck(case, "tresca", 1e-3, {"<friction>30<": "<friction>0<"}))
    case.check("phi = 0, eta = 0.001 s: sigma_xy", h["sxy"][-1], 1199999.999997, 1e-3)
    softening = "<friction>30</friction><softening_end>0.01</softening_end><cohesion_residual>0.5e6</cohesion_residual>"
    h = verify.history(deck(case, "softening", 5e-3, {"<friction>30</friction>": softening}))
    case.check("cohesion halved, eta = 0.005 s: sigma_xy", h["sxy"][-1], 1498460.109739, 1e-3)

    def draw(axes):
        for eta, h in curves:
            line, = axes.plot(h["time"] * 1e3, h["sxy"] / 1e6, label=f"{eta:g} s")
            axes.plot(h["time"][::20] * 1e3, closed_form(h["time"][::20], eta) / 1e6, ".", color=line.get_color(), markersize=4)
        axes.set_xlabel("time [ms] = 1000 x shear strain")
        axes.set_ylabel("shear stress [MPa]")
        axes.legend(title="relaxation time; dots: closed form", fontsize=8)

    case.figure("simple_shear", draw)
