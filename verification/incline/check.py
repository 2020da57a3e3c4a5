# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

g = 9.81
c30 = math.cos(math.radians(30))


defects = []  # of the momentum, of all runs


def friction(text, kind="CoulombFriction"):
    return dict(law=f"<Material Type='{kind}' Name='law'>{text}</Material>")


def slide(case, name, angle=30.0, turned=0.0, **entities):
    """Time, velocity, displacement and mean force (per weight) along and against the plane."""
    c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
    entities |= dict(c=repr(c), s=repr(s), pull=repr(g * math.sin(math.radians(angle))), press=repr(g * math.cos(math.radians(angle))))
    if turned:
        entities["grid"] = "<Grid xmin='-1.5' xmax='3.5' ymin='-1.5' ymax='3.5'><Horiz cellsize='0.05'/><Vert cellsize='0.05'/></Grid>"
    out = case.run(name, entities=entities)
    # With XPIC, and with FMPM unless stress comes last, filters act between the impulses that are booked (see the limits).
    transfer = entities.get("transfer", "")
    if "XPIC" not in transfer and not ("FMPM" in transfer and entities.get("method", "USL") != "USL"):
        defects.append(verify.momentum_defect(out) / (200 * g * verify.history(out)["time"][-1]))
    got = verify.history(out)
    along = lambda q: c * got[f"{q}x:block"] + s * got[f"{q}y:block"]
    against = lambda q: -s * got[f"{q}x:block"] + c * got[f"{q}y:block"]
    return got["time"], along("vel"), along("disp"), against("contact") / (200 * g), got


def acceleration(t, v, start):
    """Slope of the mean velocity over the steady part."""
    steady = t > start
    return np.polyfit(t[steady], v[steady], 1)[0]


def coulomb(mu, angle=30.0):
    return g * (math.sin(math.radians(angle)) - mu * math.cos(math.radians(angle)))


def rigid(resistance):
    """Speed of a rigid block while gravity turns along the plane; resistance(v): force over mass."""
    times = np.arange(0.3, 1.5, 1e-3)
    speeds = np.zeros_like(times)
    for k in range(1, len(times)):
        turn = min((times[k] - 0.3) / 0.2, 1)
        pull = 0.5 * g * turn**2 * (3 - 2 * turn)
        speeds[k] = max(0.0, speeds[k - 1] + 1e-3 * (pull - resistance(speeds[k - 1])))
    return times, speeds


def rigid_with_static(static, dynamic, way, end):
    """Speed at the end of a rigid block whose friction falls from the static to the dynamic coefficient along a way."""
    dt, v, slip = 1e-5, 0.0, 0.0
    for t in np.arange(0.3, end, dt):
        turn = min((t - 0.3) / 0.2, 1)
        pull = 0.5 * g * turn**2 * (3 - 2 * turn)
        share = min(slip / way, 1.0) if way > 0 else float(slip > 0)
        v = max(0.0, v + dt * (pull - g * c30 * (static + (dynamic - static) * share)))
        slip += dt * v
    return v


default = dict(method="USAVG", skip="", kernel="uGIMP", transfer="<Transfer type='FLIP'/>")  # of the dialect


def hold_and_slide(case):
    """Static friction with the default scheme of the dialect, undamped: it holds, and then falls to the dynamic one."""
    ramp = "(min(t/0.1,1))^2*(3-2*min(t/0.1,1))"
    both = friction("<coeff>0.3</coeff><coeffStatic>0.7</coeffStatic>")
    for turned in (0, 17) if not case.quick else (0,):
        c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
        pull, press = (f"({g * f(math.radians(30))!r}*{ramp})" for f in (math.sin, math.cos))
        grid = dict(grid="<Grid xmin='-1.5' xmax='3.5' ymin='-1.5' ymax='3.5'><Horiz cellsize='0.05'/><Vert cellsize='0.05'/></Grid>") if turned else {}
        out = case.run(f"hold_default_{turned}", entities=dict(c=repr(c), s=repr(s), along=pull, press=press, damping="0", E="1e8", end="0.6" if case.quick else "1.2", **grid, **default, **both))
        got = verify.history(out)
        x = c * got["dispx:block"] + s * got["dispy:block"]
        label = f"default scheme, undamped, static 0.7 at 30 degrees, turned by {turned}"
        case.check(f"{label}: displacement over length of the block", abs(x[-1]), 0, 2e-6, "at most")
        case.check(f"{label}: creep since 0.3 s over the cell (holds)", abs(x[-1] - np.interp(0.3, got["time"], x)) / 0.05, 0, 1e-6, "at most")
    if case.quick:
        return
    for h in (0.05, 0.025):
        grid = f"<Grid xmin='-1' xmax='3.5' ymin='-0.4' ymax='0.5'><Horiz cellsize='{h}'/><Vert cellsize='{h}'/></Grid>"
        for name in ("FLIP", "APIC", "FMPM"):
            for way in (0.01 * h, 0.0):
                text = "<coeff>0.3</coeff><coeffStatic>0.5</coeffStatic>" + ("" if way > 0 else "<weakening>0</weakening>")
                scheme = default | dict(transfer=f"<Transfer type='{name}'/>", E="4e7")  # so stiff that it moves as a rigid block
                t, v, x, _, _ = slide(case, f"static_{name}_{h}_{way > 0}", grid=grid, damping="20", **scheme, **friction(text))
                label = f"default scheme, {name}, cells of {h} m, static 0.5, dynamic 0.3" + ("" if way > 0 else ", sudden drop")
                if way > 0:  # a sudden drop begins at the corners, before a rigid block would slide
                    case.check(f"{label}: velocity after 1 s", v[-1], rigid_with_static(0.5, 0.3, way, 1), 0.01)
                case.check(f"{label}: acceleration", acceleration(t, v, 0.7), coulomb(0.3), 2e-3)


def run(case):
    rows = []
    hold_and_slide(case)
    for turned in (0, 17, 45) if not case.quick else (17,):
        for mu, tolerance in ((0.0, 1e-5), (0.3, 5e-4)) if not case.quick else ((0.3, 5e-4),):
            t, v, x, normal, _ = slide(case, f"mu{mu}_{turned}", turned=turned, end="0.8" if case.quick else "1", **friction(f"<coeff>{mu}</coeff>"))
            case.check(f"mu = {mu}, plane turned by {turned} degrees: acceleration", acceleration(t, v, 0.6), coulomb(mu), tolerance)
            case.check(f"mu = {mu}, turned by {turned}: normal force over weight", normal[t > 0.6].mean(), math.cos(math.radians(30)), 2e-3)
            rows.append((turned, mu, t, v))
        t, v, x, _, _ = slide(case, f"mu06_{turned}", turned=turned, **friction("<coeff>0.6</coeff>"))
        case.check(f"mu = 0.6, turned by {turned}: speed after 1 s (holds)", abs(v[-1]), 0, 1e-6, "at most")
    if case.quick:
        case.check("momentum gained less impulses, over weight times duration", max(defects), 0, 1e-10, "absolute")
        return
    speeds = []
    for k, (dx, dy) in enumerate(np.random.default_rng(3).uniform(0, 0.05, (10, 2))):
        grid = f"<Grid xmin='{dx - 1.05}' xmax='{dx + 3.5}' ymin='{dy - 0.45}' ymax='{dy + 0.5}'><Horiz cellsize='0.05'/><Vert cellsize='0.05'/></Grid>"
        t, v, x, _, _ = slide(case, f"shift{k}", grid=grid, **friction("<coeff>0.3</coeff>"))
        speeds.append(v[-1])
    case.check("mu = 0.3, 10 shifts of the grid: spread of the velocity", np.ptp(speeds) / np.mean(speeds), 0, 0.01, "at most")
    # Without the damping, which acts on velocities and would know the frame
    t, v0, x, _, _ = slide(case, "still", damping="0", **friction("<coeff>0.3</coeff>"))
    t, v, x, _, _ = slide(case, "frame", damping="0", frame="0.3", **friction("<coeff>0.3</coeff>"))
    case.check("mu = 0.3, everything moves along at 0.3 m/s: velocity gained", v[-1] - 0.3, v0[-1], 0.01)
    t, v, x, _, _ = slide(case, "mu055", end="2", transfer="<Transfer type='FMPM' order='2'/>", **friction("<coeff>0.55</coeff>"))
    case.check("mu = 0.55: acceleration", acceleration(t, v, 0.8), coulomb(0.55), 0.01)
    for E, end in (("1e5", 1), ("1e9", 0.8)):
        t, v, x, _, _ = slide(case, f"E{E}", E=E, end=str(end), **friction("<coeff>0.3</coeff>"))
        case.check(f"mu = 0.3, E = {E}: acceleration", acceleration(t, v, 0.6), coulomb(0.3), 5e-4)
    t, v, x, _, _ = slide(case, "hold", angle=15.0, **friction("<coeff>0.3</coeff>"))
    case.check("mu = 0.3 at 15 degrees: creep in 0.4 s over the cell", abs(x[-1] - np.interp(0.6, t, x)) / 0.05, 0, 1e-5, "at most")
    both = "<coeff>0.3</coeff><coeffStatic>0.5</coeffStatic>"
    t, v, x, _, _ = slide(case, "static", **friction(both))
    case.check("static 0.5, dynamic 0.3: acceleration once it slides", acceleration(t, v, 0.7), coulomb(0.3), 5e-3)
    t, v, x, _, _ = slide(case, "static_hold", angle=25.0, **friction(both))
    case.check("static 0.5, dynamic 0.3 at 25 degrees: speed after 1 s (holds)", abs(v[-1]), 0, 1e-6, "at most")
    t, v, x, _, _ = slide(case, "static_hold07", **friction("<coeff>0.3</coeff><coeffStatic>0.7</coeffStatic>"))
    case.check("static 0.7, dynamic 0.3 at 30 degrees: creep in 0.4 s over the cell (holds)", abs(x[-1] - np.interp(0.6, t, x)) / 0.05, 0, 1e-5, "at most")
    t, v, x, _, _ = slide(case, "stop", angle=0.0, end="1.2", start="-1", speed="2", **friction("<coeff>0.25</coeff>"))
    stop = t[np.argmax(v < 1e-3)]
    case.check("v0 = 2, mu = 0.25: way until it stops", x[-1], 4 / (2 * 0.25 * g), 5e-3)
    case.check("v0 = 2, mu = 0.25: it stays", abs(v[-1]), 0, 1e-4, "at most")
    t, v, x, _, got = slide(case, "work", angle=0.0, end="1.2", start="-1", speed="2", **friction("<coeff>0.25</coeff>"))
    case.check("v0 = 2, mu = 0.25: frictional work over kinetic energy", got["Friction Work"][-1] / 400, 1, 5e-3)
    t, v, x, _, _ = slide(case, "cohesion", **friction("<coeff>0.3</coeff><Sa>100</Sa>", "AdhesiveFriction"))
    case.check("mu = 0.3, Sa = 100: acceleration", acceleration(t, v, 0.6), coulomb(0.3) - 100 / 200, 5e-3)
    laws = [("AdhesiveFriction, mu = 0.3, Sa = 100 Pa", t, v, lambda v: 0.3 * g * c30 + 100 / 200)]
    t, v, x, _, _ = slide(case, "ramp", angle=0.0, end="3.7525", along="(2*max(t-&start;,0))", E="1e8",
                          grid="<Grid xmin='-1' xmax='3.5' ymin='-0.4' ymax='0.5'><Horiz cellsize='0.05'/><Vert cellsize='0.05'/></Grid>",
                          **friction("<coeff>0.3</coeff><coeffStatic>0.5</coeffStatic><weakening>0.00005</weakening>"))
    slip = np.interp(1e-3, v, t)
    case.check("static 0.5, dynamic 0.3, pull grows by 2 m/s^3: it slides at", slip - 0.3, 0.5 * g / 2, 0.01)
    case.check("the same: velocity 1 s later", np.interp(slip + 1, t, v), (0.5 - 0.3) * g + 1, 0.01)
    t, v, x, _, _ = slide(case, "speed", end="2", transfer="<Transfer type='FMPM' order='2'/>", **friction("<coeff>0.3</coeff><kmu>0.5</kmu>", "AdhesiveFriction"))
    terminal = coulomb(0.3) / (0.5 * g * math.cos(math.radians(30)))
    case.check("mu = 0.3 + 0.5 v: terminal speed", v[-1] / (1 - math.exp(-(2 - 0.4) * 0.5 * g * math.cos(math.radians(30)))), terminal, 0.01)

    laws.append(("AdhesiveFriction, mu = 0.3 + 0.5 s/m v", t, v, lambda v: (0.3 + 0.5 * v) * g * c30))

    # On faces, which the program chooses for splines, with a transfer that damps the vibrations of a sliding block
    damped = dict(impulses="faces", transfer="<Transfer type='FMPM' order='2'/>")
    t, v, x, _, _ = slide(case, "faces", **damped, **friction("<coeff>0.3</coeff>"))
    case.check("impulses on faces, FMPM(2), mu = 0.3: acceleration", acceleration(t, v, 0.6), coulomb(0.3), 5e-4)
    t, v, x, _, _ = slide(case, "faces_cohesion", **damped, **friction("<coeff>0.3</coeff><Sa>100</Sa>", "AdhesiveFriction"))
    case.check("impulses on faces, FMPM(2), mu = 0.3, Sa = 100: acceleration", acceleration(t, v, 0.6), coulomb(0.3) - 100 / 200, 5e-3)

    oil = "<Material Type='TaitLiquid' Name='oil'><rho>1000</rho><K>1e6</K><viscosity>0.981</viscosity></Material>"
    for order in (0, 1):
        wet = f"<Material Type='LiquidContact' Name='law'><coeff>2000</coeff><LiquidPhase>{4 if order == 0 else 3}</LiquidPhase></Material>"
        t, v, x, _, _ = slide(case, f"liquid{order}", end="1.5", transfer="<Transfer type='FMPM' order='2'/>", law=wet + oil if order == 0 else oil + wet)
        case.check(f"LiquidContact, k eta = 1962 ({'law' if order == 0 else 'liquid'} defined first): terminal speed", v[-1], g * 0.5 * 200 / 1962, 0.01)
    laws.append(("LiquidContact, k eta = 1962 Pa s/m", t, v, lambda v: 1962 / 200 * v))

    schemes = [(f"{method}{'-' if skip else '+'} {name}", dict(method=method, skip=skip, transfer=transfer))
               for method, skip in (("USF", "<SkipPostExtrapolation/>"), ("USL", "<SkipPostExtrapolation/>"), ("USL", ""), ("USAVG", "<SkipPostExtrapolation/>"), ("USAVG", ""))
               for name, transfer in (("FLIP", "<Transfer type='FLIP'/>"), ("APIC", "<Transfer type='APIC'/>"), ("FMPM(2)", "<Transfer type='FMPM' order='2'/>"), ("XPIC(2)", "<Transfer type='XPIC' order='2'/>"))]
    for name, entities in schemes:
        t, v, x, _, _ = slide(case, name.replace(" ", "_").replace("(", "").replace(")", ""), turned=17, **friction("<coeff>0.3</coeff>"), **entities)
        case.check(f"{name}, mu = 0.3, turned by 17: acceleration", acceleration(t, v, 0.6), coulomb(0.3), 2e-3)

    case.check(f"momentum gained less impulses, over weight times duration, all {len(defects)} runs", max(defects), 0, 1e-10, "absolute")

    def draw(axes):
        for turned, mu, t, v in rows:
            axes.plot(t, v, label=f"mu = {mu:g}, plane at {turned} degrees to the grid", linewidth=1)
        for mu in (0.0, 0.3):
            axes.plot([0.5, 1], [np.interp(0.5, t, v) + 0 * mu for t, v in [(rows[0][2], rows[int(mu > 0)][3])]] + [np.interp(0.5, rows[0][2], rows[int(mu > 0)][3]) + 0.5 * coulomb(mu)], "k--", linewidth=0.8)
        axes.set_xlabel("time [s]")
        axes.set_ylabel("velocity along the plane [m/s]")
        axes.legend(fontsize=8)

    case.figure("incline", draw)

    def draw_laws(axes):
        for mu in (0.0, 0.3):
            t, v = next((t, v) for turned, m, t, v in rows if turned == 17 and m == mu)
            laws.append((f"CoulombFriction, mu = {mu:g}", t, v, lambda v, mu=mu: mu * g * c30))
        for k, (label, t, v, resistance) in enumerate(laws):
            axes.plot(t[t < 1.2], v[t < 1.2], color=f"C{k}", label=label, linewidth=1)
            times, exact = rigid(resistance)
            dots = times < min(t[-1], 1.2)
            axes.plot(times[dots][::80], exact[dots][::80], "o", color=f"C{k}", markersize=3)
        axes.set_xlabel("time [s]")
        axes.set_ylabel("velocity along the plane [m/s]")
        axes.legend(fontsize=8, title="lines: Tribo; dots: rigid block", title_fontsize=8)

    case.figure("incline_laws", draw_laws)
