# SPDX-License-Identifier: MIT
import numpy as np

import verify
import vtp

FMPM4 = "<Transfer type='FMPM' order='4'/>"
schemes = {"FMPM(2)": "<Transfer type='FMPM' order='2'/><SkipPostExtrapolation/>", "FMPM(4)": FMPM4 + "<SkipPostExtrapolation/>",
           "FLIP": "<Transfer type='FLIP'/><SkipPostExtrapolation/>", "APIC": "<Transfer type='APIC'/>"}


def stress_at_support(case, name):
    times, stresses = [], []
    for t, path in vtp.collection(case.run(name, replace={FMPM4: schemes[name]})):
        data = vtp.read(path)
        stresses.append(data["stress"][data["points"][:, 0] < 0.01, 0].mean() / 1e-4)
        times.append(t)
    return np.array(times), np.array(stresses)


def run(case):
    curves = {name: stress_at_support(case, name) for name in (schemes if not case.quick else ["FMPM(2)"])}
    times, stress = curves["FMPM(2)"]
    plateau = stress[(times > 1.3) & (times < 2.7)]
    case.check("FMPM(2): overshoot", -stress.min() / 2 - 1, 0, 0.1, "at most")
    case.check("FMPM(2): stress at the support, mean between 1.3 and 2.7", plateau.mean(), -2, 5e-3)
    case.check("FMPM(2): stress before the wave arrives", abs(stress[times < 0.8]).max(), 0, 1e-2, "at most")
    if not case.quick:
        case.check("FLIP: overshoot", -curves["FLIP"][1].min() / 2 - 1, 0, 0.4, "at most")

    def draw(axes):
        for name, (t, s) in curves.items():
            axes.plot(t, s, label=name, linewidth=1)
        axes.plot([0, 1, 1, 2.9], [0, 0, -2, -2], "k--", linewidth=0.8, label="exact")
        axes.set_xlabel("time")
        axes.set_ylabel("stress at the support / pressure")
        axes.legend(fontsize=8)

    case.figure("step_bar", draw)
