# SPDX-License-Identifier: MIT
import numpy as np

import verify


def chosen(case, faces):
    """Without a word in the command file the program takes faces, since the block lies between rigid faces."""
    out = case.run("chosen", entities=dict(contact="<MultiMaterialMode/>"))
    stress = [verify.last_particles(folder)["stress"] for folder in (out, faces)]
    case.check("impulses chosen by the program: largest difference of the stress from that with impulses on faces", np.abs(stress[0] - stress[1]).max(), 0, 0, "at most")


def squeeze(case, angle):
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    label = f"turned by {angle} degrees: " if angle else ""
    entities = dict(c=repr(c), s=repr(s), left="-12.5", low="-6", high="13", kernel="quadratic") if angle else {}
    least, spread = (0.0195, 0.05) if angle else (0.0205, 0.03)
    folder = case.run(f"platens{angle}", entities=entities)
    p = verify.last_particles(folder)
    block = p["von_mises"] > 0
    back = np.array([[c, -s], [s, c]])
    X, u = ((p["points"] - p["displacement"])[block][:, :2] @ back), p["displacement"][block][:, :2] @ back
    rows = np.unique(np.round(X[:, 1], 6))
    wider = np.array([np.ptp(u[np.abs(X[:, 1] - y) < 1e-5, 0]) / np.ptp(X[np.abs(X[:, 1] - y) < 1e-5, 0]) for y in rows])
    out = 5 * wider  # of the surface, by the strain
    strain = -np.log(1 - 0.01)  # the law is linear in the logarithmic strain
    exact = 5 * (np.exp(0.3 / 0.7 * strain) - 1)
    case.check(f"{label}displacement of the edge next to the lower platen falls short of {least} by", least - out[0], 0, 0, "at most")
    case.check(f"{label}next to the upper platen", least - out[-1], 0, 0, "at most")
    case.check(f"{label}displacement of the edge in the middle", out[len(out) // 2], exact, 0.01)
    tensor = p["stress"][block]
    stress = s * s * tensor[:, 0] + c * c * tensor[:, 1] - 2 * s * c * tensor[:, 3]
    case.check(f"{label}mean stress", stress.mean(), -100 * strain / 0.91, 0.005)
    case.check(f"{label}spread of the stress (RMS)", np.std(stress / stress.mean()), 0, spread, "at most")
    return folder


def cracked(case):
    """A closed horizontal crack without friction inside the block changes nothing."""
    crack = "<CrackList><Line xmin='-2.1' xmax='2.9' ymin='5.1' ymax='5.1'/></CrackList>"
    folder = case.run("cracked", entities=dict(contact="<MultiMaterialMode/>", crack=crack))
    p = verify.last_particles(folder)
    block = p["von_mises"] > 0
    strain = -np.log(1 - 0.01)
    exact = -100 * strain / 0.91
    case.check("with a crack inside: mean stress", p["stress"][block][:, 1].mean(), exact, 0.005)
    case.check("with a crack inside: spread of the stress (RMS)", np.std(p["stress"][block][:, 1] / exact), 0, 0.03, "at most")
    width = 10 * np.exp(0.3 / 0.7 * strain)
    case.check("with a crack inside: force on the upper platen", verify.history(folder)["contacty:top"][-1], -exact * width, 0.005)


def run(case):
    chosen(case, squeeze(case, 0))
    cracked(case)
    for angle in (17, 45) if not case.quick else ():
        squeeze(case, angle)
