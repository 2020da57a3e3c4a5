# SPDX-License-Identifier: MIT
import numpy as np

import verify

ways = ("slip", "tractions", "states")
signs = np.array([-1, 1])  # sign of the shear force on the upper body, against the load along +x, and of the normal force
mu, radius, depth, lift, bend = 0.3, 1.0, 0.6, 0.003, 0.25


def faces(p, back, cell):
    """The upper face's particles from left to right: x at the start, how far they have slipped, state and traction.
    `back` turns vectors from the grid's axes to those of the bodies. Tractions are (q, p): shear traction against the
    tangential load, which acts along +x on the upper body, and pressure, which pushes the upper body upwards."""
    order = np.argsort(p["id"])
    u = p["displacement"][order][:, :2] @ back
    at = p["points"][order][:, :2] @ back - u
    y = at[:, 1] - lift
    height = (y - bend * at[:, 0] ** 2) / (1 - bend * at[:, 0] ** 2 / depth)
    below = (y + bend * at[:, 0] ** 2) / (1 - bend * at[:, 0] ** 2 / depth)
    rows = []
    for chosen in ((p["material"][order] == 1) & (height < 0.3 * cell), (p["material"][order] == 2) & (below > -0.3 * cell)):
        row = np.where(chosen)[0]
        rows.append(row[np.argsort(at[row, 0])])
    upper, lower = rows
    slip = u[upper, 0] - np.interp(at[upper, 0], at[lower, 0], u[lower, 0])
    return at[upper, 0], slip, p["contact_state"][order][upper], (p["contact_traction"][order][upper, :2] @ back) * signs


def exact_slip(x, c):
    """Slip of the faces outside of the stick zone: its slope is mu sqrt(x^2 - c^2)/R."""
    x = np.maximum(np.abs(x), c)
    root = np.sqrt(x * x - c * c)
    return mu / radius * 0.5 * (x * root - c * c * np.log((x + root) / c))


def stick_zone(x, slip, a, cell):
    """Half width c for which the exact slip is nearest to that of the faces, which may have any centre."""
    inside = np.abs(x) < 0.95 * a
    best = (np.inf, 0.0)
    for centre in np.arange(-1, 1.01, 0.1) * cell:
        for c in np.arange(0.02, 1, 0.005) * a:
            off = slip[inside] - exact_slip(x[inside] - centre, c)
            best = min(best, (((off - off.mean()) ** 2).sum(), c))
    return best[1]


def pull(case, angle):
    """Checks of a run turned by `angle`; the shares Q/(mu P) and c/a as found in the three ways."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    back = np.array([[c, -s], [s, c]])
    label = f"turned by {angle} degrees, " if angle else ""
    cell = 0.0125 if case.quick else 0.01
    entities = dict(c=repr(c), s=repr(s), h=str(cell)) | (dict(side="1.05") if angle else {}) | (dict(end="18.5") if case.quick else {})
    out = case.run(f"slip{angle}", entities=entities)
    h = verify.history(out)
    middles = verify.middles(h["time"])
    found, shear_shares, first = [], [], None
    for t, path in verify.vtp.collection(out):
        if t < 14.9:
            continue
        x, slip, state, traction = faces(verify.vtp.read(path), back, cell)
        Q, P = (np.array([np.interp(t, middles, h[f"contact{axis}:upper"]) for axis in "xy"]) @ back) * signs
        a = np.sqrt(8 * P * radius * 0.91 / np.pi)
        if first is None:
            first = slip
            if not case.quick:
                case.check(f"{label}half width of the contact, cells, falls short of 10 by", 10 - a / cell, 0, 0, "at most")
            if angle == 0:
                case.check("largest pressure that particles show", traction[:, 1].max(), 2 * P / (np.pi * a), 0.03)
            continue
        share = Q / (mu * P)
        if share < 0.1:
            continue
        shear_shares.append(traction[:, 0].sum() / traction[:, 1].sum() * P / Q)
        second = (traction * x[:, None] ** 2).sum(0) / traction.sum(0)  # moments of q and p; exact: q over p = 1 + (c/a)^2
        by_traction = np.sqrt(max(0.0, second[0] / second[1] - 1))
        spacing = np.diff(x).min()
        found.append((share, stick_zone(x, slip - first, a, cell) / a, by_traction, spacing * (state == 1).sum() / 2 / a))
    found = np.array(found)
    case.check(f"{label}shear over normal force from tractions of particles, over Q/P", np.mean(shear_shares), 1, 0.05)
    rising = found[: np.argmax(found[:, 0] > 0.95) if (found[:, 0] > 0.95).any() else len(found)]
    for share in (0.25,) if case.quick else (0.25, 0.5, 0.75):
        for k, way in enumerate(ways if angle == 0 else ways[:2]):
            case.check(f"{label}Q/(mu P) = {share}: c/a by {way}", np.interp(share, rising[:, 0], rising[:, 1 + k]), np.sqrt(1 - share), 0.1)
    if not case.quick:
        case.check(f"{label}largest Q/(mu P)", found[:, 0].max(), 0, 1 + 1e-6, "at most")
        case.check(f"{label}Q/(mu P) when all slips", found[-1, 0], 1, 0.03)
    return found


def ball(case):
    """The same between two spheres, half of which is modelled."""
    cell, depth, lift = 0.01, 0.3, 0.001
    out = case.run("ball", file="ball.xml")
    h = verify.history(out)
    middles = verify.middles(h["time"])
    found = []
    for t, path in verify.vtp.collection(out):
        if t < 7.4:
            continue
        p = verify.vtp.read(path)
        Q, P = signs * [2 * np.interp(t, middles, h[f"contact{axis}:upper"]) for axis in "xy"]
        a = (0.75 * P * radius * 2 * 0.91) ** (1 / 3)
        at = p["points"] - p["displacement"]
        square = at[:, 0] ** 2 + at[:, 2] ** 2
        height = (at[:, 1] - lift - bend * square) / (1 - bend * square / depth)
        row = (p["material"] == 1) & (height < 0.3 * cell) & (np.abs(at[:, 0]) < 0.16) & (at[:, 2] < 0.16)
        state, traction, square = p["contact_state"][row], p["contact_traction"][row, :2] * signs, square[row]
        if not found:
            case.check("spheres, radius of the contact, cells, falls short of 10 by", 10 - a / cell, 0, 0, "at most")
            case.check("spheres, largest pressure that particles show", traction[:, 1].max(), 1.5 * P / (np.pi * a**2), 0.03)
        second = (traction * square[:, None]).sum(0) / traction.sum(0)  # exact: their ratio is (1 - k^5)/(1 - k^3), k = c/a
        k = np.linspace(0, 0.9999, 5000)
        by_traction = np.interp(second[0] / second[1], (1 - k**5) / (1 - k**3), k)
        found.append((Q / (mu * P), by_traction, np.sqrt(2 * (state == 1).sum() / np.pi) * cell / 2 / a))
    found = np.array(found)
    rising = found[: np.argmax(found[:, 0] > 0.95) if (found[:, 0] > 0.95).any() else len(found)]
    for share in (0.25, 0.5, 0.75):
        for k, way in enumerate(ways[1:]):
            case.check(f"spheres, Q/(mu P) = {share}: c/a by {way}", np.interp(share, rising[:, 0], rising[:, 1 + k]), np.cbrt(1 - share), 0.1)
    case.check("spheres, largest Q/(mu P)", found[:, 0].max(), 0, 1 + 1e-6, "at most")


def run(case):
    found = pull(case, 0)
    if case.quick:
        return
    pull(case, 17)
    ball(case)

    def draw(axes):
        s = np.linspace(0, 1, 400)
        axes.plot(s, np.sqrt(1 - s), "k-", linewidth=0.8, label="Cattaneo, Mindlin")
        for k, (way, mark) in enumerate(zip(ways, "o+x")):
            axes.plot(found[:, 0], found[:, 1 + k], mark, markersize=4, label=f"by {way}")
        axes.set_xlabel("Q / (mu P)")
        axes.set_ylabel("c / a")
        axes.legend()

    case.figure("partial_slip", draw)
