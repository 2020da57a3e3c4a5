# SPDX-License-Identifier: MIT
import numpy as np

import verify


def deposit(case, label, cell=0.05, growth=0.01, **entities):
    out = case.run(label.replace(", ", "_").replace(" ", "_"), entities=entities)
    p = verify.last_particles(out)
    sand = p["material"] == 1  # the first material that the case names
    x, y = p["points"][sand, 0], p["points"][sand, 1]
    stress, ratio, mass = p["stress"][sand], p["volume_ratio"][sand], p["mass"][sand]
    column = np.floor(x / cell).astype(int)
    top = np.array([y[column == k].max(initial=0) for k in range(column.max() + 1)])
    depth = top[column] - y
    deep = depth > 2 * cell
    weight = 1600 * 9.81 * depth[deep]
    moving = verify.history(out)["Kinetic Energy:sand"]
    case.check(f"{label}: kinetic energy left over the largest", moving[-1] / moving.max(), 0, 1e-3, "at most")
    case.check(f"{label}: volume of the deposit over that of the column", np.average(ratio, weights=mass), 1, growth)
    pressure = -stress[deep, :3].sum(axis=1) / 3
    case.check(f"{label}: share of the particles two cells deep with less than a hundredth of the pressure of what lies above", np.mean(pressure < 0.01 * weight), 0, 0.15, "at most")
    # forces from outside act on the bed only, so the virial theorem gives the mean of the vertical stress
    if entities.get("analysis") is None:
        volume = ratio * mass / 1600
        case.check(f"{label}: mean vertical stress over that of the weight", -np.sum(stress[:, 1] * volume) / np.sum(mass * 9.81 * y), 1, 0.05)
    e = verify.energy(out)
    case.check(f"{label}: residual of the energy over what was released", np.abs(e["residual"]).max() / -np.min(e["potential"] - e["potential"][0]), 0, 0.02, "at most")


def run(case):
    deposit(case, "plane, APIC")
    if case.quick:
        return
    flip, fmpm = "<Transfer type='blend' fraction='0.99'/>", "<Transfer type='FMPM' order='2'/>"
    deposit(case, "plane, FLIP 0.99", transfer=flip)
    deposit(case, "plane, FMPM(2)", transfer=fmpm)
    deposit(case, "axisymmetric, APIC", analysis="13")
    deposit(case, "axisymmetric, FLIP 0.99", analysis="13", transfer=flip)
    for label, transfer in (("APIC", "<Transfer type='APIC'/>"), ("FLIP 0.99", flip)):
        deposit(case, f"plane, {label}, half the cells", cell=0.025, h="0.025", transfer=transfer)
        deposit(case, f"axisymmetric, {label}, half the cells", cell=0.025, h="0.025", analysis="13", transfer=transfer)
