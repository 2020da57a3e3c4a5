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
