import numpy as np

import verify

SPAN, LOW, HIGH = 48, 44, 60
LOAD = 2e-4
REFERENCE = {0.3: 23.06, 0.499: 19.45}  # tip deflection E/F of mixed elements, see README


def tip(case, label, **entities):
    """Deflection of the upper right corner over F/E, from the plane through the particles next to it; pressures."""
    out = case.run(label, entities=entities)
    p = verify.last_particles(out)
    start = p["points"] - p["displacement"]
    near = np.argsort(np.hypot(start[:, 0] - SPAN, start[:, 1] - HIGH))[:12]
    plane = np.c_[np.ones(12), start[near, 0] - SPAN, start[near, 1] - HIGH]
    v = np.linalg.lstsq(plane, p["displacement"][near, 1], rcond=None)[0][0]
    return v / LOAD, start, -p["stress"][:, :3].sum(axis=1) / 3 / LOAD


def roughness(start, pressure, h):
    """RMS of what pressures differ from the plane through the particles within a cell, away from the ends."""
    rest = []
    inner = np.nonzero((start[:, 0] > 4 * h) & (start[:, 0] < SPAN - 4 * h))[0]
    for i in inner[::5]:
        near = np.abs(start[:, :2] - start[i, :2]).max(axis=1) < h
        plane = np.c_[np.ones(near.sum()), start[near, :2] - start[i, :2]]
        rest.append(pressure[i] - np.linalg.lstsq(plane, pressure[near], rcond=None)[0][0])
    return float(np.sqrt(np.mean(np.square(rest))))


def run(case):
    if case.quick:
        return
    rows = []
    h = 4 / 3
    for label, kernel, locking in (("linear CPDI with B-bar", "lCPDI", "<BBar/>"), ("quadratic splines", "B2SPLINE", ""), ("linear CPDI", "lCPDI", "")):
        for nu in (0.3, 0.499):
            v, start, pressure = tip(case, f"{kernel}{'_b' if locking else ''}_{nu}", h=h, last=SPAN - h / 4, kernel=kernel, nu=nu, locking=locking)
            if label != "linear CPDI":
                case.check(f"{label}, Poisson's ratio {nu}: deflection of the tip", v, REFERENCE[nu], 0.03)
            rough = roughness(start, pressure, h)
            rows.append([label, f"{nu}", f"{v:.2f}", f"{v / REFERENCE[nu] - 1:+.1%}", f"{rough:.4f}"])
    case.table("Deflection of the tip over F/E, and roughness of the pressure over F (RMS distance from the plane through the neighbours)",
               ["", "Poisson's ratio", "deflection", "error", "roughness"], rows)
