# SPDX-License-Identifier: MIT
import numpy as np

import verify

FREE = "<Rect xmin='0.11' xmax='0.89' ymin='0.11' ymax='0.89'/>"


def run(case):
    for dilation, exact in ((0, 6427279.592), (10, 7086413.937)):
        for label, inside in (("free interior", FREE), ("all nodes prescribed", "")):
            out = case.run(f"oedometer{dilation}{len(inside)}", "oedometer.xml", dict(dilation=dilation, inside=inside))
            case.check(f"oedometer, dilation {dilation} degrees, {label}: axial stress", -verify.history(out)["sxx"][-1], exact, 1e-4)
            if not inside:
                stress = verify.last_particles(out)["stress"][:, 0]
                case.check(f"oedometer, dilation {dilation} degrees, {label}: spread of the stress", np.ptp(stress) / exact, 0, 1e-4, "at most")
            if case.quick:
                break
    N = np.tan(np.radians(45 + 35 / 2)) ** 2
    cohesive = 2 * 5e3 * np.sqrt(N)
    for label, rate, strength, strain in (("compression", -0.05, lambda side: N * side + cohesive, 0.03), ("extension", 0.05, lambda side: (side - cohesive) / N, 0.015)):
        got = verify.history(case.run(label, "triaxial.xml", dict(rate=rate)))
        failed = got["time"] > strain / abs(rate)
        side, axial = -got["sxx"][failed], -got["syy"][failed]
        case.check(f"triaxial {label}: axial over lateral stress at failure, over its strength", (axial / strength(side)).mean(), 1, 0.01)
        case.check(f"triaxial {label}: lateral over hoop stress", (side / -got["szz"][failed]).mean(), 1, 0.01)
        # the traction is per area before the test; the mean radius is two thirds of the outer one
        area = (1 + 1.5 * got["dispx"][failed]) * np.exp(rate * got["time"][failed])
        case.check(f"triaxial {label}: lateral stress over traction", (side * area).mean() / 1e5, 1, 0.01)
    p = verify.last_particles(case.run("rest", "rest.xml"))
    deep = (p["points"][:, 1] > 1) & (p["points"][:, 1] < 9)
    ratio = p["stress"][deep, 0] / p["stress"][deep, 1]
    case.check("earth pressure at rest: horizontal over vertical stress", ratio.mean(), 0.3 / 0.7, 0.005)
    case.check("earth pressure at rest: largest deviation of it", np.abs(ratio / (0.3 / 0.7) - 1).max(), 0, 0.005, "at most")
