# SPDX-License-Identifier: MIT
import numpy as np

import verify

apic, flip = "<Transfer type='APIC'/>", "<Transfer type='FLIP'/>"
R, rho, spin = 0.5, 1000, 1.0


def impact(case):
    for name, transfer in (("APIC", apic), ("FLIP", flip)) if not case.quick else (("FLIP", flip),):
        got = verify.history(case.run(f"impact_{name}", "impact.xml", dict(transfer=transfer)))
        mass = got["px:disc"][0] / 1.0
        case.check(f"{name}: mass of the disc", mass, rho * np.pi * R**2, 1e-10)
        along, against = got["px:disc"][0] - got["px:disc"][-1], got["py:disc"][-1] - got["py:disc"][0]
        own = got["Lpz:disc"] - (got["posx:disc"] * got["py:disc"] - got["posy:disc"] * got["px:disc"])
        case.check(f"{name}: oblique impact, tangential over normal impulse", along / against, 0.2, 2e-3)
        # The force acts at the flattened face, 0.5 m/s times the square root of mass over stiffness behind the circle; the mean
        # over half a period of a sine, weighted with the sine
        flattened = 0.5 * np.sqrt(mass / (np.pi / 4 * 1e6 / 0.91)) * np.pi / 4
        case.check(f"{name}: oblique impact, spin over tangential impulse", -own[-1] / along, R - flattened, 0.015)


def ball(case):
    """As for the disc; Hertz gives the indentation."""
    for name, transfer in (("APIC", apic), ("FLIP", flip)):
        got = verify.history(case.run(f"ball_{name}", "ball.xml", dict(transfer=transfer)))
        mass = got["px:ball"][0] / 1.0
        case.check(f"{name}: mass of the ball", mass, rho * 4 / 3 * np.pi * R**3, 1e-10)
        along, against = got["px:ball"][0] - got["px:ball"][-1], got["py:ball"][-1] - got["py:ball"][0]
        own = got["Lpz:ball"] - (got["posx:ball"] * got["py:ball"] - got["posy:ball"] * got["px:ball"])
        case.check(f"{name}: oblique impact of the ball, tangential over normal impulse", along / against, 0.2, 0.01)
        indentation = (1.25 * mass * 0.5**2 / (4 / 3 * 1e6 / 0.91 * np.sqrt(R))) ** 0.4
        # Its mean over the impact, weighted with the force (its power 3/2), if it is half a period of a sine
        case.check(f"{name}: oblique impact of the ball, spin over tangential impulse", -own[-1] / along, R - 0.823 * indentation, 0.05)


def wedge(case):
    slope, M, m, g = np.pi / 6, 0.5 * 3 * np.sqrt(3), 0.4, 9.81
    s, c = np.sin(slope), np.cos(slope)
    of_wedge, of_block = -m * g * s * c / (M + m * s * s), (M + m) * g * s / (M + m * s * s)
    ways = (("uGIMP, FLIP", flip, "uGIMP", "nodes"), ("quadratic, APIC", apic, "quadratic", "nodes"),
            ("quadratic, APIC, faces", apic, "quadratic", "faces"))
    for name, transfer, kernel, impulses in ways if not case.quick else ways[:1]:
        entities = dict(transfer=transfer, kernel=kernel, impulses=impulses)
        got = verify.history(case.run("wedge" + name.replace(", ", "_"), "wedge.xml", entities))
        t = got["time"]
        # Weighted with t: the bodies start to vibrate when gravity is switched on
        slope_of = lambda v: (v * t).sum() / (t * t).sum()
        case.check(f"{name}: acceleration of the wedge", slope_of(got["velx:wedge"]), of_wedge, 5e-3)
        case.check(f"{name}: acceleration of the block along x", slope_of(got["velx:block"]), of_wedge + of_block * c, 5e-3)


def journal(case):
    inertia = np.pi / 2 * rho * np.array([R**4, 1 - R**4])
    k_eta = 200
    film = ("<Material Type='TaitLiquid' Name='oil'><rho>1000</rho><K>1e6</K><viscosity>1e-3</viscosity></Material>"
            "<Material Type='LiquidContact' Name='law'><coeff>2e5</coeff><LiquidPhase>3</LiquidPhase><displacementOnly>1</displacementOnly></Material>")

    def decay(label, **entities):
        got = verify.history(case.run(label, "journal.xml", entities))
        case.check(f"{label}: angular momentum of both bodies, relative change", abs(
            (got["Lpz:shaft"] + got["Lpz:ring"])[-1] / got["Lpz:shaft"][0] - 1), 0, 1e-12, "at most")
        relative = got["Lpz:shaft"] / inertia[0] - got["Lpz:ring"] / inertia[1]
        return -np.log(relative[-1] / relative[0]) / got["time"][-1]

    exact = 2 * np.pi * k_eta * R**3 * (1 / inertia).sum()
    for cells, tolerance in ((10, 0.05), (20, 0.02)) if not case.quick else ((10, 0.05),):
        h = str(R / cells)
        case.check(f"shaft without friction, {cells} cells: decay of the spin [1/s]", decay(f"free{cells}", h=h), 0, 0.01, "absolute")
        case.check(f"shaft in a film of liquid, {cells} cells: decay of the spin", decay(f"film{cells}", h=h, law=film), exact, tolerance)


def brake(case):
    turned = dict(from1="0", to1="60", from2="180", to2="240", c="0.866025404", s="0.5")
    ways = ((10, "", {}), (20, "", {}), (10, ", turned by 30 degrees", turned), (16, ", turned by 30 degrees", turned), (20, ", nodes", dict(impulses="nodes")))
    for cells, name, entities in ways if not case.quick else ways[:1]:
        label = f"{cells} cells{name}"
        out = case.run("brake" + label.replace(", ", "_").replace(" ", "_"), "brake.xml", dict(entities, cell=repr(20 / cells)))
        got = verify.history(out)
        lost = got["Lpz:ring"][0] - got["Lpz:ring"][-1]
        # Both pads press with 60 N at 20 mm, which is reached after 0.05 ms
        supplied = 2 * 60 * 20 * (got["time"][-1] - 0.025)
        case.check(f"pads on a spinning ring, {label}: lost spin as a coefficient of friction", lost / supplied, 0, 0.03 / cells, "absolute")


def socket(case):
    got = verify.history(case.run("socket", "socket.xml"))
    case.check("ball in a socket, 6 cells: spin after a fifth of a radian", got["Lpx:ball"][-1] / got["Lpx:ball"][0], 1, 0.01)
    shift = np.hypot(got["posy:ball"][-1], got["posz:ball"][-1])
    case.check("ball in a socket, 6 cells: displacement over the way of its surface", shift / 0.2, 0, 0.03, "absolute")


def run(case):
    brake(case)
    if not case.quick:
        socket(case)
    impact(case)
    if not case.quick:
        ball(case)
    wedge(case)
    journal(case)
