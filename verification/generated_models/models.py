# SPDX-License-Identifier: MIT
"""Random models of bodies in contact. `models.py N` prints the command file of the N-th."""

import sys

import numpy as np

transfers = {"FLIP": "<Transfer type='FLIP'/>", "FLIP 0.99": "<Transfer type='blend' fraction='0.99'/>", "APIC": "<Transfer type='APIC'/>",
             "FMPM(2)": "<Transfer type='FMPM' order='2'/>", "FMPM(4)": "<Transfer type='FMPM' order='4'/>", "XPIC(2)": "<Transfer type='XPIC' order='2'/>"}
orders = {"USL+": ("USL", ""), "USL-": ("USL", "<SkipPostExtrapolation/>"), "USAVG+": ("USAVG", ""),
          "USAVG-": ("USAVG", "<SkipPostExtrapolation/>"), "USF": ("USF", "<SkipPostExtrapolation/>")}
kernels = ("quadratic", "uGIMP", "cubic", "lCPDI")
h = 0.25


def law(random):
    """Words and definition of a contact law for bodies of stiffness 1."""
    number = lambda low, high: 10 ** random.uniform(np.log10(low), np.log10(high))
    kind = random.choice(["Coulomb", "adhesive", "linear", "linear", "one-sided", "Morse", "bilinear", "bonded"])
    if kind == "Coulomb":
        mu = random.uniform(0, 1)
        return f"friction {mu:.2f}", f"<Material Type='CoulombFriction' Name='law'><coeff>{mu}</coeff></Material>"
    if kind == "adhesive":
        text = f"<coeff>{random.uniform(0, 0.6)}</coeff><Sa>{number(1e-4, 1e-2)}</Sa><Na>{number(1e-4, 1e-2)}</Na>"
        return "adhesion", f"<Material Type='AdhesiveFriction' Name='law'>{text}</Material>"
    if kind == "linear":
        n, t = number(0.05, 500), number(0.05, 500)
        return f"linear interface {n:.2g}, {t:.2g}", f"<Material Type='LinearInterface' Name='law'><Dn>{n}</Dn><Dt>{t}</Dt></Material>"
    if kind == "one-sided":
        n, c, t = number(0.05, 50), random.choice([-1, number(1, 500)]), random.choice([0, number(0.05, 50)])
        return (f"interface {n:.2g} open, {c:.2g} closed, {t:.2g}",
                f"<Material Type='LinearInterface' Name='law'><Dnt>{n}</Dnt><Dnc>{c}</Dnc><Dt>{t}</Dt></Material>")
    if kind == "bonded":
        n, t = random.permutation([-1.0, random.choice([-1.0, number(0.05, 50)])])
        return f"interface {n:.2g}, {t:.2g} (negative: bonded)", f"<Material Type='LinearInterface' Name='law'><Dn>{n}</Dn><Dt>{t}</Dt></Material>"
    n, t, peak = number(0.2, 50), number(0.2, 50), number(1e-3, 3e-2)
    shape, more = (1, "") if kind == "Morse" else (2, f"<Nbreak>{4 * peak / n}</Nbreak><Tbreak>{4 * peak / t}</Tbreak>")
    return (f"{kind} interface {n:.2g}, {t:.2g}, peak {peak:.2g}",
            f"<Material Type='NonlinearInterface' Name='law'><Dnt>{n}</Dnt><Dt>{t}</Dt><normal_shape>{shape}</normal_shape>"
            f"<tangential_shape>{shape}</tangential_shape><Npeak>{peak}</Npeak><Tpeak>{peak}</Tpeak>{more}</Material>")


def polygon(random, centre, size, angle):
    corners = int(random.integers(3, 7))
    turns = 2 * np.pi * (np.arange(corners) + random.uniform(-0.2, 0.2, corners)) / corners + angle
    points = "".join(f"<pt x='{centre[0] + size * np.cos(a)}' y='{centre[1] + size * np.sin(a)}'/>" for a in turns)
    return f"<Polygon>{points}</Polygon>"


def bodies_in_plane(random, count, axisymmetric):
    """Bodies in a row, with gaps or touching, that fly towards the middle."""
    parts, x = [], 1.0
    for k in range(count):
        size = random.uniform(0.8, 1.5)
        y = 2.5 + random.uniform(-0.5, 0.5)
        vx, vy = random.uniform(0.005, 0.05) * (1 if k < count / 2 else -1), random.uniform(-0.02, 0.02)
        kind = random.choice(["rect", "rect", "polygon", "disc"])
        low, high = x, x + 2 * size
        if kind == "rect" or axisymmetric:
            shape = f"<Rect xmin='{low}' xmax='{high}' ymin='{y - size}' ymax='{y + size}'/>"
        elif kind == "disc":
            shape = f"<Oval xmin='{low}' xmax='{high}' ymin='{y - size}' ymax='{y + size}'/>"
        else:
            shape = polygon(random, (low + size, y), size, random.uniform(0, 2 * np.pi))
        if axisymmetric:
            vx, vy = 0.0, 0.0
        parts.append((shape, vx, vy, 0.0))
        x = high + random.choice([0.0, 0.0, 0.5 * h, random.uniform(0, h)])
    if axisymmetric:  # discs and rings on top of each other
        parts, y = [], 0.5
        for k in range(count):
            height, inner = random.uniform(0.8, 1.5), random.choice([0.0, random.uniform(0.3, 0.8)])
            shape = f"<Rect xmin='{inner}' xmax='{random.uniform(1.5, 3)}' ymin='{y}' ymax='{y + height}'/>"
            parts.append((shape, 0.0, random.uniform(0.005, 0.05) * (1 if k < count / 2 else -1), 0.0))
            y += height + random.choice([0.0, 0.0, 0.5 * h, random.uniform(0, h)])
    return parts


def bodies_in_space(random, count):
    parts, x = [], 1.0
    for k in range(count):
        size = random.uniform(0.5, 0.8)
        y, z = 1.5 + random.uniform(-0.2, 0.2, 2)
        box = f"xmin='{x}' xmax='{x + 2 * size}' ymin='{y - size}' ymax='{y + size}' zmin='{z - size}' zmax='{z + size}'"
        sign = 1 if k < count / 2 else -1
        parts.append((f"<{random.choice(['Box', 'Sphere'])} {box}/>", sign * random.uniform(0.005, 0.05), *random.uniform(-0.02, 0.02, 2)))
        x += 2 * size + random.choice([0.0, 0.0, 0.5 * h, random.uniform(0, h)])
    return parts


def model(number):
    """Words, options and command file of a model."""
    random = np.random.default_rng(number)
    analysis = str(random.choice(["plane strain", "plane strain", "plane stress", "axisymmetric", "space"]))
    axisymmetric, space = analysis == "axisymmetric", analysis == "space"
    count = int(random.integers(2, 4 if space else 5))
    transfer, order, kernel = (str(random.choice(list(options))) for options in (transfers, orders, kernels))
    words, text = law(random)
    parts = bodies_in_space(random, count) if space else bodies_in_plane(random, count, axisymmetric)
    impulses = "faces" if "friction" in words and random.random() < 0.3 else "nodes"
    method, skip = orders[order]
    grid = ("<Grid xmin='0' xmax='6' ymin='0' ymax='3' zmin='0' zmax='3'>" if space
            else "<Grid xmin='0' xmax='4' ymin='-2' ymax='10'>" if axisymmetric else "<Grid xmin='-1' xmax='15' ymin='-1' ymax='6'>")
    cells = f"<Horiz cellsize='{h}'/><Vert cellsize='{h}'/>" + (f"<Depth cellsize='{h}'/>" if space else "")
    bodies = "".join(f"<Body matname='m{k}' vx='{vx}' vy='{vy}'" + (f" vz='{vz}'" if space else "") + f">{shape}</Body>"
                     for k, (shape, vx, vy, vz) in enumerate(parts))
    materials = "".join(f"<Material Type='LinearElastic' Name='m{k}'><rho>1</rho><E>{10 ** random.uniform(-0.5, 0.5)}</E><nu>{random.uniform(0, 0.4)}</nu></Material>"
                        for k in range(count))
    code = {"plane strain": 10, "plane stress": 11, "axisymmetric": 13, "space": 12}[analysis]
    end = 6 if space else 16
    deck = f"""<?xml version='1.0'?>
<JANFEAInput version='3'>
  <Header><Description>Generated model {number}</Description><Analysis>{code}</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader><MPMMethod>{method}</MPMMethod>{skip}<GIMP type='{kernel}'/>{transfers[transfer]}
    <TimeFactor>0.4</TimeFactor><MaxTime>{end}</MaxTime><ArchiveTime>{end}</ArchiveTime><GlobalArchiveTime>0.05</GlobalArchiveTime>
    <MultiMaterialMode Impulses='{impulses}'><Friction lawname='law'/></MultiMaterialMode></MPMHeader>
  <Mesh>{grid}{cells}</Grid></Mesh>
  <MaterialPoints>{bodies}</MaterialPoints>
  {materials}{text}
</JANFEAInput>
"""
    return dict(number=number, analysis=analysis, count=count, transfer=transfer, order=order, kernel=kernel, law=words, impulses=impulses), deck


if __name__ == "__main__":
    print(model(int(sys.argv[1]))[1])
