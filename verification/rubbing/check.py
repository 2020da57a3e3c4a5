# SPDX-License-Identifier: MIT
from math import erfc, pi

import numpy as np

import verify

erfc = np.vectorize(erfc)


def check_blocks(case):
    schemes = {"FLIP": "<Transfer type='FLIP'/>", "APIC": "<Transfer type='APIC'/>", "FMPM(2)": "<Transfer type='FMPM' order='2'/>"}
    for name, transfer in list(schemes.items())[: 1 if case.quick else 3]:
        h = verify.history(case.run("blocks" + name[:4], entities=dict(transfer=transfer)))
        case.check(f"{name}: warming of the blocks", h["Temperature"][-1], 100 / (8 * 385), 0.01)
        case.check(f"{name}: heat over work of friction", h["Heat Energy"][-1] / h["Friction Work"][-1], 1, 1e-10)
        case.check(f"{name}: momentum", h["px"][-1], h["px"][0], 1e-12)


def half_space(y, t, k, diffusivity):
    """Temperature for a unit flux from t = 0."""
    if t <= 0:
        return 0 * y
    s = diffusivity * t
    return 2 / k * (np.sqrt(s / pi) * np.exp(-y * y / (4 * s)) - y / 2 * erfc(y / (2 * np.sqrt(s))))


def check_plate(case):
    out = case.run("plate", "plate.xml")
    h, p = verify.history(out), verify.last_particles(out)
    t, work, k = h["time"], h["Friction Work"], 4.01e5
    y = (np.arange(16) + 0.5) * 0.00125
    exact = 0 * y
    for i in range(len(t) - 1):
        flux = (work[i + 1] - work[i]) / (t[i + 1] - t[i]) / 0.1
        exact += flux * (half_space(y, t[-1] - t[i], k, k / (8900 * 385)) - half_space(y, t[-1] - t[i + 1], k, k / (8900 * 385)))
    block = p["material"] == 1
    row = np.round(-p["points"][block, 1] / 0.00125 - 0.5).astype(int)
    mean = np.array([p["temperature"][block][row == r].mean() for r in range(16)])
    case.check("plate: largest error over the warming of the surface", np.abs(mean - exact).max() / exact[0], 0, 0.01, "at most")
    case.check("plate: heat over work of friction", h["Heat Energy"][-1] / work[-1], 1, 1e-10)

    def draw(axes):
        axes.plot(1e3 * y, exact, "k-", lw=0.8, label="half space")
        axes.plot(1e3 * y, mean, "o", ms=4, label="rows of particles")
        axes.set(xlabel="depth (mm)", ylabel="warming (K)", title="Under a rubbing plate")
        axes.legend()

    case.figure("rubbing", draw)


def check_floor(case):
    """The work of friction is right for each update of the stress."""
    plus = "<MPMMethod>{}</MPMMethod>"
    updates = {"USL+": plus.format("USL"), "USF": plus.format("USF"), "USAVG+": plus.format("USAVG")}
    for name, update in updates.items():
        ledger = verify.energy(case.run("floor" + name, "floor.xml", dict(update=update)))
        case.check(f"FLIP, {name}: energy that is not accounted for over the work of friction", abs(ledger["residual"][-1]) / ledger["contact"][-1], 0, 5e-3, "at most")


def run(case):
    check_blocks(case)
    check_floor(case)
    check_plate(case)
