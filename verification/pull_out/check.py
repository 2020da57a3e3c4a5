# SPDX-License-Identifier: MIT
import numpy as np

import verify

r, l, E, D = 0.05, 2.0, 70e3, 1e4
beta = np.sqrt(2 * D / (r * E))


def run(case):
    out = case.run("pull_out", entities=dict(h="0.025", top="1.99") if case.quick else {})
    p = verify.last_particles(out)
    fibre = p["von_mises"] > 1e-6
    y, u, stress = p["points"][fibre, 1] - p["displacement"][fibre, 1], p["displacement"][fibre, 1], p["stress"][fibre, 1]
    force = verify.history(out)["contacty:fibre"][-1] * 2 * np.pi  # per radian
    case.check("force that the interface carries", -force, np.pi * r**2, 0.005)
    # Mean displacement of the fibre along its length: u = u0 cosh(beta y)/cosh(beta l)
    inner = (y > 0.3) & (y < 1.7)
    u0 = np.sum(u[inner] * np.cosh(beta * y[inner])) / np.sum(np.cosh(beta * y[inner]) ** 2) * np.cosh(beta * l)
    case.check("stiffness, from the displacements", np.pi * r**2 / u0, np.pi * r**2 * E * beta * np.tanh(beta * l), 0.03)
    # and its decay
    decay = np.polyfit(y[(y > 0.9) & (y < 1.7)], np.log(stress[(y > 0.9) & (y < 1.7)] / np.tanh(beta * y[(y > 0.9) & (y < 1.7)])), 1)[0]
    case.check("decay of the stress (beta)", decay, beta, 0.03)
