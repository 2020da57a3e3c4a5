# SPDX-License-Identifier: MIT
import numpy as np

import verify

FMPM4 = "<Transfer type='FMPM' order='4'/>"


def run(case):
    for name, transfer in (("FLIP", "<Transfer type='FLIP'/>"), ("FMPM(8)", "<Transfer type='FMPM' order='8'/>")) if not case.quick else (("FLIP", "<Transfer type='FLIP'/>"),):
        out = case.run(name.replace("(", "").replace(")", ""), entities=dict(kernel="uGIMP"), replace={FMPM4: transfer})
        content, got = verify.energy(out), verify.history(out)
        total = content["kinetic"] + content["elastic"]
        case.check(f"uGIMP, {name}: energy lost", 1 - total[-1] / total[0], 0, 0.015, "at most")
        case.check(f"uGIMP, {name}: energy gained", total.max() / total[0] - 1, 0, 1e-3, "at most")
        case.check(f"uGIMP, {name}: momentum, relative to one disk's", np.abs(got["px"]).max() / got["px:left"][0], 0, 1e-12, "at most")
    if case.quick:
        return

    # The answer must not depend on where the grid lines are, nor on who is said to move
    shifts = np.random.default_rng(1).uniform(0, 0.5, (10, 2))
    for name, contact in (("one field", {}), ("frictionless contact", {"    &contact;": "    &touch;"})):
        impulse = []
        for k, (x, y) in enumerate(shifts):
            grid = {"xmin='-26' xmax='26' ymin='-13' ymax='13'": f"xmin='{x - 26.5}' xmax='{x + 26}' ymin='{y - 13.5}' ymax='{y + 13}'"}
            momentum = verify.history(case.run(f"shift{k}", entities=dict(kernel="uGIMP"), replace=grid | contact))["px:left"]
            impulse.append(1 - momentum[-1] / momentum[0])
        case.check(f"uGIMP, FMPM(4), {name}, 10 shifts of the grid: spread of the impulse", np.ptp(impulse) / np.mean(impulse), 0, 0.02, "at most")
    for boost in (3.0, 12.0):
        frame = {"vx='&speed;'": f"vx='{4.969 + boost}'", "vx='-&speed;'": f"vx='{boost - 4.969}'"}
        momentum = verify.history(case.run(f"boost{boost}", entities=dict(kernel="uGIMP"), replace=frame | contact))["px:left"]
        mass = momentum[0] / (4.969 + boost)
        case.check(f"uGIMP, FMPM(4), frictionless contact, seen from a frame at {boost:g} m/s: impulse", (momentum[0] - momentum[-1]) / (mass * 4.969), np.mean(impulse), 0.02)
