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


def draw(name, tribo, run, column, folder):
    globals()[name](Pictures(tribo, run, column, folder))
