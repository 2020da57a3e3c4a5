# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

PRANDTL = 2 + math.pi
SAND = dict(kernel="B2SPLINE", locking="", order=6, phi=30, stiff=100, speed=0.0001)


def bearing(case, label, h, **entities):
    """Mean pressure over cohesion in the last third of the run, of a footing that ends half a cell beyond its last node."""
    out = case.run(label, entities=dict(h=h, **entities))
    rows = verify.history(out)
    force = -next(rows[name] for name in rows if name.startswith("reactiony"))
    e = verify.energy(out)
    case.check(f"{label}, {1 / h:g} cells: residual of the energy over the work of the footing", np.abs(e["residual"]).max() / e["boundary_work"].max(), 0, 0.02, "at most")
    last = rows["time"] > rows["time"].max() * 2 / 3
    return force[last].mean() / (1 + h / 2), out


def surcharge(case, h, nq, nc, cohesion=0.003):
    """Weightless sand under a surcharge of 1 beside the footing."""
    first = 1 + h / 2
    loads = f"<ParticleBCs><LdRect xmin='{first}' xmax='8' ymin='-{h / 2}' ymax='0'><TractionBC dir='2' face='3' style='1' stress='-1'/></LdRect></ParticleBCs>"
    n, _ = bearing(case, "surcharge", h, **SAND, cohesion=cohesion, wide=8, deep=4, end=24, stress="<InitialStress xx='-1' yy='-1' zz='-1'/>", loads=loads)
    case.check("sand under a surcharge, 16 cells per half width: Nq", n - cohesion * nc, nq, 0.05)


def weight(case, h, nc, cohesion=0.003):
    """Sand of weight 1."""
    loads = f"<Gravity><BodyYForce>-{1 / SAND['stiff']}</BodyYForce></Gravity>"
    n, _ = bearing(case, "weight", h, **SAND, cohesion=cohesion, wide=5, deep=2.5, end=12, stress="<InitialStress xx='y' yy='y' zz='y'/>", loads=loads)
    case.check("sand with weight, 16 cells per half width: Ngamma", (n - cohesion * nc) / (1 + h / 2), 14.7543, 0.10)


def slip(case, out, speed, end):
    p = verify.last_particles(out)

    def draw(axes):
        x, u = p["points"], p["displacement"] / (speed * (end - 0.5))
        shown = axes.scatter(x[:, 0], x[:, 1], c=np.hypot(u[:, 0], u[:, 1]), s=2, cmap="viridis", linewidths=0)
        axes.get_figure().colorbar(shown, label="displacement over the footing's", shrink=0.6)
        axes.plot([0, 1], [0.03, 0.03], color="k", lw=4, solid_capstyle="butt")
        axes.set(xlabel="x / b", ylabel="y / b", aspect=1, title="Soil that slips away under a footing, friction 30 degrees")

    case.figure("footing", draw)


def run(case):
    if case.quick:
        for locking, low, high in (("<BBar/>", 0.95, 1.05), ("", 1.1, 1.6)):
            n, _ = bearing(case, "coarse" + "b" * bool(locking), 0.25, locking=locking)
            case.check(f"clay, linear, 4 cells per half width, {'B-bar' if locking else 'locks'}: Nc over Prandtl's", n / PRANDTL, (low + high) / 2, (high - low) / 2, "absolute")
        return
    for label, kernel, locking in (("linear with B-bar", "Classic", "<BBar/>"), ("quadratic splines", "B2SPLINE", "")):
        n, _ = bearing(case, f"clay_{kernel}", 1 / 16, kernel=kernel, locking=locking)
        case.check(f"clay, {label}, 16 cells per half width: Nc", n, PRANDTL, 0.02)
    friction = math.radians(30)
    nq = math.exp(math.pi * math.tan(friction)) * math.tan(math.pi / 4 + friction / 2) ** 2
    sand = dict(kernel="B2SPLINE", locking="", phi=30, stiff=100, wide=12, deep=6, speed=0.00015, end=24)
    n, out = bearing(case, "sand", 1 / 8, **sand)
    case.check("friction and dilation 30 degrees, quadratic splines, 8 cells per half width: Nc", n, (nq - 1) / math.tan(friction), 0.04)
    slip(case, out, sand["speed"], sand["end"])
    surcharge(case, 1 / 16, nq, (nq - 1) / math.tan(friction))
    weight(case, 1 / 16, (nq - 1) / math.tan(friction))
    rows = []
    for label, kernel, locking in (("linear", "Classic", ""), ("linear, B-bar", "Classic", "<BBar/>"), ("uGIMP", "uGIMP", ""), ("linear CPDI, B-bar", "lCPDI", "<BBar/>"),
                                   ("quadratic splines", "B2SPLINE", "")):
        n, _ = bearing(case, f"coarse_{kernel}{'b' if locking else ''}", 1 / 8, kernel=kernel, locking=locking)
        rows.append([label, f"{n:.3f}", f"{n / PRANDTL - 1:+.1%}"])
    case.table("Nc of clay with 8 cells per half width", ["shape functions", "Nc", "error"], rows)
