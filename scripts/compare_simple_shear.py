# SPDX-License-Identifier: MIT
"""Shear stress of the simple-shear example against the closed form.

sigma_xy = G rate t until c cos(phi), then c cos(phi) + G rate eta (1 - exp(-(t - t_y) / eta)), small strain; the run turns the
stress with the material (Jaumann), which costs up to (sigma/G)^2/2 of it.
"""

import csv
import math
import sys

G, rate, eta, cohesion, friction = 200e6, 1.0, 1e-3, 1e6, math.radians(30)
strength = cohesion * math.cos(friction)
yield_time = strength / (G * rate)


def closed_form(t):
    if t <= yield_time:
        return G * rate * t
    return strength + G * rate * eta * (1 - math.exp(-(t - yield_time) / eta))


folder = sys.argv[1]
with open(f"{folder}/history.csv") as file:
    rows = list(csv.DictReader(file))
print(f"{'time [s]':>10} {'sigma_xy [Pa]':>16} {'closed form [Pa]':>18} {'difference':>12}")
worst = 0.0
for k, row in enumerate(rows):
    t, stress = float(row["time"]), float(row["sxy"])
    exact = closed_form(t)
    if t > 0:
        worst = max(worst, abs(stress - exact) / closed_form(float(rows[-1]["time"])))
    if t > 0 and k % 30 == 0:
        print(f"{t:10.4g} {stress:16.2f} {exact:18.2f} {stress / exact - 1:12.2e}")
print(f"largest difference: {worst:.1e} of the final stress (time step and finite rotation explain 4e-4)")
print(f"open {folder}/run.pvd in ParaView")
sys.exit(0 if worst < 4e-4 else 1)
