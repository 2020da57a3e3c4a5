# SPDX-License-Identifier: MIT
import verify


def run(case):
    h = verify.history(case.run("moment"))
    case.check("moment: deflection [mm]", h["dispy:tip"][-1] * 1e3, 0.12, 1e-5)
    case.check("moment: rotation", h["turnz:tip"][-1], 2.4e-4, 1e-5)
    # an entity cannot stand for an attribute: the text itself is replaced
    h = verify.history(case.run("force", replace={"Mz='1000'": "Fy='1000'"}))
    case.check("force: deflection [mm]", h["dispy:tip"][-1] * 1e3, 0.08, 1e-5)
    case.check("force: held at the clamp [N]", h["forcey:clamp"][-1], 1000, 1e-5)
