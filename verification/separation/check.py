# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify

D, peak, last, speed, length = 100.0, 1.0, 0.04, 1e-4, 2.0
shapes = dict(linear="", Morse="<X_shape>1</X_shape><Xpeak>1</Xpeak>", bilinear="<X_shape>2</X_shape><Xpeak>1</Xpeak><Xbreak>0.04</Xbreak>")


def traction(shape, d):
    if shape == "linear":
        return D * d
    if shape == "Morse":
        a = D / (4 * peak)
        return 2 * 8 * peak**2 / D * a * np.exp(-a * d) * (1 - np.exp(-a * d))
    return np.interp(d, [0, peak / D, last, 1], [0, peak, 0, 0])


def separate(case, shape, along=False, turned=0.0):
    """Opening, mean traction since the row before, and energy per area."""
    c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
    words = shapes[shape].replace("X_shape", "tangential_shape" if along else "normal_shape").replace("Xpeak", "Tpeak" if along else "Npeak")
    words = words.replace("Xbreak", "Tbreak" if along else "Nbreak")
    entities = dict(law=f"<Material Type='NonlinearInterface' Name='joint'><Dnt>{D}</Dnt><Dt>{D}</Dt>{words}</Material>", c=repr(c), s=repr(s))
    entities |= dict(vx="0", vy=repr(speed)) if along else {}
    corner = lambda x, y: (c * x - s * y, s * x + c * y)
    (x1, y1), (x2, y2) = corner(-1, -1), corner(-1, 1)
    got = verify.history(case.run(f"{shape}{along}{turned}", entities=entities, replace={"x1='-1' y1='-1' x2='-1' y2='1'": f"x1='{x1}' y1='{y1}' x2='{x2}' y2='{y2}'"}))
    fx, fy = got["contactx:block"], got["contacty:block"]
    return speed * got["time"], (-s * fx + c * fy if along else c * fx + s * fy) / length, got["Interface Energy"] / length


def run(case):
    curves = []
    for along in (False, True):
        for shape in shapes:
            for turned in (0.0, 17.0):
                if case.quick and (along, shape, turned) != (False, "bilinear", 17.0):
                    continue
                d, T, energy = separate(case, shape, along, turned)
                parts = np.linspace(0, 1, 101)  # of the openings between two rows
                exact = np.array([np.trapz(traction(shape, a + (b - a) * parts), parts) for a, b in zip(np.append(d[0], d[:-1]), d)])
                tolerance = 0.01 if turned else 0.005
                where = f"{shape}, {'along' if along else 'across'} the face, turned by {turned:g} degrees"
                case.check(f"{where}: largest error of the traction over the peak", np.abs(T - exact).max() / exact.max(), 0, tolerance, "at most")
                case.check(f"{where}: energy stored", energy[-1], np.trapz(traction(shape, np.linspace(0, d[-1], 10001)), np.linspace(0, d[-1], 10001)), 2 * tolerance)
                if not along and turned:
                    curves.append((shape, d, T, exact))

    def draw(axes):
        for k, (shape, d, T, exact) in enumerate(curves):
            axes.plot(d, exact, color=f"C{k}", linewidth=0.8, label=shape)
            axes.plot(d[::4], T[::4], "o", color=f"C{k}", markersize=3)
        axes.set_ylim(0, 1.6)
        axes.set_xlabel("opening [mm]")
        axes.set_ylabel("traction [MPa]")
        axes.legend(fontsize=8, title="lines: law; dots: Tribo, turned by 17 degrees", title_fontsize=8)

    case.figure("separation", draw)
