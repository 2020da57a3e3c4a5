import numpy as np

import verify

E, t, D, L, N = 1000.0, 1.0, 50.0, 10.0, 1.0
beta = np.sqrt(2 / (E * t) / (1 / D + 2 * t / (3 * E / 2)))  # the strips shear, too, G = E/2: Tsai, Oplinger & Morton (1998)


def run(case):
    p = verify.last_particles(case.run("lap"))
    x = p["points"] - p["displacement"]
    stress, shear = p["stress"][:, 0], p["stress"][:, 3]
    upper = x[:, 1] > 0
    # Force in the upper strip along the overlap; its slope is the traction
    places = np.unique(np.round(x[upper, 0], 6))
    force = np.array([stress[upper & (abs(x[:, 0] - s) < 1e-4)].mean() for s in places])
    middle = L / 2
    exact = lambda s: N / 2 * (1 + np.sinh(beta * (s - middle)) / np.sinh(beta * middle))
    inner = (places > 2) & (places < 8)
    case.check("force along the overlap, 2 mm from its ends: largest error over N", np.abs(force - exact(places))[inner].max(), 0, 0.02, "at most")
    slope = np.polyfit(places[abs(places - middle) < 1], force[abs(places - middle) < 1], 3)
    case.check("traction in the middle", np.polyval(np.polyder(slope), middle), N * beta / (2 * np.sinh(beta * middle)), 0.02)
