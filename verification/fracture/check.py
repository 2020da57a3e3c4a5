# SPDX-License-Identifier: MIT
import math

import numpy as np

import verify
import vtp

E, nu = 1000.0, 0.3
plane_strain = E / (1 - nu**2)
plane_strain_stiff = 10 * plane_strain  # of the plate with a closed crack


def tips(out, end=2):
    got = verify.table(f"{out}/tips.csv")
    return {name: column[got["end"] == end] for name, column in got.items()}


def spread(values):
    return (max(values) - min(values)) / np.mean(values)


def faces(out):
    return vtp.read(vtp.collection(out, "cracks")[-1][1])


def beam(case):
    out = case.run("beam", "beam.xml", dict(h="1", end="1.5") if case.quick else {})
    case.check("double cantilever beam: J [N/mm]", tips(out)["J"][-1], 2.73380784e-4, 2e-2)
    case.check("double cantilever beam: opening [mm]", 2 * verify.history(out)["dispy:arm:0,5"][-1], 9.70034735e-2, 2e-2)


def plates(case):
    kinds = {"centre": ("0", 1.186234), "edge": ("", 2.826375)}
    for name, (symmetry, factor) in kinds.items():
        exact = factor * math.sqrt(5 * math.pi)
        K = []
        for size in (3, 4, 5, 6) if name == "centre" else (4,):
            # the plate with the edge crack bends, slowly
            out = case.run(f"{name}{size}", "plate.xml", dict(size=str(size), end="1" if symmetry else "4"), {} if symmetry else {" symmin='0'": ""})
            got = tips(out)
            K.append(got["K1"][-1])
            where = f"{name} crack, ring of {size} cells"
            case.check(f"{where}: K1 [MPa mm^1/2]", K[-1], exact, 3e-2)
            case.check(f"{where}: from J", math.sqrt(got["J"][-1] * plane_strain), exact, 3e-2)
            case.check(f"{where}: K2 / K1", abs(got["K2"][-1]) / K[-1], 0, 1e-2, "at most")
        if len(K) > 1:
            case.check(f"{name} crack: spread of K1 over rings of 3 to 6 cells", spread(K), 0, 1e-2, "at most")


def wave(case):
    # until the first wave from the ends comes back
    drawn = []
    for nu_, factor in {0.25: 1.063846081, 0.3: 1.019499495}.items():
        speed = math.sqrt(1000 * (1 - nu_) / ((1 + nu_) * (1 - 2 * nu_) * 1e-3))
        means = []
        for size in (3, 4, 5, 6):
            got = tips(case.run(f"wave{nu_}_{size}", "wave.xml", dict(nu=str(nu_), size=str(size), h="0.25", top="19.85")))
            way = speed * got["time"] - 20  # of the front since it met the crack
            late = (way > 4) & (way < 20)
            K = got["K1"][late] / np.sqrt(way[late])
            J = np.sqrt(got["J"][late] * 1000 / (1 - nu_**2) / way[late])
            means.append(K.mean())
            what = f"tension wave, nu = {nu_}, ring of {size} cells"
            case.check(f"{what}: K1 / (stress sqrt(c t)), mean", K.mean(), factor, 5e-2)
            case.check(f"{what}: worst", np.abs(K / factor - 1).max(), 0, 5e-2, "at most")
            case.check(f"{what}: from J, mean", J.mean(), factor, 5e-2)
            drawn.append((what, way, got["K1"], factor))
        case.check(f"tension wave, nu = {nu_}: spread over rings", spread(means), 0, 3e-2, "at most")

    def draw(axes):
        for what, way, K, factor in drawn[1::4]:
            on = way > 0
            line, = axes.plot(way[on], K[on], label=what)
            axes.plot(way[on], factor * np.sqrt(way[on]), "--", color=line.get_color())
        axes.set_xlabel("way of the front since it met the crack [mm]")
        axes.set_ylabel("K1 [MPa mm$^{1/2}$]")
        axes.legend()

    case.figure("fracture_wave", draw)


def slip_of(got):
    """Slip of the faces, and squares of the distance from the middle."""
    return np.linalg.norm(got["opening"], axis=1), (got["points"][:, :2] ** 2).sum(axis=1)


def in_the_middle(slip, s2):
    return slip[s2.argmin()]


def K2_of(slip, s2):
    """The K2 whose slip^2 = (4 t/E')^2 (a^2 - s^2), K2 = t sqrt(pi a), fits that of the faces within 0.8 a."""
    near = s2 < 0.64
    slope = -np.polyfit(s2[near], slip[near] ** 2, 1)[0]
    return plane_strain_stiff / 4 * math.sqrt(math.pi * slope)


def closed(case):
    # effective shear stress of a closed crack at 45 degrees: (10 - 2)/2 - mu (10 + 2)/2
    for mu in (0, 0.3, 0.6):
        shear = 4 - 6 * mu
        out = case.run(f"closed{mu}", "closed.xml", dict(mu=str(mu)))
        got = slip_of(faces(out))
        exact = shear * math.sqrt(math.pi)
        case.check(f"closed crack, mu = {mu}: slip [mm]", in_the_middle(*got), 4 * shear / plane_strain_stiff, 3e-2)
        case.check(f"closed crack, mu = {mu}: K2 from the slip [MPa mm^1/2]", K2_of(*got), exact, 4e-2)
        ring = abs(tips(out)["K2"][-1])
        case.check(f"closed crack, mu = {mu}: K2 from the ring [MPa mm^1/2]", ring, exact, 4e-2 * 4 * math.sqrt(math.pi), "absolute")
    out = case.run("closed0.7", "closed.xml", dict(mu="0.7"))
    case.check("closed crack, mu = 0.7: slip / slip without friction", in_the_middle(*slip_of(faces(out))) / (16 / plane_strain_stiff), 0, 1e-2, "at most")
    out = case.run("closed1", "closed.xml", dict(mu="1", h="0.0625", face="2.47"))
    case.check("closed crack, mu = 1: slip [mm]", np.abs(faces(out)["opening"]).max(), 0, 1e-12, "at most")


def growth(case):
    out = case.run("growth", "growth.xml")
    got = tips(out)
    # G = 9 E I d^2/(a + chi h)^4 of arms of h = 5 mm that are d = 0.4 mm apart from the middle, chi = 0.66348 (Williams)
    length = (9 * 10000 * 125 / 12 * 0.4**2 / 0.02) ** 0.25 - 0.66348346 * 5
    case.check("running crack: length in the end [mm]", got["x"][-1], length, 5e-2)
    grows = got["length"] > 31
    case.check("running crack: largest J / JIc", got["J"][grows].max() / 0.02, 1, 5e-2)
    case.check("running crack: leaves its plane by [mm]", abs(got["y"]).max(), 0, 1e-6, "at most")
    stop = "<CustomTasks><Schedule name='ReverseLoad'><Parameter name='maxLength'>33</Parameter><Parameter name='style'>2</Parameter></Schedule></CustomTasks>"
    got = tips(case.run("arrested", "growth.xml", dict(end="6"), replace={"</JANFEAInput>": stop + "</JANFEAInput>"}))
    case.check("crack that stops beyond 33 mm: length at first [mm]", got["length"][got["length"] > 33][0], 33.25, 0.3, "absolute")
    case.check("crack that stops beyond 33 mm: length in the end [mm]", got["length"][-1], got["length"][got["length"] > 33][0], 0.05, "absolute")
    case.check("crack that stops beyond 33 mm: JIc / largest J", 0.02 / got["J"].max(), 0, 0.9, "at most")


def penny(case):
    out = case.run("penny", "penny.xml")
    got = faces(out)
    quarter = (got["points"][:, 0] > 1e-6) & (got["points"][:, 1] > 1e-6)  # the rest lies on or beyond the planes of symmetry
    r2 = (got["points"][quarter, :2] ** 2).sum(axis=1)
    near = (r2 > 0.25) & (r2 < 0.8)
    opening = got["opening"][quarter, 2]
    case.check("penny crack: opening in the middle [mm]", opening[r2 < 0.02].mean(), 8 * (1 - nu**2) / (math.pi * E), 5e-2)
    # opening^2 = (8 s/(pi E'))^2 (a^2 - r^2), K = 2 s sqrt(a/pi), a = 1
    slope = -np.polyfit(r2[near], opening[near] ** 2, 1)[0]
    case.check("penny crack: K1 [MPa mm^1/2]", plane_strain / 4 * math.sqrt(math.pi * slope), 2 / math.sqrt(math.pi), 5e-2)


def run(case):
    beam(case)
    if case.quick:
        return
    plates(case)
    wave(case)
    closed(case)
    growth(case)
    penny(case)
