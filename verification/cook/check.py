# SPDX-License-Identifier: MIT
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


def confined(case):
    """A column in a box: pressure is (1 + nu)/(1 - nu)/3 times the load, everywhere."""
    expected = 1e-3 * (1 + 2 * 0.499 / 0.501) / 3
    rows = []
    for label, kernel, locking in (("linear CPDI with B-bar", "lCPDI", "<BBar/>"), ("linear CPDI", "lCPDI", ""), ("quadratic splines", "B2SPLINE", "")):
        for skew in (0.2,) if case.quick else (0, 0.2):
            p = verify.last_particles(case.run(f"confined_{kernel}_{bool(locking)}_{skew}", "confined.xml", entities=dict(kernel=kernel, locking=locking, skew=skew)))
            pressure = -p["stress"][:, :3].sum(axis=1) / 3 / expected
            rows.append([label, "in rows" if skew == 0 else "bulging rows", f"{pressure.mean():.5f}", f"{pressure.std():.2g}"])
            if skew == 0:
                case.check(f"confined column, Poisson's ratio 0.499, {label}: pressure, worst particle", np.abs(pressure - 1).max(), 0, 1e-4, "absolute")
            elif locking:
                case.check(f"confined column, {label}, rows that bulge by 0.2 cells: pressure", pressure.mean(), 1, 0.01)
                case.check(f"confined column, {label}, rows that bulge by 0.2 cells: spread of the pressure", pressure.std(), 0, 0.01, "absolute")
        if case.quick:
            return
    case.table("Pressure in a confined column over its exact value, and its spread", ["", "particles", "mean", "spread"], rows)


def run(case):
    confined(case)
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
