# SPDX-License-Identifier: MIT
from math import erfc, pi

import numpy as np

import verify
import vtp

erfc = np.vectorize(erfc)


def slab(x, t):
    l = (2 * np.arange(400)[:, None] + 1) * pi / 2
    return 1 - (2 / l * np.sin(l * x) * np.exp(-l * l * t)).sum(axis=0)


def slab_errors(folder):
    for t, file in vtp.collection(folder):
        if t > 0:
            p = vtp.read(file)
            yield t, np.abs(p["temperature"] - slab(p["points"][:, 0], t)).max(), p


def check_slab(case):
    for name, kernel in (("uGIMP", "<GIMP/>"), ("CPDI", "<GIMP type='CPDI'/>"))[: 1 if case.quick else 2]:
        out = case.run(f"slab{name}", "slab.xml", dict(kernel=kernel), {" wallmin=\"0\"": ""})
        for t, error, p in slab_errors(out):
            case.check(f"slab, {name}: largest error of the temperature at t = {t:.2f}", error, 0, 0.05**2 / (12 * t), "at most")
        h = verify.history(out)
        case.check(f"slab, {name}: heat supplied over heat gained", h["Heat Supplied"][-1], h["Heat Energy"][-1], 1e-12)
    if case.quick:
        return
    at = {c: [e for _, e, _ in slab_errors(case.run(f"wall{c}", "slab.xml", dict(cell=c)))][-1] for c in ("0.05", "0.025")}
    case.check("slab, quadratic splines at a wall: error with half the cell over that before", at["0.025"] / at["0.05"], 0, 0.6, "at most")

    def draw(axes):
        x = np.linspace(0, 1, 200)
        for t, _, p in slab_errors(out):
            axes.plot(x, slab(x, t), "k-", lw=0.8)
            axes.plot(p["points"][:, 0], p["temperature"], ".", ms=3, label=f"t = {t:.2f}")
        axes.set(xlabel="x", ylabel="temperature", title="A slab held hot at x = 0; lines: series")
        axes.legend()

    case.figure("conduction_slab", draw)


def check_flux(case):
    out = case.run("flux", "flux.xml", dict(cell="0.025"))
    p, t = verify.last_particles(out), 0.05
    y = -p["points"][:, 2]
    rise = 200 / 3 * np.sqrt(t / pi)
    exact = 300 + 200 / 3 * (np.sqrt(t / pi) * np.exp(-y * y / (4 * t)) - y / 2 * erfc(y / (2 * np.sqrt(t))))
    case.check("flux: largest error over the rise of the surface", np.abs(p["temperature"] - exact).max() / rise, 0, 0.025**2 / (12 * t), "at most")
    h = verify.history(out)
    case.check("flux: heat gained", h["Heat Energy"][-1] - h["Heat Energy"][0], 0.05, 1e-10)
    case.check("flux: heat supplied", h["Heat Supplied"][-1], 0.05, 1e-10)


def check_contact(case):
    out = case.run("contact", "contact.xml", dict(kernel="<GIMP/>"))
    p, t = verify.last_particles(out), 0.05
    x, front = p["points"][:, 0], 0.05**2 / (12 * t / 3)
    face = 3 / (3 + np.sqrt(0.75))
    exact = np.where(x < 0, 1 - (1 - face) * erfc(-x / (2 * np.sqrt(t))), face * erfc(x / (2 * np.sqrt(t / 3))))
    case.check("two blocks: largest error of the temperature", np.abs(p["temperature"] - exact).max(), 0, front, "at most")
    h = verify.history(out)
    case.check("two blocks: heat that passed", h["Heat Energy:hot"][0] - h["Heat Energy:hot"][-1], 3 * (1 - face) * 2 * np.sqrt(t / pi) * 0.2, front)
    case.check("two blocks: heat of both", h["Heat Energy"][-1], h["Heat Energy"][0], 1e-12)
    h = verify.history(case.run("apart", "contact.xml", dict(gap="0.001", press="0")))
    case.check("two blocks, a gap of 0.02 cells: heat of the hot one", h["Heat Energy:hot"][-1], h["Heat Energy:hot"][0], 1e-12)

    def draw(axes):
        order = np.argsort(x)
        axes.plot(x[order], exact[order], "k-", lw=0.8, label="error functions")
        axes.plot(x, p["temperature"], ".", ms=3, label="particles")
        axes.set(xlabel="x", ylabel="temperature", title="A hot block against a cold one", xlim=(-0.7, 0.7))
        axes.legend()

    case.figure("conduction_contact", draw)


def run(case):
    check_slab(case)
    check_flux(case)
    check_contact(case)
