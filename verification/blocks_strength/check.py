# SPDX-License-Identifier: MIT
import csv
import math

import numpy as np

import verify

area, height = 0.0692820323027551, 0.09
voronoi = dict(cells="<Voronoi xmin='0' xmax='0.05' ymin='0' ymax='0.1' file='nuclei.csv' rho='2500'/>", right="0.05", top="0.1")


def two_speeds(fast, begin, slow):
    """Fast for 0.3, rest for 0.1, then slow."""
    return f"t&lt;0.3 ? {fast / 0.3!r} : (t&lt;0.4 ? 0 : {slow!r})" if begin else repr(slow)


def bond(nu, tension):
    return f"<compute-stiffness>emod 50e9 poisson {nu}</compute-stiffness><sn_ten>{tension}</sn_ten>"


class Load:
    def __init__(self, case, label, width=area, length=height, **entities):
        self.out = case.run(label, entities=entities)
        h = verify.history(self.out)
        self.time, self.stress = h["time"], -h["forcey:top"] / width
        self.lower = h["forcey:bottom"] / width
        self.strain = h["dispy:top"] / length
        self.tension, self.shear = h["broken in tension"], h["broken in shear"]
        e = verify.energy(self.out)
        self.audit = np.abs(e["residual"]).max() / np.abs(e["boundary_work"]).max()
        with open(f"{self.out}/events.csv") as f:
            self.events = [row for row in csv.DictReader(f) if row["event"] == "bond_break"]

    def first(self, mode):
        """Stress (mean of both platens) when the first bond broke this way."""
        times = [float(row["time"]) for row in self.events if row["mode"] == str(mode)]
        k = np.searchsorted(self.time, times[0] - 1e-9)
        return abs(0.5 * (self.stress[k - 1] + self.lower[k - 1]))

    def modulus(self, strain):
        k = np.searchsorted(np.abs(self.strain), strain)
        return 0.5 * (self.stress[k] + self.lower[k]) / self.strain[k]


def tension(case, label, nu, cells=None, **more):
    size = dict(width=0.05, length=0.1) if cells else {}
    load = Load(case, label, **size, **(cells or {}), bond=bond(nu, "5e6"), speed=two_speeds(8.1e-6, True, 1e-5 if not cells else 4e-6),
                end="0.65" if not cells else "1.2", **more)
    case.check(f"{label}: strength / tensile strength", load.stress.max() / 5e6, 1, 1e-2 if cells else 1e-3)
    case.check(f"{label}: bonds broken in shear at the peak", load.shear[load.stress.argmax()], 0, 0, "absolute")
    case.check(f"{label}: E [GPa]", load.modulus(0.92e-4 if not cells else 0.85e-4) * 1e-9, 50, 1e-3)
    case.check(f"{label}: energy that is not accounted for / work", load.audit, 0, 1e-6, "at most")
    return load


def compression(case, label, nu, p, cells=None, ten="1e12"):
    size = dict(width=0.05, length=0.1) if cells else {}
    expected = 2 * 20e6 * math.cos(math.pi / 6) / 0.5 + 3 * p
    length = 0.1 if cells else height
    fast = -0.95 * (expected - nu * p) / 50e9 * length
    load = Load(case, label, **size, **(cells or {}), bond=bond(nu, ten), speed=two_speeds(fast, True, -1.5e-5), pressure=repr(p), end="1.1")
    case.check(f"{label}: first bond that shears [MPa]", load.first(2) * 1e-6, expected * 1e-6, 1e-2 if cells else 1e-3)
    case.check(f"{label}: energy that is not accounted for / work", load.audit, 0, 1e-6, "at most")
    return load


def run(case):
    import shutil

    shutil.copy(case.folder / "nuclei.csv", case.scratch / "nuclei.csv")
    loads = [tension(case, "hexagons, tension", 0)]
    tension(case, "hexagons, tension, nu 0.25", 0.25)
    compression(case, "hexagons, compression", 0, 0.0)
    compression(case, "hexagons, confined by 5 MPa", 0, 5e6)
    if case.quick:
        return
    loads.append(tension(case, "Voronoi cells, tension", 0, voronoi))
    loads.append(tension(case, "Voronoi cells, tension, moments count", 0, voronoi, share="1"))
    pressed = [compression(case, "Voronoi cells, compression", 0, 0.0, voronoi, ten="5e6"),
               compression(case, "Voronoi cells, compression, nu 0.25", 0.25, 0.0, voronoi, ten="5e6"),
               compression(case, "Voronoi cells, confined by 5 MPa", 0, 5e6, voronoi)]
    case.table("Voronoi cells", ["", "peak [MPa]", "bonds torn", "bonds sheared"],
               [[name, f"{np.abs(load.stress).max() * 1e-6:.2f}", f"{load.tension[-1]:.0f}", f"{load.shear[-1]:.0f}"]
                for name, load in zip(("tension", "tension, moments count", "compression", "compression, nu 0.25", "confined by 5 MPa"),
                                      loads[1:] + pressed)])

    def draw(axes):
        axes.plot(-pressed[0].strain * 1e3, -pressed[0].stress * 1e-6, label="compression")
        axes.plot(-pressed[2].strain * 1e3, -pressed[2].stress * 1e-6, label="confined by 5 MPa")
        axes.plot(loads[1].strain * 1e3, loads[1].stress * 1e-6, label="tension")
        axes.set_xlabel("axial strain [1e-3]")
        axes.set_ylabel("axial stress [MPa]")
        axes.legend()

    case.figure("blocks_strength", draw)
