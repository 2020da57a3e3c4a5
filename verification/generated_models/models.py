# SPDX-License-Identifier: MIT
"""Random models of bodies in contact. `models.py N` prints the command file of the N-th, `models.py N --thin` that of the N-th with a thin plate."""

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


def turned(centre, angle, x, y):
    """A point of a body that is turned about its centre."""
    c, s = np.cos(angle), np.sin(angle)
    return centre[0] + c * x - s * y, centre[1] + s * x + c * y


def turned_rectangle(centre, angle, width, height):
    corners = [turned(centre, angle, sx * width / 2, sy * height / 2) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return "<Polygon>" + "".join(f"<pt x='{x:.9g}' y='{y:.9g}'/>" for x, y in corners) + "</Polygon>"


def thin_model(number):
    """Words, options and command file of a plate of one to three cells, at any angle, that another body hits. Cells of 1."""
    random = np.random.default_rng([number, 1])
    kernel = str(random.choice(["uGIMP", "uGIMP", "quadratic", "lCPDI"]))
    transfer = str(random.choice(["FLIP", "FLIP", "APIC", "FMPM(2)"]))
    order = str(random.choice(["USL+", "USAVG+"]))
    thickness, length = random.choice([1, 1.5, 2, 3]), random.choice([6, 10, 14])
    angle = np.radians(random.choice([0, 0, 17, 45, random.uniform(0, 90)]))
    friction, speed, gap = random.choice([0, 0.3, 0.8]), random.uniform(0.005, 0.03), random.choice([0, 0.3])
    impulses = str(random.choice(["chosen", "chosen", "faces"]))
    other, third = str(random.choice(["block", "disc", "plate"])), random.random() < 0.3
    centre = np.array([15, 15 + random.uniform(-0.5, 0.5)])
    width, height = {"block": (5, 4), "disc": (6, 6), "plate": (8, 2)}[other]
    there = turned(centre, angle, random.uniform(-length / 3, length / 3), thickness / 2 + height / 2 + gap)
    if other == "disc":
        shape = f"<Oval xmin='{there[0] - 3:.9g}' xmax='{there[0] + 3:.9g}' ymin='{there[1] - 3:.9g}' ymax='{there[1] + 3:.9g}'/>"
    else:
        shape = turned_rectangle(there, angle, width, height)
    course = angle - np.pi / 2 + random.uniform(-0.7, 0.7)
    bodies = f"<Body matname='plate'>{turned_rectangle(centre, angle, length, thickness)}</Body>"
    bodies += f"<Body matname='other' vx='{speed * np.cos(course):.6g}' vy='{speed * np.sin(course):.6g}'>{shape}</Body>"
    moduli = {"plate": 1, "other": random.choice([1, 1, 0.1, 10])}
    if third:
        bodies += f"<Body matname='third'>{turned_rectangle(turned(centre, angle, 0, -thickness / 2 - 2), angle, 8, 4)}</Body>"
        moduli["third"] = 1
    materials = "".join(f"<Material Type='LinearElastic' Name='{name}'><rho>1</rho><E>{E}</E><nu>0.3</nu></Material>" for name, E in moduli.items())
    attribute = "" if impulses == "chosen" else f" Impulses='{impulses}'"
    method, skip = orders[order]
    deck = f"""<?xml version='1.0'?>
<JANFEAInput version='3'>
  <Header><Description>Generated thin model {number}</Description><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader><MPMMethod>{method}</MPMMethod>{skip}<GIMP type='{kernel}'/>{transfers[transfer]}<MatlPtsPerElement>{random.choice([4, 4, 16])}</MatlPtsPerElement>
    <TimeFactor>0.4</TimeFactor><MaxTime>60</MaxTime><ArchiveTime>60</ArchiveTime><GlobalArchiveTime>0.5</GlobalArchiveTime>
    <MultiMaterialMode{attribute}><Friction lawname='law'/></MultiMaterialMode></MPMHeader>
  <Mesh><Grid xmin='0' xmax='30' ymin='0' ymax='30'><Horiz cellsize='1'/><Vert cellsize='1'/></Grid></Mesh>
  <MaterialPoints>{bodies}</MaterialPoints>
  {materials}<Material Type='CoulombFriction' Name='law'><coeff>{friction}</coeff></Material>
</JANFEAInput>
"""
    return dict(number=number, analysis="plane strain", transfer=transfer, order=order, kernel=kernel, law=f"friction {friction}", impulses=impulses), deck


if __name__ == "__main__":
    print((thin_model if "--thin" in sys.argv else model)(int(sys.argv[1]))[1])
