# SPDX-License-Identifier: MIT
import numpy as np

from verify import history, last_particles

H, L, eta, k, rho = 1e-3, 4e-3, 1e-3, 1e3, 1000.0


def profile(out):
    """Heights and velocities of the film's particles near its middle."""
    d = last_particles(out)
    x, v = d["points"], d["velocity"]
    take = (d["material"] == 3) & (abs(x[:, 0] - L / 2) < 3e-4)
    return x[take, 1], v[take, 0]


def line(y, u):
    """Rate and value at the bottom of the straight line through the inner half."""
    inner = abs(y - H / 2) < H / 4
    return np.polyfit(y[inner], u[inner], 1)


def run(case):
    U = 1e-5
    rate = U / (H + 2 / k)
    for label, entities in (("quadratic splines", {}), ("uGIMP", dict(kernel="uGIMP")), ("plates of one cell", dict(plate="1e-4"))):
        y, u = profile(case.run("couette-" + label.replace(" ", "_"), entities=entities))
        slope, wall = line(y, u)
        case.check(f"Couette, {label}: rate", slope, rate, 0.01)
        case.check(f"Couette, {label}: slip", wall + U / 2, rate / k, 0.01)
        if case.quick:
            break
    rows = []
    for transfer, order in (("FMPM", " order='4'"), ("FMPM", " order='2'"), ("FLIP", "")):
        if case.quick:
            break
        y, u = profile(case.run(f"couette-{transfer}{len(rows)}", entities=dict(transfer=f"<Transfer type='{transfer}'{order}/>")))
        slope, wall = line(y, u)
        rows.append([transfer + order, f"{slope / rate:.4f}", f"{(wall + U / 2) / (rate / k):.4f}"])
    if rows:
        case.table("Couette with other transfers, found over exact", ["transfer", "rate", "slip"], rows)

    G = 0.01
    entities = dict(U="0", start=f"{G / 2 / eta}*y*(1e-3-y)+{G * H / 2 / eta / k}", shear=f"{G}*(0.5e-3-y)", pull=f"{G / rho}")
    y, u = profile(case.run("poiseuille", entities=entities))
    fit = np.polyfit(y, u, 2)
    middle = np.polyval(fit, H / 2)
    mean = np.polyval(np.polyint(fit), H) / H
    case.check("Poiseuille: mean speed", mean, G * H**2 / 12 / eta + G * H / 2 / eta / k, 0.01)
    case.check("Poiseuille: largest speed", middle, G * H**2 / 8 / eta + G * H / 2 / eta / k, 0.01)

    # The mode of a film that sticks to the bottom and slips on the top; nodes that stick would take half a cell of it
    mode, nu, v0 = 2.02875784, eta / rho, 5e-6
    sticks = dict(more="<Friction lawname='stick' matname='bottom'/>")
    stick = "<Material Type='CoulombFriction' Name='stick'><coeff>-1</coeff><displacementOnly>1</displacementOnly></Material>"
    slips = "<Material Type='LiquidContact' Name='law'><coeff>1000</coeff><LiquidPhase>3</LiquidPhase><displacementOnly>1</displacementOnly></Material>"
    faces = "<MultiMaterialMode Impulses='faces'><Friction lawname='law'/></MultiMaterialMode>"
    entities = dict(sticks, U="0", end="0.4", cell="0.5e-4", first="0.125e-4", last="39.875e-4", contact=faces, law=stick + slips, start=f"{v0}*sin({mode / H}*y)",
                    shear=f"{eta * v0 * mode / H}*cos({mode / H}*y)*exp(-{nu * (mode / H) ** 2}*t)")
    h = history(case.run("transient", entities=entities))
    t, kinetic = h["time"], h["Kinetic Energy"]
    late = t > 0.1
    case.check("transient: rate of decay", -np.polyfit(t[late], np.log(kinetic[late]), 1)[0] / 2, nu * (mode / H) ** 2, 0.01)

    start = dict(start="1e-2*(y-0.5e-3)", shear="1e-5", end="0.3")
    _, u = profile(case.run("stuck", entities=dict(start, law=stick.replace("'stick'", "'law'"))))
    _, w = profile(case.run("k_large", entities=dict(start, law=slips.replace("1000", "1e15"))))
    case.check("k = 1e15 against sticking: velocities over U", np.abs(u - w).max() / U, 0, 1e-8, "absolute")
    out = case.run("k_zero", entities=dict(start, law=slips.replace("1000", "0")))
    forces = history(out)
    # Normals are exact but for rounding; a little of the normal impulses shows as shear.
    shear = max(np.abs(forces[f"contactx:{plate}"]).max() for plate in ("bottom", "top"))
    case.check("k = 0: shear over eta U/H", shear / L / (eta * U / H), 0, 1e-14, "absolute")
