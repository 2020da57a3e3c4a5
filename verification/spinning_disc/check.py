# SPDX-License-Identifier: MIT
import numpy as np

import verify
import vtp


def stress_errors(out, n):
    """Errors of the stress in the centre and of the hoop stress at the rim, means of the outputs of one revolution.

    The particles start with the exact stress, but not in the equilibrium of the grid, so that the disc vibrates, undamped, by some per cent.
    """
    errors = []
    for _, file in vtp.collection(out)[1:]:
        data = vtp.read(file)
        x, s = data["points"], data["stress"]
        r = np.hypot(x[:, 0], x[:, 1])
        c, k = x[:, 0] / r, x[:, 1] / r
        hoop = s[:, 0] * k**2 + s[:, 1] * c**2 - 2 * s[:, 3] * c * k
        inside = r < 0.09
        slope, centre = np.polyfit(r[inside] ** 2, hoop[inside], 1)
        errors.append((centre / (1.25e4 * (3 + n)) - 1, (centre + 0.01 * slope) / (1.25e4 * (2 - 2 * n)) - 1))
    return np.mean(errors, axis=0)


def run(case):
    settings = {"plane stress": dict(analysis=11, n=0.3, rest=0), "plane strain": dict(analysis=10, n=0.3 / 0.7, rest=0.3)}
    for kernel in ("uGIMP", "quadratic"):
        for name, entities in settings.items():
            if case.quick and (kernel, name) != ("uGIMP", "plane stress"):
                continue
            out = case.run(f"{kernel}_{entities['analysis']}", entities=dict(kernel=kernel, **entities))
            spin = verify.history(out)["Lpz"]
            case.check(f"{kernel}, {name}: drift of the angular momentum in a revolution", abs(spin / spin[0] - 1).max(), 0, 1e-4, "at most")
            centre, rim = stress_errors(out, entities["n"])
            case.check(f"{kernel}, {name}: stress in the centre", abs(centre), 0, 0.02, "at most")
            case.check(f"{kernel}, {name}: hoop stress at the rim", abs(rim), 0, 0.02, "at most")
