# SPDX-License-Identifier: MIT
import itertools

import numpy as np

import verify
import vtp


def line(x1, y1, x2, y2):
    return f"<CrackList lawname='joint'><Line xmin='{x1}' ymin='{y1}' xmax='{x2}' ymax='{y2}'/></CrackList>"


lines = {
    "one line": line(0, 10, 40, 10),
    "three lines, one of them drawn backwards": line(0, 10, 13, 10) + line(26, 10, 13, 10) + line(26, 10, 40, 10),
    "a line beyond the walls": line(-0.25, 10, 40.25, 10),
}
transfers = {"FLIP": "<Transfer type='FLIP'/>", "APIC": "<Transfer type='APIC'/>", "FMPM(2)": "<Transfer type='FMPM' order='2'/>"}


def run(case):
    rows = list(itertools.product(lines, ("USL", "USAVG"), transfers, ("uGIMP", "quadratic", "lCPDI")))
    if case.quick:
        rows = [("one line", "USAVG", "FMPM(2)", "quadratic"), ("three lines, one of them drawn backwards", "USL", "APIC", "uGIMP")]
    for number, (name, method, transfer, kernel) in enumerate(rows):
        out = case.run(f"run{number}", entities=dict(cracks=lines[name], method=method, transfer=transfers[transfer], kernel=kernel))
        joints = vtp.read(vtp.collection(out, "joints")[-1][1])
        label = f"{name}, {transfer}, {method}, {kernel}"
        case.check(f"{label}: largest error of the opening [mm]", np.abs(joints["opening"] + 0.01).max(), 0, 2e-4, "at most")
        case.check(f"{label}: shear stress over normal stress, largest", np.abs(joints["traction"][:, 0]).max() / 0.2, 0, 0.01, "at most")
        e = verify.energy(out)
        case.check(f"{label}: residual of the energy over the work", np.abs(e["residual"]).max() / e["external_work"].max(), 0, 2e-3, "at most")
