import numpy as np

import verify

G, lame, J = 1 / 2.6, 0.3 / (1.3 * 0.4), 0.5
vertical = G / J * (J**2 - 1) + 0.5 * lame * (J - 1 / J)
pressure = -(vertical + lame * (J - 1 / J)) / 3


def run(case):
    for impulses in ("faces", "nodes"):
        out = case.run(impulses, entities=dict(contact=f"<MultiMaterialMode Impulses='{impulses}'/>"))
        p = verify.last_particles(out)
        filling = p["von_mises"] > 0
        x = p["points"][filling]
        outside = (x[:, 0] < 0) | (x[:, 0] > 1) | (x[:, 1] < 0) | (x[:, 1] > 0.5)
        case.check(f"impulses on {impulses}: particles that leaked", outside.sum(), 0, 0, "at most")
        if impulses == "faces":
            force = verify.history(out)["contacty:filling:piston"][-1]
            case.check("force on the piston", force, vertical, 0.01)
            case.check("mean pressure", p["pressure"][filling].mean(), pressure, 0.01)
        if case.quick:
            return
