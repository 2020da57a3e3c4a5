# SPDX-License-Identifier: MIT
import numpy as np

import verify

E, W = 1e5, 0.15


def force(u, stiffness, Gc, exponential):
    """Traction of a bar of unit length with a crack in it, where its ends have moved by u: u = t/stiffness + opening(t)."""
    t = np.linspace(1, 1e-6, 20000)
    opening = -Gc * np.log(t) if exponential else 2 * Gc * (1 - t)
    softening = np.interp(u, t / stiffness + opening, t, right=0)
    return np.where(u < 1 / stiffness, stiffness * u, softening)


def polygon(s0, s1, t0, t1, c, s):
    corners = ((s0, t0), (s1, t0), (s1, t1), (s0, t1))
    return "<Polygon>" + "".join(f"<pt x='{a * c - b * s:.12g}' y='{a * s + b * c:.12g}'/>" for a, b in corners) + "</Polygon>"


def cells(n):
    h = 1 / n
    return dict(h=repr(h), half=repr(h / 2), edge=repr(0.5 + 2 * h))


def run(case):
    for deck, rate, stiffness, Gc, label in (("bar.xml", 5e-5, E, 2e-5, "bar"), ("shear.xml", 4e-5, E / 2, 3e-5, "sheared layer")):
        for kernel in ("uGIMP", "Classic", "lCPDI"):
            for n in (11, 21, 41):
                for law in ("Linear", "Exponential"):
                    if case.quick and (n, kernel) != (21, "uGIMP") or law == "Exponential" and n != 21:
                        continue
                    extra = dict(wide=repr(2 / n)) if deck == "shear.xml" else {}
                    out = verify.history(case.run(f"{label[:3]}{kernel}{n}{law}", deck, dict(cells(n), kernel=kernel, law=law, **extra)))
                    t, area, what = out["time"], 1 / n, f"{label}, {kernel}, {n} cells, {law.lower()}"
                    exact = force(rate * t, stiffness, Gc, law == "Exponential")
                    case.check(f"{what}: largest error of the traction over the strength", np.abs(out["reactionx:-1"] / area - exact)[t > 0.01].max(), 0, 0.02, "at most")
                    if law == "Linear":
                        case.check(f"{what}: dissipated over fracture energy", out["Plastic Energy"][-1] / (Gc * area), 1, 0.01)
    disc(case)
    for angle in (17, 45):
        for kernel in ("uGIMP", "lCPDI"):
            for h in (0.05, 0.025):
                if not case.quick or (h, kernel) == (0.05, "uGIMP"):
                    turned(case, angle, kernel, h, whole="")
                    turned(case, angle, kernel, h, whole="<WholeParticles/>")


def disc(case):
    """Energies of a disc that cracks between platens, with each order of updates and transfer, over the supplied work."""
    transfers = {"FMPM(2)": "<Transfer type='FMPM' order='2'/>", "APIC": "<Transfer type='APIC'/>", "FLIP": "<Transfer type='FLIP'/>"}
    for transfer in transfers:
        for method, skip in (("USL", "<SkipPostExtrapolation/>"), ("USL", ""), ("USAVG", "")):
            for impulses in ("faces", "nodes"):
                order = method + ("-" if skip else "+")
                if (transfer, order) == ("APIC", "USL-") or case.quick and (transfer, order, impulses) != ("FMPM(2)", "USL+", "faces"):
                    continue  # APIC with USL- loses energy at light nodes: see limits.md
                rows = verify.energy(case.run("disc" + transfer[:4] + method + ("minus" if skip else "plus") + impulses, "disc.xml", dict(method=method, transfer=skip + transfers[transfer], impulses=impulses)))
                supplied = rows["boundary_work"][-1]
                what = f"disc that cracks, {transfer}, {order}, impulses on {impulses}"
                case.check(f"{what}: residual of the energy", np.abs(rows["residual"]).max() / supplied, 0, 0.02, "at most")
                case.check(f"{what}: energy that contact created", max(0, -rows["contact"].min()) / supplied, 0, 0.01 if transfer == "FLIP" else 1e-6, "at most")


def turned(case, angle, kernel, h, whole):
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    v = 5e-5
    parts = dict(bar=polygon(-0.5, 0.5, -W, W, c, s), weak=polygon(-0.75 * h, 0.75 * h, -W, W, c, s), low=polygon(-0.7, -0.42, -0.4, 0.4, c, s), high=polygon(0.42, 0.7, -0.4, 0.4, c, s))
    rates = dict(vx=v * c, vy=v * s, xx=2 * v * c * c, xy=2 * v * c * s, yy=2 * v * s * s)
    label = f"turned{angle}{kernel}{h}" + ("whole" if whole else "")
    out = verify.history(case.run(label, "turned.xml", dict(parts, **rates, h=h, kernel=kernel, whole=whole)))
    what = f"bar at {angle} degrees, {kernel}, {round(1 / h)} cells" + (", whole particles" if whole else "")
    pull = (out["reactionx:-1"] * c + out["reactiony:-1"] * s) / (2 * W)
    case.check(f"{what}: strength", pull.max(), 1, 0.05)
    case.check(f"{what}: dissipated over fracture energy", out["Plastic Energy"][-1] / (2e-5 * 2 * W), 1, 0.1)
