# SPDX-License-Identifier: MIT
import pathlib

import numpy as np

POINTS = pathlib.Path(__file__).parents[2] / "tests/materials/data/mohr_coulomb_points.csv"

MC = "<Material Type='MohrCoulomb' Name='m'><rho>2000</rho>{}</Material>"
shear_rate = 1e-5


def soil(**more):
    given = dict(K=2e8, G=2e8, cohesion=1e6, friction=30, dilation=0) | more
    return MC.format("".join(f"<{k}>{v!r}</{k}>" for k, v in given.items()))


def elastic(case):
    """Hooke's law; E = 1000, nu = 0.3."""
    law = "<Material Type='LinearElastic' Name='m'><rho>1</rho><E>1000</E><nu>0.3</nu></Material>"
    got = case.drive("hooke", "<Drive material='m' test='oedometer' strain='-0.01' steps='1'/>", law)
    case.check("elastic, uniaxial strain: sxx", got["sxx"][-1], 13.461538461538462, 1e-12)
    case.check("elastic, uniaxial strain: syy", got["syy"][-1], 5.769230769230769, 1e-12)
    got = case.drive("bar", "<Drive material='m' test='uniaxial_stress' strain='0.01' steps='1'/>", law)
    case.check("elastic, uniaxial stress: sxx", got["sxx"][-1], 10.0, 1e-10)
    case.check("elastic, uniaxial stress: eyy", got["eyy"][-1], -0.003, 1e-10)
    got = case.drive("plane", "<Drive material='m'><Path>dt,Lxx,syy\n1,0.01,0</Path></Drive>", law)
    case.check("elastic, plane strain, free sides: sxx", got["sxx"][-1], 1000 / (1 - 0.09) * 0.01, 1e-10)
    case.check("elastic, plane strain, free sides: eyy", got["eyy"][-1], -0.3 / 0.7 * 0.01, 1e-10)
    got = case.drive("spin", "<Drive material='m' test='simple_shear' strain='2' steps='1000'/>", law)
    case.check("elastic, simple shear by 2 in 1000 steps, Jaumann rate: sxy/G", got["sxy"][-1] / (1000 / 2.6), np.sin(2), 1e-6)
    case.check("elastic, simple shear by 2: sxx/G", got["sxx"][-1] / (1000 / 2.6), 1 - np.cos(2), 1e-6)
    for shear in (0.5, 1, 4):
        turned = case.drive(f"spin{shear}", f"<Drive material='m' test='simple_shear' strain='{shear}' steps='1000'/>", law)
        case.check(f"elastic, simple shear by {shear:g}: sxy/G", turned["sxy"][-1] / (1000 / 2.6), np.sin(shear), 1e-6)
    return got


def rubber(case):
    law = f"<Material Type='NeoHookean' Name='m'><rho>1</rho><G>{1000 / 2.6!r}</G><Lame>{300 / 1.3 / 0.4!r}</Lame><UJOption>2</UJOption></Material>"
    for stretch, across, s in ((0.5, 1.21076739, -638.048474), (0.8, 1.06733837, -210.676811), (1.5, 0.880174592, 488.287861), (2.0, 0.798077544, 1015.41288)):
        got = case.drive(f"neo{stretch}", f"<Drive material='m' test='uniaxial_stress' strain='{np.log(stretch)!r}' steps='20'/>", law)
        case.check(f"neo-Hookean, uniaxial stress, stretch {stretch:g}: stretch across", np.exp(got["eyy"][-1]), across, 1e-8)
        case.check(f"neo-Hookean, uniaxial stress, stretch {stretch:g}: sxx", got["sxx"][-1], s, 1e-8)
    for shear in (0.5, 1, 2, 4):
        got = case.drive(f"neoshear{shear}", f"<Drive material='m' test='simple_shear' strain='{shear}' steps='10'/>", law)
        case.check(f"neo-Hookean, simple shear by {shear:g}: sxy/G", got["sxy"][-1] / (1000 / 2.6), shear, 1e-10)
        case.check(f"neo-Hookean, simple shear by {shear:g}: sxx/G", got["sxx"][-1] / (1000 / 2.6), shear**2, 1e-10)
    for stretch, across, s in ((0.8, 1.09487606, -245.353368), (1.2, 0.921495438, 205.507006)):
        got = case.drive(f"neoplane{stretch}", f"<Drive material='m'><Path>dt,steps,Lxx,syy\n0.1,10,{np.log(stretch)!r},0</Path></Drive>", law)
        case.check(f"neo-Hookean, plane strain, stretch {stretch:g}: stretch across", np.exp(got["eyy"][-1]), across, 1e-8)
        case.check(f"neo-Hookean, plane strain, stretch {stretch:g}: sxx", got["sxx"][-1], s, 1e-8)
    # incompressible: driven without change of volume, only differences of stresses count; C1 = 0.3, C2 = 0.1
    law = "<Material Type='Mooney' Name='m'><rho>1</rho><K>1e3</K><G1>0.6</G1><G2>0.2</G2></Material>"
    paths = {"uniaxial, stretch 2": ("Lxx,Lyy,Lzz\n0.1,10,{0},{1},{1}", np.log(2), -0.5 * np.log(2), 2.45),
             "uniaxial, stretch 1.5": ("Lxx,Lyy,Lzz\n0.1,10,{0},{1},{1}", np.log(1.5), -0.5 * np.log(1.5), 1.16111111111111),
             "uniaxial, stretch 0.5": ("Lxx,Lyy,Lzz\n0.1,10,{0},{1},{1}", np.log(0.5), -0.5 * np.log(0.5), -1.75),
             "biaxial, stretch 2": ("Lxx,Lyy,Lzz\n0.1,10,{0},{1},{0}", np.log(2), -2 * np.log(2), 5.5125)}
    for name, (rows, a, b, difference) in paths.items():
        got = case.drive("mooney" + name.replace(", ", "_").replace(" ", "_"), "<Drive material='m'><Path>dt,steps," + rows.format(repr(a), repr(b)) + "</Path></Drive>", law)
        case.check(f"Mooney-Rivlin, {name}: sxx - syy", got["sxx"][-1] - got["syy"][-1], difference, 1e-10)
    got = case.drive("mooneyshear", "<Drive material='m' test='simple_shear' strain='1' steps='10'/>", law)
    case.check("Mooney-Rivlin, simple shear by 1: sxy", got["sxy"][-1], 0.8, 1e-10)
    case.check("Mooney-Rivlin, simple shear by 1: sxx - syy", got["sxx"][-1] - got["syy"][-1], 0.8, 1e-10)
    case.check("Mooney-Rivlin, simple shear by 1: syy - szz", got["syy"][-1] - got["szz"][-1], -0.2, 1e-10)
    law = "<Material Type='TaitLiquid' Name='m'><rho>1000</rho><K>2.2e9</K><viscosity>0.003</viscosity></Material>"
    for J, p in ((0.99, 23277614.4), (0.95, 147395861.0), (1.005, -10698049.0)):
        got = case.drive(f"tait{J}", f"<Drive material='m'><Path>dt,Lxx\n1,{np.log(J)!r}\n1e9,0</Path></Drive>", law)
        case.check(f"Tait liquid, J = {J:g}: pressure", -got["sxx"][-1], p, 1e-8)
    got = case.drive("newton", "<Drive material='m'><Path>dt,Lxy\n1e-9,7\n1e-9,0</Path></Drive>", law)
    case.check("Newtonian shear: sxy", got["sxy"][1], 0.021, 1e-12)
    got = case.drive("newtonpull", "<Drive material='m'><Path>dt,Lxx,Lyy\n1e-9,7,-7\n1e-9,0,0</Path></Drive>", law)
    case.check("Newtonian extension at constant volume: (sxx - syy)/2", 0.5 * (got["sxx"][1] - got["syy"][1]), 2 * 0.003 * 7, 1e-8)


def fibrous(case):
    """Saint Venant-Kirchhoff: S = E1 E along an axis, sides free."""
    moduli = dict(Ex=12.0, Ey=0.9, Ez=0.5, Gxy=0.8, Gyz=0.1, Gxz=0.7, nuxy=0.4, nuyz=0.5, nuxz=0.45)
    law = "<Material Type='Orthotropic' Name='m'><rho>1</rho>" + "".join(f"<{k}>{v!r}</{k}>" for k, v in moduli.items()) + "</Material>"
    for angle, E, contractions in ((0, 12.0, (0.4, 0.45)), (90, 0.9, (0.4 * 0.9 / 12, 0.5))):
        stretch = 1.1
        green = (stretch**2 - 1) / 2
        across = [np.sqrt(1 - 2 * nu * green) for nu in contractions]
        got = case.drive(f"fibres{angle}", f"<Drive material='m' test='uniaxial_stress' strain='{np.log(stretch)!r}' steps='5' angle='{angle}'/>", law)
        case.check(f"orthotropic, axes at {angle} degrees, stretch 1.1: sxx", got["sxx"][-1], E * green * stretch / (across[0] * across[1]), 1e-9)
        case.check(f"orthotropic, axes at {angle} degrees, stretch 1.1: stretch across", np.exp(got["eyy"][-1]), across[0], 1e-9)
    law = "<Material Type='Transverse1' Name='m'><rho>1</rho><EA>10</EA><ET>1</ET><GA>0.6</GA><nuA>0.3</nuA><nuT>0.4</nuT></Material>"
    got = case.drive("isotropic_plane", "<Drive material='m' test='simple_shear' strain='0.3' steps='3'/>", law)
    # S = G E xy, with the normal stress that E_yy = g^2/2 brings
    normal = np.linalg.inv(np.array([[1, -0.4, -0.03], [-0.4, 1, -0.03], [-0.03, -0.03, 0.1]])) @ np.array([0, 0.045, 0])
    case.check("transversely isotropic, sheared by 0.3 across its axis: sxy", got["sxy"][-1], 0.3 / 2.8 + 0.3 * normal[1], 1e-12)


def turning(case):
    """Stretched, then turned by a full circle about z in 1000 steps: stress and material must come round together."""
    pair = "<rho>1</rho><E>1000</E><nu>0.3</nu>"
    laws = dict(LinearElastic=pair, NeoHookean=pair, Mooney="<rho>1</rho><K>833</K><G1>300</G1><G2>84</G2>", Orthotropic="<rho>1</rho>" + "".join(f"<{k}>{v}</{k}>" for k, v in dict(Ex=1200, Ey=90, Ez=50, Gxy=80, Gyz=10, Gxz=70, nuxy=0.4, nuyz=0.5, nuxz=0.45).items()),
                IsoPlasticity=pair + "<yield>1e6</yield>", MohrCoulomb=pair + "<cohesion>1e6</cohesion><friction>30</friction>", Viscoelastic="<rho>1</rho><K>833</K><G0>384</G0><Gk>1e-9</Gk><tauk>1</tauk>")
    for name, properties in laws.items():
        law = f"<Material Type='{name}' Name='m'>{properties}</Material>"
        rate = repr(2 * np.pi / 1000)
        got = case.drive("turn" + name, f"<Drive material='m'><Path>dt,steps,Lxx,Lyy,Lxy,Lyx\n0.5,1,1,-0.3,0,0\n1,1000,0,0,-{rate},{rate}</Path></Drive>", law)
        start, quarter = ({c: got[c][k] for c in ("sxx", "syy", "szz", "sxy")} for k in (1, 251))
        size = max(abs(v) for v in start.values())
        case.check(f"{name}, turned by a quarter of a circle: sxx against syy before", abs(quarter["sxx"] - start["syy"]) / size, 0, 1e-12, "at most")
        case.check(f"{name}, turned by a full circle in 1000 steps: stress", max(abs(got[c][-1] - start[c]) for c in start) / size, 0, 1e-12, "at most")


def mohr_coulomb(case):
    # triaxial: both edges
    law = soil(K=1e7 / 1.2, G=1e7 / 2.6, cohesion=5e3, friction=35, dilation=5)
    N, N_psi = ((1 + np.sin(np.radians(a))) / (1 - np.sin(np.radians(a))) for a in (35, 5))
    got = case.drive("compression", "<Drive material='m' test='triaxial_compression' strain='0.06' steps='300' pressure='1e5'/>", law)
    curve = got
    case.check("Mohr-Coulomb, triaxial compression: strength", -got["sxx"][-1] - 1e5, 288227.054484, 1e-9)
    plastic = np.diff(got["eyy"] + got["ezz"])[-1] / -np.diff(got["exx"])[-1] - 1
    case.check("Mohr-Coulomb, triaxial compression: dilation over axial strain", plastic, N_psi - 1, 1e-8)
    got = case.drive("extension", "<Drive material='m' test='triaxial_extension' strain='0.03' steps='300' pressure='1e5'/>", law)
    case.check("Mohr-Coulomb, triaxial extension: strength", 1e5 + got["sxx"][-1], 78106.665094, 1e-9)
    volume = np.diff(got["exx"] + got["eyy"] + got["ezz"])[-1] / np.diff(got["exx"])[-1]
    case.check("Mohr-Coulomb, triaxial extension: dilation over axial strain", volume, 1 - 1 / N_psi, 1e-8)
    # oedometer, logarithmic strain of u = 0.02
    for dilation, axial, lateral in ((0, 6427279.592298, 2847172.399107), (10, 7086413.936686, 3311261.107301)):
        law = soil(cohesion=1e6, friction=10, dilation=dilation, tension=5.67e6)
        for steps in (1, 2000):
            got = case.drive(f"oedometer{dilation}{steps}", f"<Drive material='m' test='oedometer' strain='{-np.log1p(-0.02)!r}' steps='{steps}'/>", law)
            case.check(f"Mohr-Coulomb, oedometer, dilation {dilation}, {steps} step{'s' * (steps > 1)}: axial stress", -got["sxx"][-1], axial, 1e-9)
            case.check(f"Mohr-Coulomb, oedometer, dilation {dilation}, {steps} step{'s' * (steps > 1)}: lateral stress", -got["syy"][-1], lateral, 1e-9)
    # isochoric shear without rotation
    pure = "<Drive material='m'><Path>dt,steps,Lxy,Lyx\n{0!r},{1},0.5,0.5</Path></Drive>"
    for gamma, shear, szz in ((0.01, 983680.132407, -58827.364311), (0.03, 1398697.290694, -266335.943455), (0.1, 2833259.617533, -1101208.809964), (0.15, 3797047.357352, -2064996.549783)):
        got = case.drive(f"dilating{gamma}", pure.format(gamma / 100, 100), soil(dilation=10))
        case.check(f"Mohr-Coulomb, isochoric shear by {gamma:g}, dilation 10: sxy", got["sxy"][-1], shear, 1e-9)
        case.check(f"Mohr-Coulomb, isochoric shear by {gamma:g}, dilation 10: szz", got["szz"][-1], szz, 1e-9)
    # backward Euler in the benchmark's steps of 1 s
    slow = f"<Drive material='m'><Path>dt,steps,Lxy,Lyx\n1,3000,{shear_rate / 2!r},{shear_rate / 2!r}</Path></Drive>"
    Ry, rate = 1e6 * np.cos(np.pi / 6), 2e8 * shear_rate
    yielded = int(Ry / rate)
    curves = {}
    for eta in (0.1, 100.0, 500.0, 1000.0, 2000.0, 1e6):
        got = case.drive(f"viscous{eta:g}", slow, soil(relaxation_time=eta))
        n, steady = np.arange(3001), Ry + rate * eta
        exact = np.where(n <= yielded, rate * n, steady + (yielded * rate - steady) * (1 + 1 / eta) ** -np.maximum(n - yielded, 0.0))
        case.check(f"Mohr-Coulomb, shear with eta = {eta:g} s: largest error of 3000 steps over the stress", np.abs(got["sxy"] - exact).max() / exact.max(), 0, 1e-9, "at most")
        curves[eta] = got
    # softening of the cohesion; without viscosity each step settles on the line
    got = case.drive("softening", slow, soil(cohesion_residual=5e5, softening_end=0.01))
    for t, shear in ((1000, 728367.104848), (2000, 485578.069899), (3000, 433012.701892)):
        case.check(f"Mohr-Coulomb, softening, {t} s: sxy", got["sxy"][t], shear, 1e-9)
    returns(case)
    corners(case)
    return curve, curves


def returns(case):
    """One step of strain whose elastic answer is a trial stress: where that returns to, in exact arithmetic; principal stresses and tensors."""
    stiff = dict(K=2e8, G=2e8, cohesion=1e6, friction=30)
    laws = {"A": stiff | dict(dilation=30), "B": stiff | dict(dilation=30, tension=5e5), "C": stiff | dict(dilation=10), "D": stiff | dict(dilation=0, tension=2e5),
            "E": dict(K=1e7 / 1.2, G=1e7 / 2.6, cohesion=5e3, friction=35, dilation=5, tension=0), "F": stiff | dict(friction=0, dilation=0, tension=3e5)}
    worst = dict(principal=0.0, tensor=0.0)
    count = dict(principal=0, tensor=0)
    order = ("xx", "yy", "zz", "xy", "yz", "xz")
    for line in POINTS.read_text().splitlines():
        cells = line.split(",")
        if len(cells) < 8 or cells[1] not in laws:
            continue
        kind = "tensor" if len(cells) == 14 else "principal"
        size = 6 if kind == "tensor" else 3
        trial, expected = (np.array([float(v) for v in part]) for part in (cells[2:2 + size], cells[2 + size:2 + 2 * size]))
        law, s = laws[cells[1]], np.r_[trial, np.zeros(6 - size)]
        mean = s[:3].mean()
        strain = np.r_[(s[:3] - mean) / (2 * law["G"]) + mean / (3 * law["K"]), s[3:] / (2 * law["G"])]
        columns = "Lxx,Lyy,Lzz,Lxy,Lyx,Lyz,Lzy,Lxz,Lzx"
        rates = ",".join(repr(v) for v in strain[[0, 1, 2, 3, 3, 4, 4, 5, 5]].tolist())
        got = case.drive("return" + cells[0], f"<Drive material='m'><Path>dt,{columns}\n1,{rates}</Path></Drive>", soil(**law))
        returned = np.array([got["s" + name][-1] for name in order[:size]])
        worst[kind] = max(worst[kind], np.abs(returned - expected).max() / max(np.abs(trial).max(), laws[cells[1]]["cohesion"]))
        count[kind] += 1
    for kind, what in (("principal", "principal stresses"), ("tensor", "tensors")):
        case.check(f"Mohr-Coulomb, return of {count[kind]} {what}: worst error over the trial", worst[kind], 0, 1e-10, "at most")


def corners(case):
    """c = 10, friction 30 degrees."""
    law = soil(K=1e4, G=5e3, cohesion=10.0, friction=30, dilation=30)
    got = case.drive("mc_compression", "<Drive material='m' test='triaxial_compression' strain='0.1' pressure='100'/>", law)
    case.check("Mohr-Coulomb, c = 10, triaxial compression at 100: largest stress", -got["sxx"][-1], 300 + 20 * np.sqrt(3), 1e-9)
    got = case.drive("mc_extension", "<Drive material='m' test='triaxial_extension' strain='0.1' pressure='100'/>", law)
    case.check("Mohr-Coulomb, c = 10, triaxial extension at 100: least stress", -got["sxx"][-1], (100 - 20 * np.sqrt(3)) / 3, 1e-9)
    got = case.drive("mc_apex", "<Drive material='m' test='isotropic' strain='-0.1'/>", law)
    case.check("Mohr-Coulomb, c = 10, isotropic tension: stress", got["sxx"][-1], 10 * np.sqrt(3), 1e-9)
    got = case.drive("mc_shear", "<Drive material='m'><Path>dt,steps,Lxy,Lyx\n0.001,10,1,1</Path></Drive>", law.replace("<dilation>30", "<dilation>0"))
    case.check("Mohr-Coulomb, c = 10, pure shear: strength", got["sxy"][-1], 5 * np.sqrt(3), 1e-9)


def work(got, legs, axes=("xx", "yy")):
    """Work per initial volume, by rows: trapezoidal sums over every step, every second, every fourth, extrapolated within each straight leg."""
    stress = np.array([got["J"] * got["s" + a] for a in axes])
    strain = np.array([got["e" + a] for a in axes])
    steps = (stress.shape[1] - 1) // legs

    def trapezoid(leg, stride):
        part = slice(leg * steps, (leg + 1) * steps + 1, stride)
        s, e = stress[:, part], strain[:, part]
        return (0.5 * (s[:, 1:] + s[:, :-1]) * np.diff(e)).sum()

    def romberg(leg):
        sums = [trapezoid(leg, 2**k) for k in range(5)]
        for order in range(1, 5):
            sums = [(4**order * fine - coarse) / (4**order - 1) for fine, coarse in zip(sums, sums[1:])]
        return sums[0]

    return np.array([romberg(leg) for leg in range(legs)]), sum(trapezoid(leg, 1) for leg in range(legs))


def cycles(case):
    """Stretched along x, along y, and back: elastic solids give back all work; metals what they have not dissipated."""
    rows = "dt,steps,Lxx,Lyy\n0.01,32,1,0\n0.01,32,0,-0.7\n0.01,32,-1,0\n0.01,32,0,0.7"
    a, b = 0.32, -0.224
    x2, y2, log_J = np.exp(2 * a), np.exp(2 * b), a + b
    G, K = 384.0, 833.0
    J = np.exp(log_J)
    energies = {"NeoHookean": (f"<G>{G}</G><Lame>577</Lame><UJOption>2</UJOption>", G / 2 * (x2 + y2 - 2) - G * log_J + 577 / 2 * log_J**2),
                "Mooney": (f"<K>{K}</K><G1>{G}</G1><G2>0</G2><UJOption>1</UJOption>", G / 2 * ((x2 + y2 + 1) * J ** (-2 / 3) - 3) + K / 2 * (J - 1) ** 2)}
    for name, (properties, energy) in energies.items():
        got = case.drive("cycle" + name, f"<Drive material='m'><Path>{rows}</Path></Drive>", f"<Material Type='{name}' Name='m'><rho>1</rho>{properties}</Material>")
        legs, _ = work(got, 4)
        case.check(f"{name}, half a cycle: work over the stored energy", legs[:2].sum() / energy, 1, 1e-10)
        case.check(f"{name}, closed cycle: work over the stored energy", abs(legs.sum()) / energy, 0, 1e-10, "at most")
    law = "<Material Type='VonMises' Name='m'><rho>1</rho><E>200e3</E><nu>0.3</nu><yield>250</yield><Khard>1000</Khard></Material>"
    got = case.drive("metal", "<Drive material='m'><Path>dt,steps,Lxx,Lyy\n0.005,200,0.01,-0.01\n0.005,200,-0.01,0.01</Path></Drive>", law)
    _, total = work(got, 2)
    alpha, s = got["plastic_strain"][-1], got["sxx"][-1]
    case.check("von Mises, closed cycle, 200 steps a leg: work over dissipation and stored energy", total / (250 * alpha + 500 * alpha**2 + s**2 * 1.3 / 200e3), 1, 1e-4)


def others(case):
    law = "<Material Type='VonMises' Name='m'><rho>1</rho><E>200e3</E><nu>0.3</nu><yield>250</yield><Khard>1000</Khard></Material>"
    for steps in (1, 100):
        got = case.drive(f"mises{steps}", f"<Drive material='m' test='uniaxial_stress' strain='0.01' steps='{steps}'/>", law)
        case.check(f"von Mises, uniaxial stress, {steps} step{'s' * (steps > 1)}: sxx", got["sxx"][-1], 260 / 1.005, 1e-9)
        got = case.drive(f"misesshear{steps}", f"<Drive material='m'><Path>dt,steps,Lxy,Lyx\n{1 / steps!r},{steps},0.01,0.01</Path></Drive>", law)
        case.check(f"von Mises, shear by 0.02, {steps} step{'s' * (steps > 1)}: sxy", got["sxy"][-1], 150.352706, 1e-8)
        case.check(f"von Mises, shear by 0.02, {steps} step{'s' * (steps > 1)}: plastic strain", got["plastic_strain"][-1], 0.0104185251, 1e-8)
        got = case.drive(f"misesconfined{steps}", f"<Drive material='m' test='oedometer' strain='-0.01' steps='{steps}'/>", law)
        case.check(f"von Mises, uniaxial strain, {steps} step{'s' * (steps > 1)}: sxx", got["sxx"][-1], 1837.03950, 1e-8)
        case.check(f"von Mises, uniaxial strain, {steps} step{'s' * (steps > 1)}: syy", got["syy"][-1], 1581.48025, 1e-8)
    got = case.drive("mises_limit", "<Drive material='m'><Path>dt,Lxx\n1.625e-3,1\n1e-6,1</Path></Drive>", law)
    case.check("von Mises, uniaxial strain: stress at the elastic limit", got["sxx"][1], 437.5, 1e-9)
    case.check("von Mises, uniaxial strain: plastic strain at the elastic limit", got["plastic_strain"][1], 0, 1e-12, "at most")
    case.check("von Mises, uniaxial strain: flows beyond it", 1.0 if got["plastic_strain"][2] > 0 else 0.0, 1, 0)
    cone = "<Material Type='DruckerPrager' Name='m'><rho>2000</rho><K>2e8</K><G>2e8</G><cohesion>1e6</cohesion><friction>30</friction><match>{}</match></Material>"
    for match, strength in ((1, 1.2), (2, 6 / 7), (3, 3 / np.sqrt(13)), (4, np.sqrt(0.75))):
        got = case.drive(f"cone{match}", "<Drive material='m'><Path>dt,steps,Lxy,Lyx\n0.001,10,1,1</Path></Drive>", cone.format(match))
        case.check(f"Drucker-Prager, match {match}: shear strength over the cohesion", got["sxy"][-1] / 1e6, strength, 1e-9)
    got = case.drive("conetriaxial", "<Drive material='m' test='triaxial_compression' strain='0.1' pressure='1e6'/>", cone.format(1))
    case.check("Drucker-Prager, match 1, triaxial compression: strength", -got["sxx"][-1], 3e6 + 2e6 * np.sqrt(3), 1e-9)
    clay = "<Material Type='CamClay' Name='m'><rho>1</rho><lambda>0.2</lambda><kappa>0.04</kappa><e0>1</e0><M>0.9</M><pc0>200</pc0><G>5000</G></Material>"
    begin = "<Drive material='m'><InitialStress xx='-{0}' yy='-{0}' zz='-{0}'/><Path>dt,steps,Lxx,Lyy,Lzz\n{1}</Path></Drive>"
    squeeze, swell = (0.02 * np.log(2) + 0.1 * np.log(1.5)) / 3, 0.02 * np.log(3) / 3
    got = case.drive("virgin", begin.format(100, f"1,1,{-squeeze!r},{-squeeze!r},{-squeeze!r}\n1,1,{swell!r},{swell!r},{swell!r}"), clay)
    case.check("Cam-Clay, isotropic compression in one step: pressure", -got["sxx"][1], 300, 1e-9)
    case.check("Cam-Clay, swelling: pressure", -got["sxx"][2], 100, 1e-9)
    case.check("Cam-Clay, swelling: consolidation pressure", got["consolidation"][2], 300, 1e-9)
    for p0 in (200, 40):
        got = case.drive(f"undrained{p0}", begin.format(p0, "1e-4,20000,-1,0.5,0.5"), clay)
        p, q = -(got["sxx"] + got["syy"] + got["szz"])[-1] / 3, (got["syy"] - got["sxx"])[-1]
        case.check(f"Cam-Clay, sheared at constant volume from {p0}, 20000 steps: pressure at the critical state", p, p0 * (200 / p0 / 2) ** 0.8, 2e-4)
        case.check(f"Cam-Clay, sheared at constant volume from {p0}: q/p at the critical state", q / p, 0.9, 1e-6)
    law = "<Material Type='Viscoelastic' Name='m'><rho>1</rho><K>5</K><G0>0.1</G0><Gk>0.3</Gk><tauk>1</tauk></Material>"
    for t, modulus in ((0, 0.4), (0.5, 0.281959198), (1, 0.210363832), (5, 0.102021384)):
        got = case.drive(f"relax{t}", f"<Drive material='m'><Path>dt,steps,Lxy,Lyx\n1e-12,1,5e9,5e9\n{max(t, 1e-12)},1,0,0</Path></Drive>", law)
        case.check(f"standard linear solid, relaxation after {t:g} tau", got["sxy"][-1] / 0.01, modulus, 1e-8)
    got = case.drive("creep", "<Drive material='m'><Path>dt,steps,Lxy,Lyx,Lzz,sxy\n1e-9,1,,0,0,0.001\n0.001,4000,,0,0,0.001</Path></Drive>", law)
    case.check("standard linear solid, creep for 4 tau, 4000 steps: shear over that of the relaxed modulus", got["exy"][-1] / 0.005, 1 - 0.75 * np.exp(-1), 1e-4)
    for steps in (1, 10):
        got = case.drive(f"rate{steps}", f"<Drive material='m'><Path>dt,steps,Lxy,Lyx\n{2 / steps!r},{steps},5e-4,5e-4</Path></Drive>", law)
        case.check(f"standard linear solid, constant rate, {steps} step{'s' * (steps > 1)}: sxy", got["sxy"][-1], 1e-3 * (0.2 + 0.3 * (1 - np.exp(-2))), 1e-12)
    got = case.drive("gas", f"<Drive material='m'><Path>dt,steps,Lxx\n0.1,10,{np.log(0.5)!r}</Path></Drive>", "<Material Type='IdealGas' Name='m'><rho>1.2</rho><P0>1e5</P0><absolute>1</absolute></Material>")
    case.check("ideal gas at half its volume: pressure over P0", -got["sxx"][-1] / 1e5, 2**1.4, 1e-12)


def contact(case):
    law = "<Material Type='CoulombFriction' Name='m'><coeff>0.3</coeff></Material>"
    got = case.drive("friction", "<Drive contact='m'><Path>dt,steps,N,vt1,vt2\n0.1,5,100,0.3,-0.4\n0.1,1,50,-2,0</Path></Drive>", law)
    case.check("friction: traction along the sliding", got["St1"][5], 18, 1e-9)
    case.check("friction: traction across", got["St2"][5], -24, 1e-9)
    case.check("friction, turned round: traction", got["St1"][6], -15, 1e-9)
    case.check("friction: heat", got["dissipated"][5], 30 * 0.5 * 0.5, 1e-9)
    law = "<Material Type='AdhesiveFriction' Name='m'><coeff>0.3</coeff><kmu>0.05</kmu><Sa>20</Sa></Material>"
    got = case.drive("adhesive", "<Drive contact='m'><Path>dt,N,vt1\n0.1,100,2</Path></Drive>", law)
    case.check("cohesion and speed-dependent friction: traction", got["St1"][-1], 20 + (0.3 + 0.05 * 2) * 100, 1e-9)
    law = ("<Material Type='LiquidContact' Name='m'><coeff>50</coeff><LiquidPhase>2</LiquidPhase></Material>"
           "<Material Type='TaitLiquid' Name='oil'><rho>900</rho><K>1e9</K><viscosity>0.1</viscosity></Material>")
    got = case.drive("liquid", "<Drive contact='m'><Path>dt,N,vt1\n0.1,1,0.7</Path></Drive>", law)
    case.check("liquid on a wall: traction k eta v", got["St1"][-1], 50 * 0.1 * 0.7, 1e-9)


def run(case):
    elastic(case)
    rubber(case)
    fibrous(case)
    turning(case)
    cycles(case)
    triaxial, viscous = mohr_coulomb(case)
    others(case)
    contact(case)

    def draw(axes):
        axes.plot(-100 * triaxial["exx"], (triaxial["syy"] - triaxial["sxx"]) / 1e3, label="deviator [kPa]")
        axes.plot(-100 * triaxial["exx"], 1e4 * (triaxial["exx"] + triaxial["eyy"] + triaxial["ezz"]), label="volume strain [0.01 %]")
        axes.set(xlabel="axial strain [%]", title="Triaxial compression at 100 kPa: friction 35, dilation 5 degrees, cohesion 5 kPa")
        axes.title.set_fontsize(9)
        axes.legend()

    case.figure("driver_triaxial", draw)
