# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

methods = dict(margin="largest margin (default)", logreg="logistic regression", linreg="linear regression", avggrad="mean gradient", maxgrad="larger gradient",
               maxvol="gradient of the larger volume", owngrad="own gradient")
orders = {"USF": ("USF", True), "USL-": ("USL", True), "USL+": ("USL", False), "USAVG-": ("USAVG", True), "USAVG+": ("USAVG", False)}
transfers = {"FLIP": "type='FLIP'", "APIC": "type='APIC'", "XPIC(2)": "type='XPIC' order='2'", "FMPM(2)": "type='FMPM' order='2'", "FMPM(4)": "type='FMPM' order='4'"}
exact = 9.81 * (math.sin(math.pi / 6) - 0.3 * math.cos(math.pi / 6))


def slide(case, name, turned, normals="", **entities):
    """Error of the acceleration on the slab."""
    c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
    entities |= dict(c=repr(c), s=repr(s), contact=f"<MultiMaterialMode {normals}><Friction lawname='law'/></MultiMaterialMode>")
    entities.setdefault("transfer", "<Transfer type='FMPM' order='2'/>")
    replace = {}
    if turned:
        entities["grid"] = "<Grid xmin='-1.5' xmax='3.5' ymin='-1.5' ymax='3.5'><Horiz cellsize='0.05'/><Vert cellsize='0.05'/></Grid>"
        corner = lambda x, y: (c * x - s * y, s * x + c * y)
        (x1, y1), (x2, y2) = corner(-0.6, -0.25), corner(3, -0.25)
        replace = {"x1='-0.6' y1='-0.25' x2='3' y2='-0.25'": f"x1='{x1}' y1='{y1}' x2='{x2}' y2='{y2}'"}
    got = verify.history(case.run(name, "slide.xml", entities, replace))
    t, v = got["time"], c * got["velx:block"] + s * got["vely:block"]
    return np.polyfit(t[t > 0.6], v[t > 0.6], 1)[0] / exact - 1


def rebound(case, name, normals):
    entities = dict(contact=f"<MultiMaterialMode {normals}/>")
    got = verify.history(case.run("bars" + name, "../impact/case.xml", entities))
    return -got["px:a"][-1] / got["px:a"][0]


def percent(x):
    return f"{100 * x:+.3f} %" if abs(x) < 0.005 else f"{100 * x:+.1f} %"


def run(case):
    if case.quick:
        case.check("largest margin, slab turned by 17 degrees: acceleration", 1 + slide(case, "margin17", 17), 1, 5e-4)
        return
    rows = []
    for method, name in methods.items():
        normals = f"Normals='{method}' Separation='edges'"
        errors = [slide(case, f"{method}{turned}", turned, normals) for turned in (0, 17, 45)]
        back = rebound(case, method, normals)
        rows.append([name, *map(percent, errors), f"{back:.3f}"])
        if method == "margin":
            for turned, error in zip((0, 17, 45), errors):
                case.check(f"largest margin, slab turned by {turned} degrees: acceleration", 1 + error, 1, 5e-4)
            case.check("largest margin: rebound of the bars", back, 1, 0.025)
    case.table("Normals between deformable bodies: error of the acceleration, and rebound", ["normals", "0 degrees", "17", "45", "bars"], rows)

    rows = []
    for order, (method, skip) in orders.items():
        errors = {}
        for name, transfer in transfers.items():
            errors[name] = slide(case, f"{order}{name}", 17, method=method, skip="<SkipPostExtrapolation/>" if skip else "", transfer=f"<Transfer {transfer}/>")
        rows.append([order, *map(percent, errors.values())])
        worst = max(abs(errors[name]) for name in errors)
        case.check(f"{order}, all transfers, slab turned by 17 degrees: largest error of the acceleration", worst, 0, 5e-3, "at most")
    case.table("Update orders and transfers, slab turned by 17 degrees: error of the acceleration", ["order", *transfers], rows)
