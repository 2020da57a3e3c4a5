# SPDX-License-Identifier: MIT
import numpy as np

import verify

E1, E2, G, nu, load = 10.0, 1.0, 0.6, 0.3, 2e-4
TRANSVERSE = "<EA>10</EA><ET>1</ET><GA>0.6</GA><nuA>0.3</nuA><nuT>0.4</nuT>"


def strains(angle):
    """xx, yy and the shear angle of a strip under a load along x, its fibres at `angle` to it: Jones, Mechanics of Composite Materials, 2.6."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    xx = c**4 / E1 + s**4 / E2 + (1 / G - 2 * nu / E1) * s**2 * c**2
    yy = (1 / E1 + 1 / E2 - 1 / G) * s**2 * c**2 - nu / E1 * (s**4 + c**4)
    xy = (2 / E1 + 2 * nu / E1 - 1 / G) * s * c**3 - (2 / E2 + 2 * nu / E1 - 1 / G) * s**3 * c
    return load * np.array([xx, yy, xy])


def pulled(case, label, angle, **entities):
    p = verify.last_particles(case.run(label, entities=dict(angle=repr(angle)) | entities))
    u = p["displacement"][:, :2]
    x = p["points"][:, :2] - u
    inner = np.abs(x[:, 0]) < 1
    gradient = np.linalg.lstsq(np.column_stack([x[inner], np.ones(inner.sum())]), u[inner], rcond=None)[0][:2].T
    return np.array([gradient[0, 0], gradient[1, 1], gradient[0, 1] + gradient[1, 0]]), p["stress"][inner]


def run(case):
    for angle in (0, 15, 30, 60, 90) if not case.quick else (30,):
        got, stress = pulled(case, f"strip{angle}", angle)
        exact = strains(angle)
        size = np.abs(exact).max()
        for name, a, b in zip(("strain along the load", "strain across", "shear"), got, exact):
            case.check(f"fibres at {angle} degrees: {name} times E2/load", a * E2 / load, b * E2 / load, 0.01 * size * E2 / load, "absolute")
        case.check(f"fibres at {angle} degrees: stress along the load over the load", stress[:, 0].mean() / load, 1, 0.005)
    got, _ = pulled(case, "transverse", 60, type="3", moduli=TRANSVERSE)
    for name, a, b in zip(("strain along the load", "strain across", "shear"), got, strains(150)):
        case.check(f"Transverse2, axis at 150 degrees: {name} times E2/load", a * E2 / load, b * E2 / load, 0.01 * np.abs(strains(150)).max() * E2 / load, "absolute")
    if case.quick:
        return

    def draw(axes):
        angles = np.linspace(0, 90, 181)
        exact = np.array([strains(a) for a in angles]) * E2 / load
        measured = {r["what"]: r["measured"] for r in case.results}
        for k, name in enumerate(("strain along the load", "strain across", "shear")):
            axes.plot(angles, exact[:, k], linewidth=0.9, color=f"C{k}", label=name)
            axes.plot([0, 15, 30, 60, 90], [measured[f"fibres at {a} degrees: {name} times E2/load"] for a in (0, 15, 30, 60, 90)], "o", markersize=4, color=f"C{k}")
        axes.set_xlabel("angle of the fibres to the load [degrees]")
        axes.set_ylabel("strain E2/load")
        axes.legend(fontsize=8)

    case.figure("offaxis", draw)
