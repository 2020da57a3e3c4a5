# SPDX-License-Identifier: MIT
import numpy as np

deg = np.pi / 180
PEAK, RESIDUAL = 538675.1345948129, 231985.11713310116
A, KA = 1e-4, 5e8  # of the bond: area, k_n A
R, I = np.sqrt(A / np.pi), A**2 / (4 * np.pi)
J = 2 * I


def material(law, properties):
    return f"<Material Type='{law}' Name='j'>" + "".join(f"<{k}>{v}</{k}>" for k, v in properties.items()) + "</Material>"


def tan(degrees):
    return np.tan(degrees * deg)


class Driver:
    """Drives one law; rows of increments with their columns."""

    def __init__(self, case, law, base, attributes):
        self.case, self.law, self.base, self.attributes, self.runs = case, law, base, attributes, 0

    def __call__(self, columns, rows, attributes="", **properties):
        given = self.base | {k.replace("_", "-") if self.law == "Mohr" else k: v for k, v in properties.items()}
        given = {k: v for k, v in given.items() if v is not None}
        path = columns + "\n" + "\n".join(",".join(repr(float(x)) if x != "" else "" for x in row) for row in rows)
        self.runs += 1
        drive = f"<Drive joint='j' {self.attributes} {attributes}><Path>{path}</Path></Drive>"
        return self.case.drive(f"{self.law}{self.runs}", drive, material(self.law, given))


def shear(got):
    return np.hypot(got["Fss"], got["Fst"])


def mohr(case):
    drive = Driver(case, "Mohr", {"stiffness-normal": 2e9, "stiffness-shear": 1e9}, "area='0.5'")
    check = case.check
    weak = dict(cohesion=5e5, friction=30, cohesion_residual=1e5, friction_residual=20, stress_normal=-1e6)

    got = drive("dt,dn,dss,dst", [(1, -1e-5, 0, 0), (1, 0, 3e-5, -4e-5)], cohesion=1e9, tension=1e9)
    check("TM1 elastic: normal force", got["Fn"][-1], -1e4, 1e-9)
    check("TM1 elastic: shear force along s", got["Fss"][-1], -1.5e4, 1e-9)
    check("TM1 elastic: shear force along t", got["Fst"][-1], 2e4, 1e-9)
    check("TM1 elastic: energy", got["E_strain"][-1], 0.675, 1e-9)

    tear = dict(tension=1e6, cohesion=2e6, friction=30, friction_residual=30)
    got = drive("dt,dn,dss", [(1, 0, 1e-4), (1, 4e-4, 0), (1, 2e-4, 0), (1, 1e-5, 0), (1, -7.1e-4, 0)], **tear)
    for k, force, state in ((2, 4e5, 0), (3, 5e5, 2), (4, 0, 8), (5, -1e5, 8)):
        check(f"TM2 tearing, step {k}: normal force", got["Fn"][k], force, 1e-9 * 5e5, "absolute")
        check(f"TM2 tearing, step {k}: state", got["state"][k], state, 0, "absolute")
    check("TM2 tearing: shear force that is left", got["Fss"][3], 0, 0, "absolute")
    check("TM2 tearing: the bond breaks in tension", got["bond_break"][3], 1, 0, "absolute")
    got = drive("dt,dn,dss", [(1, 0, 1e-3), (1, 1e-4, 0), (1, 1.5e-4, 0)], friction=30, friction_residual=30, stress_normal=-4e5)
    check("TM2b a stressed joint opens: normal force while it lasts", got["Fn"][2], -1e5, 1e-9)
    check("TM2b a stressed joint opens: normal force after", got["Fn"][3], 0, 0, "absolute")

    tear = dict(tension=1e6, tension_residual=2.5e5, friction=45, friction_residual=30)
    got = drive("dt,dn,dss", [(1, 6e-4, 0), (1, 1e-6, 2e-3)], cohesion=3e6, cohesion_residual=5e5, **tear)
    check("TM3 residual tension: at the peak", got["Fn"][1], 5e5, 1e-9)
    check("TM3 residual tension: after", got["Fn"][2], 1.25e5, 1e-9)
    check("TM3 residual tension: shear force", shear(got)[2], 177831.21635129678, 1e-9)
    check("TM3 residual tension: state", got["state"][2], 11, 0, "absolute")
    got = drive("dt,dn,dss", [(1, 6e-4, 0), (1, 1e-6, 2e-3)], **tear)
    check("TM3 beyond the apex: shear force", shear(got)[2], 0, 0, "absolute")

    got = sudden = drive("dt,steps,dss", [(1, 109, 1e-5), (1, 1, -1e-5), (1, 250, 1e-5)], **weak)
    check("TM4 sudden weakening: first step that slips", np.argmax(got["slip_change"] > 0), 108, 0, "absolute")
    check("TM4 sudden weakening: peak", shear(got)[108], PEAK, 1e-9)
    check("TM4 sudden weakening: residual", shear(got)[109], RESIDUAL, 1e-9)
    check("TM4 sudden weakening: unloading", shear(got)[110], 226985.11713310116, 1e-9)
    check("TM4 sudden weakening: state", got["state"][110], 4, 0, "absolute")
    check("TM4 sudden weakening: the bond breaks in shear", got["bond_break"][108], 2, 0, "absolute")

    got = slow = drive("dt,steps,dss", [(1, 358, 1e-5)], slip_dc=2e-3, **weak)
    for k, force in ((108, PEAK), (208, 385330.125863957), (308, RESIDUAL), (358, RESIDUAL)):
        check(f"TM5 weakening by length, step {k}: shear force", shear(got)[k], force, 1e-9)
    check("TM5 weakening by length: slip", got["slip"][358], 2.5e-3, 1e-9)
    got = curve = drive("dt,steps,dss", [(1, 358, 1e-5)], slip_table="1 0, 0.4 0.5e-3, 0 2e-3", **weak)
    for s, force in ((0.25, 446668.12935629935), (0.5, 354661.12411778583), (1.25, 293323.1206254435), (2, RESIDUAL)):
        check(f"TM6 weakening by table, slip {s:g} mm: shear force", shear(got)[108 + round(100 * s)], force, 1e-9)

    for heals in (0, 1):
        for length, slides in ((2e-3, 220), (0, 20)):
            got = drive("dt,steps,dss", [(1, 108 + slides, 1e-5), (1, 5, -1e-5), (1, 150, 1e-5)], slip_dc=length, healing=heals, **weak)
            check(f"TM7 healing {heals}, slip-dc {length:g}: strength when it slides again", shear(got)[-150:].max(), PEAK if heals else RESIDUAL, 1e-9)

    held = dict(friction=30, friction_residual=30, stress_normal=-1e6)
    got = dilating = drive("dt,steps,dss", [(1, 600, 1e-5)], dilation=10, dilation_residual=10, dilation_zero=5.005e-3, **held)
    check("TM8 dilation without opening: normal force", got["Fn"][-1], -1281128.5245385, 1e-9)
    check("TM8 dilation without opening: shear force", shear(got)[-1], 739659.898508811, 1e-9)
    got = drive("dt,steps,dss", [(1, 200, 1e-5)], dilation=10, dilation_residual=2, slip_dc=1e-3, **held)
    check("TM8 dilation that fades: normal force at a slip of 0.5 mm", got["Fn"][np.argmax(got["slip"] > 0.499999e-3)], -571897.4682311857, 1e-9)

    got = drive("dt,steps,dss", [(1, 100, 1e-5)], **(held | dict(pore_pressure=4e5)))
    check("TM9 pore pressure: normal force", got["Fn"][-1], -5e5, 1e-9)
    check("TM9 pore pressure: effective normal stress", got["stress_effective"][-1], -6e5, 1e-9)
    check("TM9 pore pressure: shear force", shear(got)[-1], 173205.0807568877, 1e-9)
    got = drive("dt,dss", [(1, 1e-5)], **(held | dict(pore_pressure=4e5, stress_normal=-3e5)))
    check("TM9 pore pressure above the load: normal force", got["Fn"][-1], -2e5, 1e-9)
    check("TM9 pore pressure above the load: state", got["state"][-1], 2, 0, "absolute")

    for mode in range(4):
        damped = dict(dashpot_ratio_normal=0.2, dashpot_ratio_shear=0.1, dashpot_mode=mode)
        got = drive("dt,steps,dn,dss", [(1, 100, 0, 1e-5), (1, 1, 1e-5, 2e-3)], "mass='2'", **damped, **held)
        check(f"TM10 dashpots, mode {mode}: normal", -got["Fdn"][-1], 0.1788854381999832, 1e-9)
        check(f"TM10 dashpots, mode {mode}: shear while sliding", got["Fdss"][-1], 0 if mode & 2 else -12.649110640673518, 1e-9 * 12.6, "absolute")
        got = drive("dt,dn", [(1, -5e-5 - 5e-11), (1, 5e-5)], "mass='2'", cohesion=1e9, cohesion_residual=1e9, tension=1e3, **damped)
        check(f"TM10 dashpots, mode {mode}: normal, opening under F_n = -0.05", -got["Fdn"][-1], 0.05 if mode & 1 else 0.894427190999916, 1e-6)

    got = drive("dt,steps,dss", [(1, 1000, 1e-5)], **held)
    check("TM11 energy: slid", got["E_slip"][-1], -2720.0798102227777, 1e-9)
    steps = 2e-4 * np.random.default_rng(1).standard_normal((2000, 2))
    got = drive("dt,dss,dst", [(1, *s) for s in steps], **held)
    check("TM11 energy, 2000 random steps: out of balance over slid", abs(got["E_released"][-1] / got["E_slip"][-1]), 0, 1e-12, "at most")
    limit = 288675.1345948129
    got = drive("dt,dss,dst", [(1, 1e-2, 0), (1, 0, limit * np.sqrt(3) / 5e8)], **held)
    check("TM12 radial return: along s", got["Fss"][-1] / limit, -0.5, 1e-9)
    check("TM12 radial return: along t", got["Fst"][-1] / limit, -np.sqrt(0.75), 1e-9)
    got = drive("dt,dss", [(1, 0)], state=9, friction=30, friction_residual=30, stress_normal=-1e6)
    check("TM13 state 9 becomes history", got["state"][-1], 12, 0, "absolute")

    got = constant = drive("dt,steps,dss,Fn", [(1, 600, 1e-5, -5e5)], dilation=10, dilation_residual=10, dilation_zero=5.005e-3, **held)
    check("TM14 constant normal load: shear stress", shear(got)[-1] / 0.5, 577350.2691896257, 1e-9)
    check("TM14 constant normal load: uplift", got["un"][-1], 0.0007811285245384998, 1e-9)
    check("TM14 constant normal load: active although it gapes", got["active"][-1] * (got["gap"][-1] > 0), 1, 0, "absolute")
    got = stiff = drive("dt,steps,dss", [(1, 300, 1e-5)], "spring-normal='2.5e8'", dilation=10, dilation_residual=10, **held)
    slope = tan(10) * 2e9 * 5e8 / 2.5e9
    check("TM15 constant normal stiffness: stress per shear displacement", np.diff(-got["Fn"])[-1] / 0.5 / 1e-5, slope, 1e-6)
    check("TM15 constant normal stiffness: normal stress after 3 mm", -got["Fn"][-1] / 0.5, 1e6 + slope * (3e-3 - 577350.2691896257 / 1e9), 2e-3)
    for sigma in (0, 5e5, 2e6):
        got = drive("dt,dss", [(1, 1)], cohesion=3e5, friction=35, friction_residual=35, stress_normal=-sigma)
        check(f"TM16 strength under {sigma / 1e6:g} MPa", shear(got)[-1] / 0.5, 3e5 + sigma * tan(35), 1e-9)
    for name, how in (("at once", {}), ("by length", dict(slip_dc=1e-3)), ("by table", dict(slip_table="1 0, 0 1e-3"))):
        got = drive("dt,dn,dss", [(1, 6e-4, 0), (1, 1e-4, 0), (1, -1.2e-3, 0), (1, 0, 1e-2)], tension=1e6, cohesion=2e6, friction=30, friction_residual=20, **how)
        check(f"TM17 torn, weakening {name}: shear force after closing", shear(got)[-1], 5e5 * tan(20), 1e-9)

    # a block on a joint that slopes by 35 degrees
    m, g, k = 1000, 10, 1e8
    W, N = m * g * np.sin(35 * deg), m * g * np.cos(35 * deg)
    incline = Driver(case, "Mohr", {"stiffness-normal": k, "stiffness-shear": k, "friction": 25, "friction-residual": 25, "stress-normal": -N}, "area='1'")
    got = incline("dt,steps,Pn,Pss", [(1e-5, 100000, -N, W)], f"block='{m}'")
    a = g * (np.sin(35 * deg) - np.cos(35 * deg) * tan(25))
    x1, omega = N * tan(25) / k, np.sqrt(k / m)
    t1 = np.arccos(1 - x1 * k / W) / omega
    v1 = W / np.sqrt(k * m) * np.sin(omega * t1)
    check("TM19 block on a slope: velocity after 1 s", got["vss"][-1], v1 + a * (1 - t1), 5e-4)
    check("TM19 block on a slope: way after 1 s", got["uss"][-1], x1 + v1 * (1 - t1) + a * (1 - t1) ** 2 / 2, 5e-4)

    # stick-slip: drawn by a soft spring, the joint is about to slip
    K, P, F = 1e7, 5e5 * tan(30), 5e5 * tan(20)
    fault = Driver(case, "Mohr", {"stiffness-normal": 2e9, "stiffness-shear": 1e11, "friction": 30, "friction-residual": 20, "stress-normal": -1e6}, "area='0.5'")
    dt = 0.2 * np.sqrt(1000 / 5e10)
    got = event = fault("dt,steps,dss,Pn", [(dt, 4000, 1e-3 * dt, -5e5)], "block='1000' spring-shear='1e7'", healing=1, stress_shear=f"{-0.9999 * P / 0.5!r} 0")
    first = np.argmax(got["slip_change"] > 0)
    last = first + np.argmax(got["slip_change"][first + 1:] > 0) + 1
    check("D2 stick-slip: slip of an event", got["uss"][last] - got["uss"][first], 2 * (P - F) / K, 0.02)
    check("D2 stick-slip: force of the spring after it", got["Sss"][last], 2 * F - P, 0.02)
    threshold = (PEAK - RESIDUAL) / 2e-3
    for share, stable in ((1.25, True), (0.8, False)):
        spring = 1 / (1 / (share * threshold) - 1 / 5e8)
        dt, rate = 0.2 * np.sqrt(1000 / (5e8 + spring)), 0.002
        got = drive("dt,steps,dss,Pn", [(dt, round((PEAK / (share * threshold) + 2.5e-3) / rate / dt), rate * dt, -5e5)], f"block='1000' spring-shear='{spring!r}'", slip_dc=2e-3, **weak)
        speed = got["vss"].max() / rate
        case.check(f"spring and joint {share:g} times as stiff as the joint weakens: largest speed over that of the machine{', stable' if stable else ' (inverse), unstable'}",
                   speed if stable else 1 / speed, 0, 10 if stable else 1 / 30, "at most")
    return dict(sudden=sudden, slow=slow, curve=curve, dilating=dilating, constant=constant, stiff=stiff, event=event)


def bonds(case):
    check = case.check
    base = dict(kn=5e12, ks=5e12, krot=f"{8333.333333333334} {4166.666666666667} {4166.666666666667}", bond="")
    drive = Driver(case, "SpringNetwork", base, f"area='{A}'")
    strong, brittle = dict(sn_ten=1e12, sn_coh=1e12), dict(sn_ten=5e6, sn_coh=50e6)
    rock, soft = dict(sn_ten=5e6, sn_coh=10e6, sn_fa=30), brittle | dict(sn_tendc=4e-6)

    got = drive("dt,dn,dss,dst,dtwist,dbs,dbt", [(1, 1e-6, 2e-7, -1e-7, 1e-5, 1e-5, -2e-5)], **strong)
    for name, value in dict(Fn=500, Fss=-100, Fst=50, Mt=-0.08333333333333333, Mbs=-0.041666666666666664, Mbt=0.08333333333333333,
                            sn_sigma=5660554.549601002, sn_tau=1413442.963900814, E_strain=0.00026395833333333333).items():
        check(f"TS2 elastic: {name}", got[name][-1], value, 1e-9)
    got = Driver(case, "SpringNetwork", {"compute-stiffness": "emod 50e9", "bond": ""}, f"area='{A}' distance='0.01'")("dt,dn", [(1, 1e-6)], **strong)
    check("TS1 stiffness of an elastic body: normal force", got["Fn"][-1], 500, 1e-9)

    got = drive("dt,dn", [(1, 0.999e-6), (1, 0.002e-6)], **brittle)
    check("TS3 tears: state before", got["state"][1], 3, 0, "absolute")
    check("TS3 tears: state after", got["state"][2], 1, 0, "absolute")
    check("TS3 tears: normal force after", got["Fn"][2], 0, 0, "absolute")
    theta = 5e6 * I / (R * 4166.666666666667)
    for share, state in ((0.999, 3), (1.001, 1)):
        got = drive("dt,dbs", [(1, share * theta)], **brittle)
        check(f"TS3 tears by bending, {share:g} of the angle: state", got["state"][-1], state, 0, "absolute")
    got = drive("dt,dbs", [(1, 100 * theta)], sn_mcf=0, **brittle)
    check("TS3 bending that does not count: state", got["state"][-1], 3, 0, "absolute")

    press = (1, 1, -2e-6, 0)
    got = sheared = drive("dt,steps,dn,dss", [press, (1, 4000, 0, 1e-9)], **rock)
    check("TS4 shears: strength", got["sn_shear"][1], 15773502.691896256, 1e-9)
    check("TS4 shears: largest force", shear(got).max(), 1577.3502691896256, 1e-3)
    check("TS4 shears: force after", shear(got)[-1], 577.3502691896257, 1e-9)
    check("TS4 shears: state", got["state"][-1], 2, 0, "absolute")
    got = drive("dt,steps,dn,dss", [press, (1, 4000, 0, 1e-9)], sn_cohres=2e6, fric=0.4, **rock)
    check("TS4 shears, cohesion that is left: force after", shear(got)[-1], 600, 1e-9)
    got = drive("dt,dn", [(1, 0.6e-6)], **rock)
    check("TS4 strength under 3 MPa of tension", got["sn_shear"][-1], 8267949.192431123, 1e-9)
    twist = 10e6 * J / R / 8333.333333333334
    for share, state in ((0.999, 3), (1.001, 2)):
        got = drive("dt,dtwist", [(1, share * twist)], **rock)
        check(f"TS4 shears by twist, {share:g} of the angle: state", got["state"][-1], state, 0, "absolute")

    got = softening = drive("dt,steps,dn", [(1, 520, 1e-8)], **soft)
    u = got["un"]
    check("TS5 softening: largest difference from its line", np.abs(got["Fn"] - np.where(u < 1e-6, KA * u, np.maximum(500 * (1 - (u - 1e-6) / 4e-6), 0)))[:500].max() / 500, 0, 1e-9, "at most")
    check("TS5 softening: work", np.sum((got["Fn"][1:] + got["Fn"][:-1]) / 2 * np.diff(u)), 1.25e-3, 1e-4)
    got = drive("dt,dn", [(1, 3e-6)], **soft)
    check("TS5 softening in one step: force", got["Fn"][-1], 250, 1e-9)
    check("TS5 softening in one step: elongation", got["elongation"][-1], 2e-6, 1e-9)
    got = drive("dt,dn", [(1, 1.5e-6), (1, 0.5e-6), (1, 1.5e-6), (1, 2e-6)], sn_tentab="1 0, 0.3 1e-6, 0 4e-6", **brittle)
    for k, force in ((1, 325), (2, 150), (3, 75), (4, 0)):
        check(f"TS6 softening by table, step {k}: force", got["Fn"][k], force, 1e-9 * 500, "absolute")
    got = reloaded = drive("dt,dn", [(1, 3e-6), (1, -0.4e-6), (1, -0.3e-6), (1, 0.69e-6), (1, 1.01e-6)], **soft)
    for k, force, state in ((2, 50, 5), (3, -100, 5), (4, 245, 5), (5, 125, 4)):
        check(f"TS7 unloading and reloading, step {k}: force", got["Fn"][k], force, 1e-9 * 500, "absolute")
        check(f"TS7 unloading and reloading, step {k}: state", got["state"][k], state, 0, "absolute")
    got = drive("dt,dbs", [(1, 3 * theta)], **soft)
    check("TS7 softening in bending: moment", np.hypot(got["Mbs"], got["Mbt"])[-1], 0.3526184897173476, 1e-9)

    for name, how in (("length", dict(sn_cohdc=1e-5)), ("table", dict(sn_cohtab="1 0, 0.2 4e-6, 0 1e-5"))):
        got = drive("dt,steps,dn,dss", [press, (1, 3155, 0, 1e-9), (1, 60, 0, 2.5e-7)], **how, **rock)
        weakened = got
        broken = np.argmax(got["state"] == 2)
        check(f"TS8 cohesion that falls by {name}: at the break", shear(got)[broken], 1577.3502691896256, 1e-9)
        s = got["slip"][broken:]
        m = np.maximum(1 - s / 1e-5, 0) if name == "length" else np.interp(s, [0, 4e-6, 1e-5], [1, 0.2, 0])
        check(f"TS8 cohesion that falls by {name}: largest difference from its line", np.abs(shear(got)[broken:] - 577.3502691896257 - 1000 * m).max() / 1000, 0, 1e-9, "at most")
    healing = [press, (1, 3160, 0, 1e-9), (1, 1, 0, 1e-7), (1, 1, 0, -1e-9)]
    more = (0.999 * 1577.3502691896256 - (577.3502691896257 - 0.5)) / KA
    got = drive("dt,steps,dn,dss", [*healing, (1, 1, 0, more), (1, 1, 0, 1e-8)], sn_heal=1, **rock)
    for k, state in ((-3, 6), (-2, 6), (-1, 2)):
        check(f"TS9 healing, {-k} steps before the end: state", got["state"][k], state, 0, "absolute")
    check("TS9 healing: force that it carries", shear(got)[-2], 1575.772918920436, 1e-9)
    got = drive("dt,steps,dn,dss", [*healing, (1, 1, 2.1e-6, 0)], sn_heal=1, **rock)
    check("TS9 healed, drawn apart: state", got["state"][-1], 1, 0, "absolute")

    loose = Driver(case, "SpringNetwork", {k: v for k, v in base.items() if k != "bond"}, f"area='{A}'")
    got = loose("dt,dn,dtwist,dbs", [(1, -2e-6, 0, 0), (1, 0, 1, 1)], fric=0.5)
    check("TS10 without bond: largest bending moment", abs(got["Mbs"][-1]), 2.9619953136257204, 1e-9)
    check("TS10 without bond: largest twist", abs(got["Mt"][-1]), 1.833616146530208, 1e-9)
    check("TS10 without bond: event", got["slip_change"][-1], 6, 0, "absolute")
    got = loose("dt,dn", [(1, -2e-6), (1, 1e-6), (1, 2e-6)])
    for k, force in ((1, -1000), (2, -500), (3, 0)):
        check(f"TS11 without bond, from the gap, step {k}", got["Fn"][k], force, 1e-9 * 1000, "absolute")
    got = loose("dt,dn", [(1, -2e-6), (1, 5e-6)], sn_mode=1)
    for k, force in ((1, -1000), (2, 0)):
        check(f"TS11 without bond, by increments, step {k}", got["Fn"][k], force, 1e-9 * 1000, "absolute")
    for mode in (0, 1):
        got = loose("dt,steps,dn,dss", [press, (1, 300, 0, 1e-7)], fric=0.5, sn_dil=15, sn_dilzero=20.5e-6, sn_mode=mode)
        check(f"TS12 dilation, mode {mode}: normal force", got["Fn"][-1], -3599.10716658189, 1e-3)
    got = drive("dt,dn", [(1, 0.599e-6), (1, 0.002e-6)], sn_porp=2e6, **rock)
    for k, state in ((1, 3), (2, 1)):
        check(f"TS13 pore pressure, step {k}: state", got["state"][k], state, 0, "absolute")
    got = drive("dt,dn", [(1, -2e-6)], sn_porp=4e6, **rock)
    check("TS13 pore pressure: shear strength", got["sn_shear"][-1], 13464101.615137754, 1e-9)
    random = np.random.default_rng(5).standard_normal((500, 5)) * [1e-6, 1e-6, 1e-4, 4e-4, 4e-4]
    got = loose("dt,dn,dss,dst,dtwist,dbs,dbt", [(1, -2e-6, 0, 0, 0, 0, 0)] + [(1, 0, *r) for r in random], fric=0.5, sn_mode=1)
    check("TS14 energy, 500 random steps: out of balance over slid", abs((got["E_released"][-1] - got["E_released"][1]) / got["E_slip"][-1]), 0, 1e-10, "at most")
    got = drive("dt,steps,Ffn,Ffss", [(1, 10, -20, 5)], **strong)
    check("TS16 fictitious force: normal", got["Fn"][-1], -20, 1e-9)
    check("TS16 fictitious force: shear", got["Fss"][-1], 5, 1e-9)
    got = drive("dt,steps,dn,dss,Ffn", [(1, 1, -1.5e-6, 0, -250), (1, 4000, 0, 1e-9, -250)], **rock)
    check("TS17 break under fictitious force: normal force", got["Fn"][-1], -1000, 1e-9)
    check("TS17 break under fictitious force: overlap", got["gap"][-1] - got["rest_gap"][-1], -2e-6, 1e-9)
    got = loose("dt,dn,dss", [(1, -2e-6, 0), (1, 0, 2e-6), (1, 0, -1e-7)], fric=0.5)
    for k, slips in ((2, 1), (3, 0)):
        check(f"TS18 events, step {k}: code", got["slip_change"][k], 1, 0, "absolute")
        check(f"TS18 events, step {k}: slips", got["sn_slip"][k], slips, 0, "absolute")
    edge = Driver(case, "SpringNetwork", {"compute-stiffness": "emod 50e9", "bond": ""}, "area='0.02' thickness='1' distance='0.02'")
    got = edge("dt,dn,dst,dbs", [(1, 1e-7, 2e-7, 1e-5)], **strong)
    for name, value in dict(Fn=5000, Fst=-1e4, Mbs=-16.666666666666668, sn_sigma=5e5).items():
        check(f"TS19 in two dimensions: {name}", got[name][-1], value, 1e-9)

    for mode in (0, 1):
        for beta in (0.1, 0.2, 0.4):
            ball = Driver(case, "SpringNetwork", dict(kn=1e6, dp_nratio=beta, dp_mode=mode), "area='1' block='1' vn='-1'")
            got = ball("dt,steps", [(1e-6, 4500)])
            root = np.sqrt(1 - beta**2)
            e = np.exp(-beta / root * (np.pi if mode == 0 else np.pi - np.arctan2(2 * beta * root, 1 - 2 * beta**2)))
            check(f"D1 ball on a dashpot, mode {mode}, beta {beta}: velocity it leaves with", got["vn"][-1], e, 3e-3)
    return dict(softening=softening, sheared=sheared, reloaded=reloaded, weakened=weakened)


def run(case):
    rock = mohr(case)
    bond = bonds(case)

    def lines(data, x, y, xlabel, ylabel, title, curves):
        def draw(axes):
            for label, key, style in curves:
                axes.plot(x(data[key]), y(data[key]), style, label=label)
            axes.set(xlabel=xlabel, ylabel=ylabel, title=title)
            if curves[0][0]:
                axes.legend()

        return draw

    case.figure("joint_shear", lines(rock, lambda c: 1e3 * c["uss"], lambda c: -c["Fss"] / 0.5e6, "shear displacement [mm]", "shear stress [MPa]",
                                     "Mohr: shear under 1 MPa", (("at once", "sudden", "-"), ("slip-dc", "slow", "-"), ("slip-table", "curve", "-"))))
    case.figure("joint_dilation", lines(rock, lambda c: 1e3 * c["uss"], lambda c: -c["Fn"] / 0.5e6, "shear displacement [mm]", "pressure [MPa]",
                                        "Mohr: dilation of 10 degrees", (("walls fixed", "dilating", "-"), ("walls on springs", "stiff", "-"), ("constant load", "constant", "-"))))
    case.figure("joint_stick_slip", lines(rock, lambda c: 1e3 * c["time"], lambda c: 1e-3 * c["Sss"], "time [ms]", "force of the spring [kN]",
                                          "Mohr: an event of stick-slip", (("", "event", "-"),)))
    case.figure("joint_softening", lines(bond, lambda c: 1e6 * c["un"], lambda c: c["Fn"] / A / 1e6, "opening [µm]", "normal stress [MPa]",
                                         "SpringNetwork: a bond that softens", (("drawn", "softening", "-"), ("and pushed back", "reloaded", ".--"))))
    case.figure("joint_bond_shear", lines(bond, lambda c: 1e6 * c["uss"], lambda c: shear(c) / A / 1e6, "shear displacement [µm]", "shear stress [MPa]",
                                          "SpringNetwork: shear under 10 MPa", (("brittle", "sheared", "-"), ("sn_cohdc, sn_cohtab", "weakened", "-"))))
