# SPDX-License-Identifier: MIT
import numpy as np

import verify
import vtp

stress = 0.01


def run(case):
    transfers = dict(APIC="<Transfer type='APIC'/>", FMPM3="<Transfer type='FMPM' order='3'/>", FLIP="<Transfer type='FLIP'/>")
    for name, transfer in transfers.items() if not case.quick else [("APIC", transfers["APIC"])]:
        for D in (1, 10, 100, 1000) if not case.quick else (10,):
            for shift in (0, 0.9) if not case.quick else (0.9,):
                out = case.run(f"{name}_{D:g}_{shift}", entities=dict(law=f"<Dn>{D}</Dn><Dt>{D}</Dt>", shift=str(shift), at=str(-shift), last=str(49 - shift), first=str(-49 - shift),
                                                                     transfer=transfer, method="USAVG" if name == "FLIP" else "USL"))
                got = verify.history(out)
                strain = stress / 1000
                jump = got["dispx:b"][-1] - got["dispx:a"][-1] - 50 * (strain + 0.5 * strain**2)
                where = f"{name}, D = {D:g} MPa/mm, crack at {shift} mm in the cell"
                faces = vtp.read(str(vtp.collection(out)[-1][1]).replace("particles/run", "cracks/run").replace(".vtm", ".vtp"))
                case.check(f"{where}: opening of the faces", np.abs(faces["gap"]).mean(), stress / D, 1e-3)
                case.check(f"{where}: from the energy", np.sqrt(2 * got["Interface Energy"][-1] / (2.5 * D)), stress / D, 1e-3)
                case.check(f"{where}: elongation", jump + 0.1 * stress, stress / D + 0.1 * stress, 5e-4)
                case.check(f"{where}: traction on the faces", np.abs(faces["traction"][:, 0]).mean(), stress, 1e-3)
