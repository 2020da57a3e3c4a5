# SPDX-License-Identifier: MIT
import numpy as np

import verify

p, ratio, cell = 1e4, 0.3 / 0.7, 0.1


def run(case):
    for impulses in ("nodes", "faces"):
        for seam, level in (("1", "1"), ("1.05", "1.05"))[1 if case.quick else 0 :]:
            if case.quick and impulses == "faces":
                continue
            out = case.run(f"{impulses}{seam}", entities=dict(impulses=impulses, seam=seam, level=level))
            data, last = verify.last_particles(out), {q: v[-1] for q, v in verify.history(out).items()}
            where = f"{impulses}, T at ({seam}, {level})"
            error = np.hypot(data["stress"][:, 1] / p + 1, data["stress"][:, 0] / p + ratio)
            near = np.hypot(data["points"][:, 0] - float(seam), data["points"][:, 1] - float(level)) < 2.5 * cell
            case.check(f"{where}: error of the stress (RMS) over p", np.sqrt((error**2).mean()), 0, 0.01, "at most")
            case.check(f"{where}: the same next to the T", np.sqrt((error[near] ** 2).mean()), 0, 0.03, "at most")
            case.check(f"{where}: drift over the cell", max(abs(last[f"dispx:{b}"]) for b in ("left", "right", "top")) / cell, 0, 1e-3, "at most")
            case.check(f"{where}: force on the upper block over p A", last["contacty:top"] / (2 * p), 1, 1e-3)
            case.check(f"{where}: force across the seam over that of the stress", -last["contactx:left"] / (ratio * p * float(level)), 1, 0.01)
    for impulses in ("nodes", "faces"):
        for turned in (17,) if case.quick else (0, 17):
            star(case, impulses, turned)


def star(case, impulses, turned):
    """Three rhombi in a Y: uniform pressure, no drift."""
    size, cell, strain = 1.2, 0.05, 1e-3
    bodies = ""
    for k, name in enumerate("abc"):
        (ux, uy), (vx, vy) = (size * np.array([np.cos(t), np.sin(t)]) for t in np.radians([turned + 90 + 120 * k, turned + 210 + 120 * k]))
        bodies += (f"<Body matname='{name}'><Deform dX='{ux - 1}*x+({vx})*y' dY='{uy}*x+({vy - 1})*y' F11='{ux}' F12='{vx}' F21='{uy}' F22='{vy}'/>"
                   "<Rect xmin='0' xmax='1' ymin='0' ymax='1'/></Body>")
    out = case.run(f"y_{impulses}_{turned}", file="y.xml", entities=dict(impulses=impulses, bodies=bodies))
    first, last = (verify.vtp.read(verify.vtp.collection(out)[k][1]) for k in (0, -1))
    old, new = first["points"][np.argsort(first["id"])], last["points"][np.argsort(last["id"])]
    material, stress = last["material"][np.argsort(last["id"])], last["stress"][np.argsort(last["id"])]
    inside = (abs(old[:, :2]) < 0.6).all(axis=1)
    wrong = (new - (1 - strain) * old)[:, :2]
    drift = max(np.linalg.norm(wrong[inside & (material == m)].mean(axis=0)) for m in (1, 2, 3))
    pressure = 1e7 * strain / (1.3 * 0.4)
    where = f"{impulses}, Y turned by {turned} degrees"
    case.check(f"{where}: drift of a block over the cell", drift / cell, 0, 1e-3, "at most")
    case.check(f"{where}: mean pressure", -stress[inside, :2].mean(), pressure, 0.02)
    case.check(f"{where}: error of the normal stresses (RMS) over the pressure", np.sqrt(((stress[inside, :2] / pressure + 1) ** 2).mean()), 0, 0.06, "at most")
