# SPDX-License-Identifier: MIT
"""Pictures of the tutorials, for `scripts/tutorials TRIBO draw`."""

import glob
import os
import shutil
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import vtp


class Pictures:
    def __init__(self, tribo, run, column, folder):
        self.tribo, self.run, self.folder = tribo, run, folder
        self.column = lambda out, quantity: np.array(column(out, quantity))
        os.makedirs(folder, exist_ok=True)

    def render(self, out, name, field, time, *options):
        pictures = f"{out}/for_{name}"
        subprocess.run([self.tribo, "render", out, "--field", field, "--time", str(time), "--width", "760", "-o", pictures, *options], check=True,
                       stdout=subprocess.DEVNULL)
        shutil.copy(glob.glob(pictures + "/*.png")[0], f"{self.folder}/{name}.png")

    def plot(self, name, xlabel, ylabel, curves, size=(7, 3.6), **axes):
        """Curves: (x, y, style, label)."""
        figure, plane = plt.subplots(figsize=size, layout="constrained")
        for x, y, style, label in curves:
            plane.plot(x, y, style, label=label, linewidth=1.5, markersize=4)
        plane.set(xlabel=xlabel, ylabel=ylabel, **axes)
        plane.grid(alpha=0.3)
        plane.legend()
        figure.savefig(f"{self.folder}/{name}.png", dpi=110)
        plt.close(figure)


def rock_slope(p):
    curves = []
    for phi in (37, 38, 38.1, 38.2, 39):
        out = p.run("rock_slope.xml", phi=phi, end=20)
        curves.append((p.column(out, "time"), -p.column(out, "dispx:10"), "-", f"{phi} degrees"))
    p.plot("rock_slope_motion", "time [s]", "column 10 to the left [m]", curves, ylim=(0, 0.4))
    p.render(p.run("rock_slope.xml"), "rock_slope", "displacement", 10)
    p.render(p.run("rock_slope.xml", phi=39), "rock_slope_start", "group", 0)


def beam_on_glue(strength, toughness, length, depth, modulus, poisson, final):
    """Tip displacement and force of a beam, with shear, on a face that stays plane and opens by the triangular law."""
    failed = 2 * toughness / strength
    peak = 0.226 * failed
    y = ((np.arange(2000) + 0.5) / 2000 - 0.5) * depth
    compliance = length**3 / (3 * modulus * depth**3 / 12) + 1.2 * length * 2 * (1 + poisson) / (modulus * depth)

    def traction(opening):
        rising, falling = strength / peak * opening, strength * np.clip((failed - opening) / (failed - peak), 0, None)
        return np.where(opening < peak, rising, falling)

    curve = [(0.0, 0.0)]
    for angle in np.linspace(0, final / length, 400)[1:]:
        low, high = -angle * depth, angle * depth
        for _ in range(60):  # the opening at half depth, without axial force
            middle = (low + high) / 2
            low, high = (low, middle) if traction(middle + angle * y).mean() > 0 else (middle, high)
        force = (traction(middle + angle * y) * y).mean() * depth / length
        curve.append((angle * length + force * compliance, force))
    return np.array(curve).T


def bonded_cantilever(p):
    out = p.run("bonded_cantilever.fmcmd")
    displacement = 0.45 * (p.column(out, "time") / 5) ** 2
    theory = beam_on_glue(3, 0.05, 40, 10, 10000, 0.3, 0.45)
    print("largest force of the beam:", theory[1].max(), "at", theory[0][theory[1].argmax()])
    p.plot("bonded_cantilever_force", "displacement of the tip [mm]", "force per width [N/mm]",
           [(*theory, "k-", "beam theory with the law of the glue"), (displacement, -p.column(out, "reactiony:-1"), "-", "at the tip"),
            (displacement, p.column(out, "contacty:Beam"), "-", "in the glue")], xlim=(0, 0.45), ylim=(0, 2))
    p.render(out, "bonded_cantilever", "stress.xx", 3)


def deposit(out, height):
    """Outline (x, depth) of the sand at the end of a run, and the run-out: where it is 0.05 deep, from the foot of the column."""
    x = vtp.read(vtp.collection(out)[-1][1])["points"][:, 0]
    depth = np.bincount((x / 0.05).astype(int)) * height / len(x) / 0.05
    return (np.arange(len(depth)) + 0.5) * 0.05, depth, (np.nonzero(depth >= 0.05)[0].max() + 1) * 0.05 - 1


def granular_column(p):
    heights, fronts, outlines = (0.5, 1, 2, 3), [], []
    for a in heights:
        x, depth, front = deposit(p.run("granular_column.fmcmd", a=a, end=3.5 if a > 2 else 3 if a > 1 else 2), a)
        fronts.append(front)
        outlines.append((x, np.convolve(np.pad(depth, (2, 1), "symmetric"), np.full(4, 0.25), "valid"), "-", f"a = {a}"))
    print("run-outs:", fronts)
    p.plot("granular_column_deposits", "x / half width", "depth / half width", outlines, xlim=(0, 6), ylim=(0, 1.4))
    line = np.linspace(0.2, 3.2, 301)
    gap = lambda low, high, change: np.where(abs(line - change) < 0.01, np.nan, np.where(line < change, low, high))  # noqa: E731
    p.plot("granular_column_run_out", "height / half width", "run-out / half width",
           [(line, gap(1.2 * line, 1.9 * line ** (2 / 3), 1.8), "k-", "Lube et al. (experiments)"),
            (line, gap(1.8 * line, 2.3 * line ** (2 / 3), 3), "k--", "Lajeunesse et al. (experiments)"),
            (line, 2.2 * line, "k:", "Lagree et al. (continuum)"), (heights, fronts, "o", "Tribo")], ylim=(0, 7))
    p.render(p.run("granular_column.fmcmd", a=1, end=2), "granular_column", "velocity", 0.4)


def contact_of_rings(p):
    out = p.run("contact_of_rings.fmcmd")
    time = p.column(out, "time")
    p.plot("contact_of_rings_force", "time [ms]", "force per thickness [N/mm]", [(time, p.column(out, "contactx:Right"), "-", "contact force on the right ring")],
           xlim=(0, 7))
    width = p.column(out, "maxx:Right") - p.column(out, "minx:Right")
    after = time > 3
    waves = np.c_[np.ones(after.sum()), np.cos(2 * np.pi * time[after] / 3.047), np.sin(2 * np.pi * time[after] / 3.047)]
    fitted = waves @ np.linalg.lstsq(waves, width[after], rcond=None)[0]
    p.plot("contact_of_rings_width", "time [ms]", "width of the right ring [mm]",
           [(time, width, "-", "Tribo"), (time[after], fitted, "k--", "wave with the period of theory, 3.05 ms")], xlim=(0, 7))
    p.render(out, "contact_of_rings", "von_mises", 2)

    frame = next(vtp.read(file) for time, file in vtp.collection(p.run("contact_of_rings.fmcmd", offset=20)) if time > 1.999)
    x, traction, touching = frame["points"], frame["contact_traction"], frame["contact_state"] > 0
    figure, plane = plt.subplots(figsize=(6, 4.6), layout="constrained")
    for material, name in ((1, "left ring"), (2, "right ring")):
        own = frame["material"] == material
        plane.plot(x[own, 0], x[own, 1], ".", markersize=6, label=name)
    plane.quiver(x[touching, 0], x[touching, 1], traction[touching, 0], traction[touching, 1], angles="xy", scale=5, width=0.006)
    middle = x[touching].mean(axis=0)
    plane.set(xlabel="x [mm]", ylabel="y [mm]", aspect=1, xlim=(middle[0] - 6, middle[0] + 6), ylim=(middle[1] - 4.5, middle[1] + 4.5))
    plane.legend(loc="upper left")
    figure.savefig(f"{p.folder}/contact_of_rings_normals.png", dpi=110)
    plt.close(figure)


def landslide(p):
    curves = []
    for phi in (25, 30, 35):
        out = p.run("landslide.fmcmd", phi=phi)
        force = np.convolve(p.column(out, "contactx:Wall"), np.full(50, 0.02), "valid") / 1e3
        curves.append((p.column(out, "time")[25:-24], force, "-", f"friction {phi} degrees"))
    p.plot("landslide_force", "time [s]", "force on the wall, mean over 0.1 s [kN/m]", curves, xlim=(1.5, 5), ylim=(0, 50))
    p.render(p.run("landslide.fmcmd", phi=30), "landslide", "velocity", 2)
    p.render(p.run("landslide.fmcmd", phi=30), "landslide_at_rest", "displacement", 5)
    p.render(p.run("landslide.fmcmd", wall=0), "landslide_without_wall", "displacement", 5)


def draw(name, tribo, run, column, folder):
    globals()[name](Pictures(tribo, run, column, folder))
