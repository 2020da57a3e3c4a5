# SPDX-License-Identifier: MIT
import math
import re

import verify
import vtp


def joint(out):
    files = re.findall(r'file="([^"]*)"', open(f"{out}/joints.pvd").read())
    return vtp.read(f"{out}/{files[-1]}")


laws = "<rho>1</rho><E>1000</E><nu>0.25</nu>"
crack_2d = "<CrackList lawname='joint'><Line xmin='&x1;' ymin='&y1;' xmax='&x2;' ymax='&y2;'/></CrackList>"
crack_3d = "<CrackList lawname='joint'><Quad x1='-3' y1='-3' z1='&z1;' x2='9' y2='-3' z2='&z2;' x3='-3' y3='9' z3='&z1;'/></CrackList>"


def two_materials(tan, solid=False):
    """What makes of the column two materials that meet in a plane of slope tan: their particles are sheared along it near by, less farther off."""
    axis, row, middle, half = ("Z", 3, 6, 3) if solid else ("Y", 2, 10, 5)
    top, flat = 2 * middle, 2 * middle - 1.5
    near = middle - 1

    def body(material, low, high, share, slope):  # share: of the shift, a function of the height; slope: its derivative
        shift = f"(x-{half})*{tan}"
        others = "".join(f" F{i}{j}='{int(i == j)}'" for i in range(1, row + 1) for j in range(1, row + 1) if (i, j) not in ((row, 1), (row, row)))
        deform = f"<Deform d{axis}='{shift}*{share}' F{row}1='{tan}*{share}' F{row}{row}='1+{shift}*{slope}'{others}/>"
        box = "xmin='0' xmax='6' ymin='0' ymax='6' zmin='{}' zmax='{}'" if solid else "xmin='0' xmax='10' ymin='{}' ymax='{}'"
        return f"<Body matname='{material}'>{deform}<{'Box' if solid else 'Rect'} {box.format(low, high)}/></Body>"

    height = axis.lower()
    bodies = (body("rock", 0, near, f"{height}/{near}", 1 / near) + body("rock", near, middle, "1", 0) + body("roof", middle, middle + 1, "1", 0)
              + body("roof", middle + 1, flat, f"({flat}-{height})/{flat - middle - 1}", -1 / (flat - middle - 1)) + body("roof", flat, top, "0", 0))
    whole = ("<Body matname='rock'><Box xmin='0' xmax='6' ymin='0' ymax='6' zmin='0' zmax='12'/></Body>" if solid
             else "<Body matname='rock'><Rect xmin='0' xmax='10' ymin='0' ymax='20'/></Body>")
    return {
        whole: bodies,
        crack_3d if solid else crack_2d: "",
        f"Name='rock'>{laws}": f"Name='rock'>{laws}<Friction lawname='joint' matname='roof'/></Material><Material Type='LinearElastic' Name='roof'>{laws}",
        "<TimeFactor>": "<MultiMaterialMode/><TimeFactor>",
    }


def run(case):
    between_materials(case)
    plane = [(a, k, s) for s in (-0.1, 0.1) for a in (0, 10, 17, 30, 45) for k in ("quadratic", "cubic")]
    if case.quick:
        plane = [(0, "quadratic", -0.1), (17, "quadratic", 0.1)]
    for angle, kernel, stress in plane:
        a = math.radians(angle)
        rise = 5 * math.tan(a)
        out = case.run(f"{angle}_{kernel}_{stress}", entities=dict(kernel=kernel, stress=str(stress), y1=str(10 - rise), y2=str(10 + rise)))
        what = f"{angle} degrees, {kernel}, {'pressed' if stress < 0 else 'pulled'}"
        check(case, what, out, a, stress, 10 / math.cos(a), 1 if kernel == "quadratic" else 3)
        if angle == 0 and kernel == "quadratic":
            case.check(f"{what}: largest error of the stress of a row beside the joint", beside(out, stress), 0, 0.02, "at most")
    # Through centres of particles, and between centres and edges: the joint is at the nearest edge, which is in the check.
    for height in (9.75, 9.9, 10.2) if not case.quick else (9.75,):
        out = case.run(f"row_{height}", entities=dict(y1=str(height), y2=str(height)))
        check(case, f"along a row of particles, y = {height}", out, 0.0, -0.1, 10, 1)
        case.check(f"along a row of particles, y = {height}: largest error of the stress of a row beside the joint", beside(out, -0.1), 0, 0.02, "at most")
        case.check(f"along a row of particles, y = {height}: height of the joint", joint(out)["points"][:, 1].mean(), round(2 * height + 1e-9) / 2, 5e-4)  # the column is pressed, by 1e-3 mm there
    for angle in (0, 20) if not case.quick else ():
        a = math.radians(angle)
        rise = 6 * math.tan(a)
        out = case.run(f"solid_{angle}", "solid.xml", entities=dict(z1=str(6 - rise), z2=str(6 + rise)))
        check(case, f"three dimensions, {angle} degrees", out, a, -0.1, 36 / math.cos(a), 1)


def between_materials(case):
    plane = [(a, k, s) for s in (-0.1, 0.1) for a in (0, 17, 45) for k in ("quadratic", "cubic")]
    if case.quick:
        plane = [(17, "quadratic", -0.1)]
    for angle, kernel, stress in plane:
        a = math.radians(angle)
        out = case.run(f"materials_{angle}_{kernel}_{stress}", entities=dict(kernel=kernel, stress=str(stress)), replace=two_materials(math.tan(a)))
        check(case, f"two materials, {angle} degrees, {kernel}, {'pressed' if stress < 0 else 'pulled'}", out, a, stress, 10 / math.cos(a), 1)
    for angle in (0, 20) if not case.quick else ():
        a = math.radians(angle)
        out = case.run(f"materials_solid_{angle}", "solid.xml", replace=two_materials(math.tan(a), solid=True))
        check(case, f"two materials, three dimensions, {angle} degrees", out, a, -0.1, 36 / math.cos(a), 1)
    if not case.quick:
        axis = {"<Analysis>10</Analysis>": "<Analysis>13</Analysis>", "<Grid xmin='-4'": "<Grid xmin='0'"}
        out = case.run("materials_axisymmetric", replace=two_materials(0.0) | axis)
        check(case, "two materials, axisymmetric", out, 0.0, -0.1, 50, 1)


def beside(out, stress):
    """Largest error of the axial stress, mean of a row of particles, over the stress: rows within two cells of the joint, away from the free sides."""
    p = verify.last_particles(out)
    x = p["points"] - p["displacement"]
    near = (abs(x[:, 0] - 5) < 3) & (abs(x[:, 1] - 10) < 2)
    rows = (2 * x[near, 1]).round(1)
    return max(abs(p["stress"][near, 1][rows == row].mean() / stress - 1) for row in set(rows))


def check(case, what, out, a, stress, area, noise):
    d = joint(out)
    A = d["area"]
    opening, sliding = stress * math.cos(a) ** 2 / 500, abs(stress) * math.sin(a) * math.cos(a) / 200
    case.check(f"{what}: area", A.sum(), area, 1e-3 if len(d["points"]) > 100 else 1e-6)
    case.check(f"{what}: opening [mm]", (A * d["opening"]).sum() / A.sum(), opening, 1e-3 * noise)
    if sliding > 0:
        along = (A[:, None] * d["shear"]).sum(0) / A.sum()
        case.check(f"{what}: slide [mm]", float((along @ along) ** 0.5), sliding, 3e-3 * noise)
