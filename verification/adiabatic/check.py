# SPDX-License-Identifier: MIT
import numpy as np

import verify

A, B, rho, c, G, cold, melting = 792e6, 510e6, 7830, 477, 200e9 / 2.58, 293, 1793


def shear(gamma, share):
    """Shear stress and temperature: dT = share q de/(rho c), q = (A + B e)(1 - t), gamma = tau/G + sqrt(3) e."""
    e = gamma / np.sqrt(3)
    for _ in range(100):
        left = np.exp(-share / (rho * c * (melting - cold)) * (A * e + B * e**2 / 2))
        tau = (A + B * e) * left / np.sqrt(3)
        e = (gamma - tau / G) / np.sqrt(3)
    return tau, melting - (melting - cold) * left


def run(case):
    variants = {
        "adiabatic, 90 % of the work": (0.9, {}),
        "adiabatic, all of it": (1.0, dict(quinney="")),
        "with conduction that has nowhere to go": (0.9, dict(thermal="<EnergyCoupling/><Conduction/>")),
        "isothermal": (0.0, dict(quinney="", thermal="")),
    }
    for k, (label, (share, entities)) in enumerate(variants.items()):
        if case.quick and k not in (0, 3):
            continue
        got = verify.history(case.run(f"shear{k}", "shear.xml", entities))
        flows = got["time"] > 1e-5
        tau, temperature = shear(1e4 * got["time"][flows], share)
        case.check(f"{label}: largest error of the shear stress, over it", np.abs(got["sxy"][flows] / tau - 1).max(), 0, 1e-3, "at most")
        case.check(f"{label}: largest error of the warming, over the last", np.abs(got["Temperature"][flows] - temperature).max() / 500, 0, 1e-3, "at most")
        if share:
            gained = got["Heat Energy"] - got["Heat Energy"][0]
            case.check(f"{label}: heat gained over the dissipated work", gained[-1] / got["Plastic Energy"][-1], share, 1e-11)
            case.check(f"{label}: heat of work over heat gained", got["Work Heat"][-1] / gained[-1], 1, 1e-11)
