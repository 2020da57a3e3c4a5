# SPDX-License-Identifier: MIT
import csv
import math
import re

import numpy as np

import verify
import vtp

tan30, tan10 = math.tan(math.radians(30)), math.tan(math.radians(10))
dilating = ("<friction>30</friction><friction-residual>30</friction-residual><dilation>10</dilation><dilation-residual>10</dilation-residual>"
            "<dilation-zero>1</dilation-zero>")


# the two blocks' own interface instead of a crack
two_materials = {
    "<CrackList lawname='joint'><Line xmin='0' ymin='10' xmax='40' ymax='10'/></CrackList>": "",
    "Name='lower'>": "Name='lower'><Friction lawname='joint' matname='upper'/>",
    "<TimeFactor>": "<MultiMaterialMode/><TimeFactor>",
}


def curve(out):
    """Per output time: means over the middle half of the joint of normal stress, shear stress, shear, slip and opening."""
    rows = []
    for t, f in re.findall(r'timestep="([^"]*)"[^>]*file="([^"]*)"', open(f"{out}/joints.pvd").read()):
        d = vtp.read(f"{out}/{f}")
        A = d["area"] * (abs(d["points"][:, 0] - 20.5) < 10)  # its ends part where the blocks no longer overlap
        A /= A.sum()
        rows.append([float(t), A @ d["normal_stress"], A @ d["traction"][:, 0], A @ d["shear"][:, 0], A @ d["slip"], A @ d["opening"]])
    return dict(zip(("time", "normal", "shear_stress", "shear", "slip", "opening"), np.array(rows).T))


def audit(case, what, out):
    with open(f"{out}/energy.csv") as f:
        rows = list(csv.DictReader(f))
    put_in = abs(float(rows[-1]["boundary_work"])) + abs(float(rows[-1]["external_work"]))
    case.check(f"{what}: energy that is not accounted for / put in", abs(float(rows[-1]["residual"])) / put_in, 0, 1e-2, "at most")


def constant_load(case, what, replace=None):
    out = case.run(f"{what} load", entities=dict(law=dilating, end="20" if case.quick else "44"), replace=replace)
    got = curve(out)
    sliding = got["time"] > 15
    case.check(f"{what}: normal stress [MPa]", got["normal"][sliding].mean(), -1, 2e-2)
    case.check(f"{what}: shear stress [MPa]", got["shear_stress"][sliding].mean(), tan30, 2e-2)
    rise = np.polyfit(got["shear"][sliding & (got["shear"] < 0.95)], got["opening"][sliding & (got["shear"] < 0.95)], 1)[0]
    case.check(f"{what}: uplift per shear", rise, tan10, 5e-2)
    if not case.quick:
        case.check(f"{what}: whole uplift [mm]", got["opening"][-1] + 1 / 20, (1 - tan30 / 10) * tan10, 5e-2)
    audit(case, what, out)
    return got


def weakening(case, what, replace=None):
    weak = ("<cohesion>0.5</cohesion><friction>30</friction><cohesion-residual>0.1</cohesion-residual><friction-residual>20</friction-residual>"
            "<slip-dc>0.4</slip-dc><tension>0.2</tension>")
    out = case.run(f"{what} weak", entities=dict(law=weak, speed="0.03", end="40", archive="0.25"), replace=replace)
    soft = curve(out)
    tan20 = math.tan(math.radians(20))
    case.check(f"{what}: peak [MPa]", soft["shear_stress"].max(), 0.5 + tan30, 2e-2)
    case.check(f"{what}: residual [MPa]", soft["shear_stress"][-1], 0.1 + tan20, 2e-2)
    half = np.interp(0.2, soft["slip"], soft["shear_stress"])
    case.check(f"{what}: half way [MPa]", half, 0.5 * (0.5 + tan30 + 0.1 + tan20), 2e-2)
    audit(case, what, out)
    return soft


def run(case):
    got = constant_load(case, "constant load")
    if case.quick:
        return
    constant_load(case, "two materials, constant load", two_materials)
    soft = weakening(case, "weakening")
    weakening(case, "two materials, weakening", two_materials)

    # the lower block is pressed against a lid by 1 MPa, 1/k_n + H/E = 0.075 mm
    E = 400.0
    out = case.run("stiffness", entities=dict(law=dilating, E=str(E), lift="0.03*sin(0.628318530718*min(t,5))^2", pressure="0", end="36"),
                   replace={"<Vert cellsize='2'/>": "<Vert cellsize='2' symmax='20'/>"})
    stiff = curve(out)
    sliding = (stiff["time"] > 14) & (stiff["shear"] < 0.95)
    slope = np.polyfit(stiff["shear"][sliding], -stiff["normal"][sliding], 1)[0]
    case.check("constant stiffness: growth of the normal stress [MPa/mm]", slope, tan10 / (1 / 20 + 10 / E), 2e-2)
    ratio = stiff["shear_stress"][sliding] / -stiff["normal"][sliding]
    case.check("constant stiffness: shear over normal stress", ratio.mean(), tan30, 2e-2)

    def draw(axes):
        axes.plot(got["shear"], got["shear_stress"], label="shear stress, constant load")
        axes.plot(soft["shear"], soft["shear_stress"], label="shear stress, weakening")
        axes.plot(stiff["shear"], stiff["shear_stress"], label="shear stress, constant stiffness")
        axes.plot(stiff["shear"], -stiff["normal"], "--", label="normal stress, constant stiffness")
        axes.set_xlabel("shear [mm]")
        axes.set_ylabel("stress [MPa]")
        axes.legend()

    case.figure("joint_direct_shear", draw)
