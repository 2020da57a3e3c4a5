# SPDX-License-Identifier: MIT
import numpy as np

import verify
import vtp

RHO = 1000.0


def jet(case, transfer, kernel):
    """A jet of 5 m/s, one metre wide, along (4, 3); it leaves the grid at x = 10, 8.5 m/cos from the inlet."""
    name = f"jet, {transfer} {kernel}"
    out = case.run(f"jet_{transfer}_{kernel}", "jet.xml", entities=dict(transfer=transfer, kernel=kernel))
    p = vtp.read(vtp.collection(out)[-1][1])
    length = 8.5 / 0.8
    case.check(f"{name}: volume in the grid", p["volume"].sum(), length, 0.02)
    speed = p["velocity"][:, :2] @ np.array([0.8, 0.6])
    across = p["velocity"][:, :2] @ np.array([0.6, -0.8])
    case.check(f"{name}: largest error of a velocity", max(np.abs(speed - 5).max(), np.abs(across).max()) / 5, 0, 1e-3, "at most")
    case.check(f"{name}: largest change of a volume", np.abs(p["volume_ratio"] - 1).max(), 0, 1e-3, "at most")
    rows = verify.history(out)
    steady = rows["time"] > 2.5
    case.check(f"{name}: momentum along y of the steady jet", rows["py"][steady].mean(), RHO * length * 5 * 0.6, 0.01)
    ledger = verify.table(f"{out}/energy.csv")
    case.check(f"{name}: residual of the energy, of that of the jet", np.abs(ledger["residual"]).max() / (0.5 * RHO * length * 25), 0, 1e-3, "at most")


def tank(case, transfer, h):
    """Four square metres of water in a tank of four metres, of which the pipe takes a part."""
    name = f"tank, {transfer}, cells of {h} m"
    out = case.run(f"tank_{transfer}_{h}", "tank.xml", entities=dict(transfer=transfer, h=h))
    p = vtp.read(vtp.collection(out)[-1][1])
    row = 0.5 * h  # of particles, one square metre per metre
    x, y, pressure = p["points"][:, 0], p["points"][:, 1], p["pressure"]
    width = 4 - x[y < 0.8].min() + 0.5 * row  # the pipe is one metre high
    level = p["volume"].sum() / width
    case.check(f"{name}: volume", p["volume"].sum(), 4, row + 0.02, "absolute")
    case.check(f"{name}: height of the centre of mass", verify.history(out)["posy:water"][-1], level / 2, 0.02)
    away = x > 2  # from the pipe
    case.check(f"{name}: pressure at the floor", np.polyval(np.polyfit(y[away], pressure[away], 1), 0), RHO * 10 * level, 0.1)


def run(case):
    for transfer, kernel in (("APIC", "uGIMP"), ("FLIP", "quadratic")):
        jet(case, transfer, kernel)
    for transfer, h in (("APIC", 0.25),) if case.quick else (("APIC", 0.25), ("FMPM", 0.25), ("APIC", 0.125)):
        tank(case, transfer, h)
