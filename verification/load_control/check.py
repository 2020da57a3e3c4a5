# SPDX-License-Identifier: MIT
import numpy as np

import verify


def follow(case, what, final, column, sign, **entities):
    rows = verify.history(case.run(what.replace(" ", "_"), entities=entities))
    force, time = sign * rows[column], rows["time"]
    held = time > 1.2
    case.check(f"{what}: force at the end [N/mm]", force[held].mean(), final, 5e-3)
    case.check(f"{what}: largest deviation of the force while it is held", np.abs(force[held] / final - 1).max(), 0, 5e-3, "at most")
    if column.startswith("contact"):  # a grip that prescribes velocities of nodes holds the particles near its face, too
        case.check(f"{what}: stress of the bar [MPa]", rows["sxx:bar"][held].mean(), final / 4, 5e-3)
    rising = (time > 0.3) & (time < 0.6)
    case.check(f"{what}: lag of the force behind the ramp, of the final load", np.abs(force / final - time / 0.6)[rising].max(), 0, 2e-2, "at most")


def run(case):
    follow(case, "pulled", 20, "reactionx:grip", 1)
    # pushed by contact
    follow(case, "pushed", -20, "contactx:grip", -1, load="-20*min(t/0.6,1)", velocity="-1", mode="<MultiMaterialMode/>", force="contactx",
           grip="<Material Type='RigidContact' Name='grip'/>")
