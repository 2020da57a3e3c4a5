# SPDX-License-Identifier: MIT
import numpy as np

import verify
import vtp


def pull(case, what, law, per_area):
    out = case.run(what.replace(" ", "_"), entities=dict(law=law))
    last = {name: column[-1] for name, column in verify.energy(out).items()}
    taken = 4 * per_area
    case.check(f"{what}: energy the bond took [mJ]", last["contact"] + last["interface"], taken, 1e-4)
    rest = last["boundary_work"] - last["kinetic"] - last["elastic"] - last["damping"]
    case.check(f"{what}: energy put in and not left in the halves [mJ]", rest, taken, 2e-2)
    rows = [vtp.read(path) for _, path in vtp.collection(out, "joints")]
    stress = np.array([d["area"] @ d["normal_stress"] / d["area"].sum() for d in rows])
    opening = np.array([d["area"] @ d["opening"] / d["area"].sum() for d in rows])
    case.check(f"{what}: largest stress [MPa]", stress.max(), 1, 2e-2)
    case.check(f"{what}: energy stored in the end [mJ]", abs(last["interface"]), 0, 1e-12, "at most")
    return opening, stress


def traction_law(case):
    """The same bar in two materials with a traction law on their common face."""
    text = (case.folder / "case.xml").read_text()
    bond = text[text.index("  <Material Type='SpringNetwork'"):text.index("  <GridBCs>")]
    crack = "<CrackList lawname='bond'><Line xmin='0' ymin='10' xmax='4' ymax='10'/></CrackList>"
    solid = "<rho>1e-2</rho><E>1000</E><nu>0</nu>"
    law = "<sigmaI>1</sigmaI><JIc>0.02</JIc><kIe>500</kIe><alphaI>1.5</alphaI>"
    out = case.run("traction_law", replace={
        "<Rect xmin='0' xmax='4' ymin='0' ymax='20'/></Body>":
            "<Rect xmin='0' xmax='4' ymin='0' ymax='10'/></Body><Body matname='top'><Rect xmin='0' xmax='4' ymin='10' ymax='20'/></Body>",
        f"{solid}</Material>": f"{solid}<Friction lawname='bond' matname='top'/></Material><Material Type='LinearElastic' Name='top'>{solid}</Material>",
        bond: f"<Material Type='ExponentialTraction' Name='bond'>{law}{law.replace('I>', 'II>').replace('Ic>', 'IIc>').replace('Ie>', 'IIe>')}</Material>\n",
        crack: "",
        "</MPMHeader>": "<MultiMaterialMode/><GlobalArchive type='Decohesion'/></MPMHeader>"})
    case.check("traction law between two materials: energy of the zone [mJ]", verify.history(out)["Decohesion"][-1], 4 * 0.02, 1e-6)
    last = {name: column[-1] for name, column in verify.energy(out).items()}
    rest = last["boundary_work"] - last["kinetic"] - last["elastic"] - last["damping"]
    case.check("the same from the work of the grips [mJ]", rest, 4 * 0.02, 2e-2)


def run(case):
    traction_law(case)
    linear = pull(case, "linear", "<sn_tendc>4e-2</sn_tendc>", (0.002 + 0.04) / 2)
    if case.quick:
        return
    # from the elastic limit at 0.002 mm: 0.5 of the strength after 0.02 mm, nothing after 0.05 mm
    table = pull(case, "by a table", "<sn_tentab>1 0 0.5 0.02 0 0.05</sn_tentab>", 0.001 + 0.75 * 0.02 + 0.25 * 0.03)

    def draw(axes):
        for (opening, stress), what in ((linear, "linear"), (table, "by a table")):
            axes.plot(opening, stress, ".-", label=what)
        axes.set_xlim(-0.002, 0.06)
        axes.set_xlabel("opening [mm]")
        axes.set_ylabel("stress [MPa]")
        axes.legend()

    case.figure("joint_bar", draw)
