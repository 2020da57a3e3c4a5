# SPDX-License-Identifier: MIT
import numpy as np

import verify

E, nu, delta, bore, outer, length = 20e3, 0.3, 0.1, 10.0, 20.0, 10.0


def radial_force():
    """Lame's solution with the logarithmic hoop strain and the mean radii, which is exact to second order in the strain."""
    strain, inner, outside = np.log(1 + delta / bore), bore + delta / 2, outer + delta * bore / outer / 2
    pressure = E * strain / ((inner**2 + outside**2) / (outside**2 - inner**2) + nu)
    return pressure * (bore + delta) * length


def fit(case, label, **entities):
    out = case.run(label.replace(", ", "_"), file="fit.xml", entities=entities)
    got = verify.history(out)
    through = got["time"] > 1.8  # the taper has left the ring, which still vibrates
    case.check(f"fit, {label}: mean radial force over that of Lame", -got["contactR:shaft"][through].mean() / radial_force(), 1, 0.02)
    p = verify.last_particles(out)
    x, u = p["points"], p["displacement"]
    at_bore = (abs(x[:, 0] - u[:, 0] - 10.2) < 0.1) & (abs(x[:, 1] - u[:, 1] - 5) < 4)
    case.check(f"fit, {label}: smallest displacement of the particles at the bore", u[at_bore, 0].min(), delta, 0.02)


def lift(case, label, **entities):
    """Force on the block, and the smallest displacement of its lowest particles, 1 mm from its sides."""
    out = case.run(label.replace(", ", "_"), file="wedge.xml", entities=entities)
    got = verify.history(out)
    p = verify.last_particles(out)
    x, u = p["points"], p["displacement"]
    low = (p["material"] == 1) & (x[:, 1] - u[:, 1] < 0.2) & (abs(x[:, 0] - 5) < 4)
    return got["contacty:block"][-1], got["contactx:block"][-1], u[low, 1].min()


plate = dict(end="12", low="0", top="0", x="-10*(t>0.6)", y="0.2*(0.5>t)")


def run(case):
    for impulses in ("nodes",) if case.quick else ("nodes", "faces"):
        force, *_ = lift(case, f"plate, {impulses}", impulses=impulses, **plate)
        for end, slope in (("12", 5.7),) if case.quick else (("12", 5.7), ("16", 1.9)):
            label = f"wedge of {slope} degrees, {impulses}"
            f, side, least = lift(case, label, impulses=impulses, end=end)
            case.check(f"{label}: force over that of the plate", f / force, 1, 0.04)
            case.check(f"{label}: tangential force over the normal one", side / f, 0, 0.001, "absolute")
            case.check(f"{label}: smallest displacement of the face", least, delta, 0.04)
    fit(case, "taper of 1.9 degrees, nodes")
    if case.quick:
        return
    fit(case, "taper of 1.9 degrees, faces", impulses="faces")
    fit(case, "taper of 5.7 degrees, nodes", end="12")
    fit(case, "taper of 1.9 degrees, FLIP 0.99", transfer="<Transfer type='blend' fraction='0.99'/>")
    fit(case, "taper of 1.9 degrees, cells of 0.25 mm", h="0.25")
