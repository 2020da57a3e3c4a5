# SPDX-License-Identifier: MIT
import numpy as np

import verify

V, A = 1e-3, 0.05
schemes = {"FMPM(4)": {}, "APIC": dict(transfer="<Transfer type='APIC'/>")}


def bar(name, left, speed):
    return f"<Body matname='{name}'><vel0X>{speed}</vel0X><Rect xmin='{left}' xmax='{left + 1}' ymin='0' ymax='&height;'/></Body>"


def material(name):
    return f"<Material Type='NeoHookean' Name='{name}'><rho>1</rho><E>1</E><nu>0</nu></Material>"


def cradle(case, label, n, **entities):
    """Momenta over that of the first bar at the start, by bar."""
    names = [f"bar{k}" for k in range(n)]
    text = dict(bodies="".join(bar(name, k + (0.0 if k == 0 else 0.025), V if k == 0 else 0) for k, name in enumerate(names)),
                materials="".join(map(material, names)), histories="".join(f"<GlobalArchive type='px' matname='{name}'/>" for name in names),
                end=str(25 + 2 * n + 3))
    got = verify.history(case.run(label, entities=entities, replace={f"&{k};": v for k, v in text.items() if k != "end"} | {"<!ENTITY end \"60\">": f"<!ENTITY end \"{text['end']}\">"}))
    return [got[f"px:{name}"] / (V * A) for name in names]


def run(case):
    for name, entities in schemes.items() if not case.quick else [("FMPM(4)", {})]:
        for n in (3, 5) if not case.quick else (3,):
            p = cradle(case, f"{n}{name[:4]}", n, **entities)
            case.check(f"{n} bars, {name}: speed of the last", p[-1][-1], 1, 0.03 if name == "FMPM(4)" else 0.08)
            case.check(f"{n} bars, {name}: largest speed of the others", max(abs(q[-1]) for q in p[:-1]), 0, 0.03 if name == "FMPM(4)" else 0.08, "at most")
            case.check(f"{n} bars, {name}: momentum", np.abs(sum(p) - 1).max(), 0, 1e-12, "at most")

    text = dict(bodies="<Body matname='floor'><Rect xmin='-0.2' xmax='0' ymin='0' ymax='&height;'/></Body>" + bar("bar", 0.25, 0),
                materials="<Material Type='RigidContact' Name='floor'/>" + material("bar"), histories="<GlobalArchive type='dispx' matname='bar'/><GlobalArchive type='velx' matname='bar'/>")
    entities = dict(contact="<MultiMaterialMode Impulses='faces'/>", g="2e-4", h="0.0125", height="0.025", left="-0.4", right="2", end="1055" if not case.quick else "105")
    got = verify.history(case.run("bounce", entities=entities, replace={f"&{k};": v for k, v in text.items()}))
    t, x, v = got["time"], got["dispx:bar"], got["velx:bar"]
    inside = x < -0.25 + 0.001
    starts = np.flatnonzero(~inside[:-1] & inside[1:])
    ends = np.flatnonzero(inside[:-1] & ~inside[1:]) + 1
    ratios = [-v[after] / v[before] for before, after in zip(starts, ends)]
    case.check(f"bar on a floor, smallest ratio of speeds of {len(ratios)} bounces: below 0.985 by", 0.985 - min(ratios), 0, 0, "at most")
    case.check("largest height over the first", x.max() / 0.25, 0, 1e-6, "at most")
    if not case.quick:
        case.check("number of bounces seen", len(ratios), 10, 1, "absolute")
