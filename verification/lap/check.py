# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

E, t, D, L, N = 1000.0, 1.0, 50.0, 10.0, 1.0
plane_traction = 0.0706  # of the plane problem, by finite elements; the theory of bars has 0.0695
beta = np.sqrt(2 / (E * t) / (1 / D + 2 * t / (3 * E / 2)))  # the strips shear, too, G = E/2: Tsai, Oplinger & Morton (1998)


def corners(turn, low, high):
    """A rectangle of the joint, as the points of a polygon where the grid sees them."""
    return "".join(f"<pt x='{x}' y='{y}'/>" for x, y in (turn @ (x, y) for x, y in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))))


def joint(case, degrees):
    """Places, forces and positions across the joint, in its own axes."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turn = np.array([[c, -s], [s, c]])
    if degrees == 0:
        out = case.run("lap")
    else:
        ends = dict(right=corners(turn, (9.88, 0), (10.1, 1)), left=corners(turn, (-0.1, -1), (0.12, 0)))
        out = case.run(f"turned_{degrees}", "turned.xml", entities=dict(c=c, s=s, **ends))
    p = verify.last_particles(out)
    x = (p["points"] - p["displacement"])[:, :2] @ turn
    sxx, syy, sxy = p["stress"][:, 0], p["stress"][:, 1], p["stress"][:, 3]
    return x, c * c * sxx + s * s * syy + 2 * c * s * sxy


def run(case):
    for degrees in (0,) if case.quick else (0, 17, 45):
        x, stress = joint(case, degrees)
        upper = (x[:, 1] > 0) & (x[:, 1] < 1)
        # Force in the upper strip along the overlap; its slope is the traction
        places = np.unique(np.round(x[upper, 0], 4))
        force = np.array([stress[upper & (abs(x[:, 0] - s) < 1e-3)].mean() for s in places])
        if degrees:  # cells that the faces cut: stresses scatter from column to column, forces of a millimetre do not
            places, force = (np.convolve(a, np.full(8, 1 / 8), "valid") for a in (places, force))
        middle = L / 2
        exact = N / 2 * (1 + np.sinh(beta * (places - middle)) / np.sinh(beta * middle))
        inner = (places > 2) & (places < 8)
        turned = f", turned by {degrees} degrees" if degrees else ""
        case.check(f"force along the overlap, 2 mm from its ends{turned}: largest error over N", np.abs(force - exact)[inner].max(), 0, 0.02, "at most")
        near = abs(places - middle) < (2 if degrees else 1)
        slope = np.polyfit(places[near], force[near], 3)
        case.check(f"traction in the middle{turned}", np.polyval(np.polyder(slope), middle), plane_traction, 0.02)
