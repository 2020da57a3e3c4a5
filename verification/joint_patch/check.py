import math
import re

import verify
import vtp


def joint(out):
    files = re.findall(r'file="([^"]*)"', open(f"{out}/joints.pvd").read())
    return vtp.read(f"{out}/{files[-1]}")


def run(case):
    plane = [(a, k, s) for s in (-0.1, 0.1) for a in (0, 10, 17, 30, 45) for k in ("quadratic", "cubic")]
    if case.quick:
        plane = [(0, "quadratic", -0.1), (17, "quadratic", 0.1)]
    for angle, kernel, stress in plane:
        a = math.radians(angle)
        rise = 5 * math.tan(a)
        out = case.run(f"{angle}_{kernel}_{stress}", entities=dict(kernel=kernel, stress=str(stress), y1=str(10 - rise), y2=str(10 + rise)))
        check(case, f"{angle} degrees, {kernel}, {'pressed' if stress < 0 else 'pulled'}", out, a, stress, 10 / math.cos(a), 1 if kernel == "quadratic" else 3)
    for angle in (0, 20) if not case.quick else ():
        a = math.radians(angle)
        rise = 6 * math.tan(a)
        out = case.run(f"solid_{angle}", "solid.xml", entities=dict(z1=str(6 - rise), z2=str(6 + rise)))
        check(case, f"three dimensions, {angle} degrees", out, a, -0.1, 36 / math.cos(a), 1)


def check(case, what, out, a, stress, area, noise):
    d = joint(out)
    A = d["area"]
    opening, sliding = stress * math.cos(a) ** 2 / 500, abs(stress) * math.sin(a) * math.cos(a) / 200
    case.check(f"{what}: area", A.sum(), area, 1e-3 if len(d["points"]) > 100 else 1e-6)
    case.check(f"{what}: opening [mm]", (A * d["opening"]).sum() / A.sum(), opening, 1e-3 * noise)
    if sliding > 0:
        along = (A[:, None] * d["shear"]).sum(0) / A.sum()
        case.check(f"{what}: slide [mm]", float((along @ along) ** 0.5), sliding, 3e-3 * noise)
