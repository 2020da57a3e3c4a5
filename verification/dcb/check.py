# SPDX-License-Identifier: MIT
import numpy as np

import verify

E, nu, depth, notch, length = 3000.0, 0.3, 6.0, 18.0, 54.0  # of one arm [MPa, mm], lengths from the line of load
stiff = E / (1 - nu**2)


class Triangle:
    """Traction in straight lines through the corners (0, 0), (d1, s1), ..., (end, 0)."""

    def __init__(self, *corners):
        self.d, self.s = np.array([(0.0, 0.0), *corners]).T

    def secant(self, d):
        d = np.maximum(d, 1e-12)
        return np.interp(d, self.d, self.s, right=0.0) / d


class Cubic:
    def __init__(self, peak, end):
        self.peak, self.end = peak, end

    def secant(self, d):
        return 6.75 * self.peak / self.end * np.clip(1 - d / self.end, 0, 1) ** 2


class Exponential:
    def __init__(self, peak, at, end, alpha):
        self.peak, self.at, self.end, self.alpha = peak, at, end, alpha

    def secant(self, d):
        x = np.clip((d - self.at) / (self.end - self.at), 0, 1)
        after = (np.exp(-self.alpha * x) - np.exp(-self.alpha)) / (1 - np.exp(-self.alpha))
        return self.peak * np.where(d > self.at, after / np.maximum(d, self.at), 1 / self.at)


def beam(law, opening, elements=90):
    """Force and dissipated energy for openings of the line of load: two Timoshenko beams on a cohesive zone.

    The face of a beam moves against the mean of its section, too: by 0.35 depth/E' times the traction, for the stress
    1 - 3 s^2 + 2 s^3 at the distance s from the face, and by nu/(1 - nu) depth^2/12 times the curvature, by Poisson's
    ratio."""
    h = length / elements
    EI, GA = stiff * depth**3 / 12, 5 / 6 * E / 2 / (1 + nu) * depth
    yielding, bulge = 2 * 0.35 * depth / stiff, nu / (1 - nu) * depth**2 / 12
    K = np.zeros((2 * elements + 2, 2 * elements + 2))
    shear = np.array([-1 / h, -0.5, 1 / h, -0.5])  # w' - theta of (w, theta, w, theta)
    face = np.array([0.5, -bulge / h, 0.5, bulge / h])
    at = [np.arange(2 * e, 2 * e + 4) for e in range(elements)]
    for dofs in at:
        K[np.ix_(dofs, dofs)] += GA * h * np.outer(shear, shear)
        K[np.ix_(dofs[1::2], dofs[1::2])] += EI / h * np.array([[1, -1], [-1, 1]])
    bonded = [e for e in range(elements) if (e + 0.5) * h > notch]
    gap = largest = np.zeros(len(bonded))
    force, work, lost = [0.0], 0.0, []
    for k, d in enumerate(opening):
        for _ in range(200):
            secant = law.secant(np.maximum(largest, gap))
            A = K.copy()
            for e, c in zip(bonded, secant / (1 + yielding * secant)):
                A[np.ix_(at[e], at[e])] += 2 * c * h * np.outer(face, face)
            u = np.concatenate([[d / 2], np.linalg.solve(A[1:, 1:], -A[1:, 0] * d / 2)])
            last, gap = gap, np.array([2 * face @ u[at[e]] for e in bonded]) / (1 + yielding * secant)
            if np.abs(gap - last).max() < 1e-7:
                break
        largest = np.maximum(largest, gap)
        force.append(A[0] @ u)
        work += 0.5 * (force[-1] + force[-2]) * (d - (opening[k - 1] if k else 0))
        lost.append(work - 0.5 * force[-1] * d)  # all but what it would give back, since it unloads to the origin
    return np.array(force[1:]), np.array(lost)


def both(text):
    """Properties for opening, and the same for sliding."""
    return text + text.replace("I>", "II>").replace("Ic>", "IIc>").replace("I2>", "II2>")


toughness, peak = 0.091, 0.66
first = 0.225926299 * 2 * toughness / peak
triangle = Triangle((first, peak), (2 * toughness / peak, 0))
full = 2 * (1 / 2 - 1 / np.expm1(2))  # of the exponential with alpha = 2, peak at 0.15 of its end
decayed = 2 * toughness / peak / (0.15 + 0.85 * full)
laws = {
    "TriangularTraction": (both("<sigmaI>0.66</sigmaI><JIc>0.091</JIc>"), triangle),
    "CubicTraction": (both("<sigmaI>0.66</sigmaI><JIc>0.091</JIc>"), Cubic(peak, 16 / 9 * toughness / peak)),
    "TrilinearTraction": (both("<sigmaI>0.66</sigmaI><delpkI>0.25</delpkI><sigmaI2>0.4</sigmaI2><delpkI2>0.5</delpkI2><delIc>0.3</delIc>"),
                          Triangle((0.075, 0.66), (0.15, 0.4), (0.3, 0))),
    "ExponentialTraction": (both("<sigmaI>0.66</sigmaI><JIc>0.091</JIc><delpkI>0.15</delpkI><alphaI>2</alphaI>"),
                            Exponential(peak, 0.15 * decayed, decayed, 2.0)),
    "CoupledTraction": ("<sigmaI>0.66</sigmaI><JIc>0.091</JIc>", triangle),
    "MixedModeTraction": ("<modelI>14</modelI><modelII>14</modelII>" + both("<sigmaI>0.66</sigmaI><JIc>0.091</JIc>"),
                          Cubic(peak, 16 / 9 * toughness / peak)),
}


def run(case):
    curves = []
    for law in ["TriangularTraction"] if case.quick else laws:
        properties, curve = laws[law]
        out = case.run(law, entities=dict(type=law, law=properties))
        rows = verify.history(out)
        opening = 1.2 * np.maximum(rows["time"] - 0.42, 0) / 2.58  # after the first 0.84 ms
        force = 0.5 * (rows["reactiony:-1"] - rows["reactiony:-2"])
        asked = np.linspace(0.1, 1.2, 45)
        reference, lost = beam(curve, asked)
        case.check(f"{law}: largest force [N/mm]", force.max(), reference.max(), 1e-2)
        case.check(f"{law}: energy of the zone at the end [mJ/mm]", rows["Decohesion"][-1], lost[-1], 1e-2)
        case.check(f"{law}: the same from the work of its faces", rows["Joint Released Energy"][-1], rows["Decohesion"][-1], 1e-3)
        curves.append((law, opening, force, asked, reference))

    def draw(axes):
        for law, opening, force, asked, reference in curves:
            line, = axes.plot(opening, force, label=law)
            axes.plot(asked, reference, "--", color=line.get_color())
        axes.set_xlabel("opening of the line of load [mm]")
        axes.set_ylabel("force [N/mm]")
        axes.legend()

    case.figure("dcb", draw)
