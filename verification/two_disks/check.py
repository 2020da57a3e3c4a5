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
    rebound = []
    shifts = np.random.default_rng(1).uniform(0, 0.5, (10, 2))
    for k, (x, y) in enumerate(shifts):
        grid = {"xmin='-26' xmax='26' ymin='-13' ymax='13'": f"xmin='{x - 26.5}' xmax='{x + 26}' ymin='{y - 13.5}' ymax='{y + 13}'"}
        out = case.run(f"shift{k}", entities=dict(kernel="uGIMP"), replace=grid)
        momentum = verify.history(out)["px:left"]
        rebound.append(-momentum[-1] / momentum[0])
    case.check("uGIMP, FMPM(4), 10 shifts of the grid: spread of the rebound", np.ptp(rebound), 0, 0.01, "at most")
    for boost in (3.0, 12.0):
        replace = {"vx='&speed;'": f"vx='{4.969 + boost}'", "vx='-&speed;'": f"vx='{boost - 4.969}'"}
        out = case.run(f"boost{boost}", entities=dict(kernel="uGIMP"), replace=replace)
        got = verify.history(out)
        mass = got["px:left"][0] / (4.969 + boost)
        case.check(f"uGIMP, FMPM(4), seen from a frame at {boost:g} m/s: rebound", -(got["px:left"][-1] - mass * boost) / (mass * 4.969), np.mean(rebound), 0.01)
