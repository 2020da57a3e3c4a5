import numpy as np

import verify


def run(case):
    p = verify.last_particles(case.run("platens"))
    block = p["von_mises"] > 0
    X, u = (p["points"] - p["displacement"])[block], p["displacement"][block]
    outer = X[:, 0].max()
    edge = np.flatnonzero(X[:, 0] > outer - 1e-6)
    edge = edge[np.argsort(X[edge, 1])]
    out = u[edge, 0] * 5 / outer  # of the surface, by the strain
    exact = 5 * 0.3 / 0.7 * 0.01
    case.check("displacement of the edge next to the lower platen falls short of 0.0205 by", 0.0205 - out[0], 0, 0, "at most")
    case.check("next to the upper platen", 0.0205 - out[-1], 0, 0, "at most")
    case.check("displacement of the edge in the middle", out[len(out) // 2], exact, 0.01)
    stress = p["stress"][block, 1]
    case.check("mean stress", stress.mean(), -1 / 0.91, 0.01)
    case.check("spread of the stress (RMS)", np.std(stress / stress.mean()), 0, 0.03, "at most")
