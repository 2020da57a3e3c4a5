# SPDX-License-Identifier: MIT
import numpy as np

import verify

E, nu, strain = 1000.0, 0.25, 1e-4 * 10


def bar(case, label, stress, across, name="eyy", volume=16, replace=None, **entities):
    """A bar held along x and free across: mean stress and strain. Errors of the energy are over what the held bar stores."""
    out = case.run(label.replace(" ", "_"), file="bar.xml", entities=entities, replace=replace)
    got = {key: column[-1] for key, column in verify.history(out).items()}
    if stress:
        case.check(f"{label}: stress along the bar", got["sxx"], stress, 0.002)
    else:
        case.check(f"{label}: stress over E alpha dT", abs(got["sxx"]) / (E * strain), 0, 0.001, "at most")
    case.check(f"{label}: strain across", got[name], across, 0.005)
    rows = verify.energy(out)
    most = max(rows["elastic"].max(), 0.5 * E * strain**2 * volume)
    case.check(f"{label}: error of the energy", np.abs(rows["residual"]).max() / most, 0, 0.002, "at most")
    return got


def run(case):
    bar(case, "plane stress", -E * strain, (1 + nu) * strain)
    got = bar(case, "plane strain", -E * strain / (1 - nu), (1 + nu) / (1 - nu) * strain, analysis=10)
    case.check("plane strain: stress out of the plane", got["szz"], -E * strain / (1 - nu), 0.002)
    if case.quick:
        return
    solid = dict(analysis=12, depth="<Depth cellsize='1'/>", shape="<Box xmin='0' xmax='8' ymin='1' ymax='3' zmin='1' zmax='3'/>")
    bar(case, "in space", -E * strain, (1 + nu) * strain, volume=32, **solid)
    free = dict(along="<Horiz cellsize='1' symmin='0'/>", high="10", replace={"<TimeFactor>0.4": "<Transfer type='APIC'/><TimeFactor>0.1"})
    bar(case, "free bar", 0, strain, **free)
    got = bar(case, "free disc", 0, strain, volume=64, analysis=13, **free)
    case.check("free disc: hoop strain", got["ezz"], strain, 0.005)

    data = verify.last_particles(case.run("beam", file="beam.xml"))
    start = data["points"] - data["displacement"]
    x, y, v = start[:, 0], start[:, 1], data["displacement"][:, 1]
    # v = -curvature x^2/2 + alpha dT y^2/2 + constant, without stress
    design = np.stack([-(x**2) / 2, y**2 / 2, np.ones_like(x)], axis=1)
    curvature, thickening, _ = np.linalg.lstsq(design, v, rcond=None)[0]
    case.check("beam with a linear temperature: curvature", curvature, strain, 0.005)
    case.check("beam with a linear temperature: change of thickness", thickening, strain, 0.02)
    case.check("beam with a linear temperature: mean von Mises stress over E alpha dT", data["von_mises"].mean() / (E * strain), 0, 0.01, "at most")
