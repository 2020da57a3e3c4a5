# SPDX-License-Identifier: MIT
import numpy as np

import verify
import vtp

stress = 0.01


def run(case):
    rows = []
    transfers = dict(APIC="<Transfer type='APIC'/>", FMPM3="<Transfer type='FMPM' order='3'/>", FLIP="<Transfer type='FLIP'/>")
    stiffness = (1, 10, 100, 1000, 1e4, 1e6) if not case.quick else (10,)
    for name, transfer in transfers.items() if not case.quick else [("APIC", transfers["APIC"])]:
        for D in stiffness:
            for shift in (0, 0.9) if not case.quick else (0.9,):
                out = case.run(f"{name}_{D:g}_{shift}", entities=dict(law=f"<Dn>{D}</Dn><Dt>{D}</Dt>", shift=str(shift), last=str(49 - shift), first=str(-49 - shift), transfer=transfer, method="USAVG" if name == "FLIP" else "USL"))
                got = verify.history(out)
                # the mean displacements differ by the jump and the stretch of half the bar
                strain = stress / 1000
                jump = got["dispx:b"][-1] - got["dispx:a"][-1] - 50 * (strain + 0.5 * strain**2)
                where = f"{name}, D = {D:g} MPa/mm, interface at {shift} mm in the cell"
                if D * 2.5 / 1000 <= 5:
                    # on the nodes: from the energy D A jump^2/2, which the stretch of the bars' ends does not disturb
                    case.check(f"{where}: jump", np.sqrt(2 * got["Interface Energy"][-1] / (2.5 * D)), stress / D, 1e-3)
                case.check(f"{where}: elongation", jump + 0.1 * stress, stress / D + 0.1 * stress, 5e-4)
                rows.append((name, D, shift, jump))
    if case.quick:
        return
    perfect = verify.history(case.run("perfect", entities=dict(law="<Dn>-1</Dn><Dt>-1</Dt>")))
    case.check("perfect interface: jump over the stretch of a cell", abs(perfect["dispx:b"][-1] - perfect["dispx:a"][-1] - 50 * stress / 1000) / (2.5 * stress / 1000), 0, 1e-2, "at most")
    # Morse: T(d) = stress on the rising branch
    peak, D = 0.0125, 1.0
    out = verify.history(case.run("morse", entities=dict(kind="NonlinearInterface", law=f"<Dnt>{D}</Dnt><Dt>1</Dt><normal_shape>1</normal_shape><Npeak>{peak}</Npeak>")))
    x = 0.5 * (1 + np.sqrt(1 - stress / peak))
    case.check("Morse interface below its peak: opening", out["dispx:b"][-1] - out["dispx:a"][-1] - 50 * stress / 1000, -np.log(x) / (D / (4 * peak)), 2e-3)

    # A smooth step with long top meets the interface: the transmitted stress rises as 1 - exp(-2 D t/Z)
    curves = []
    for name, transfer, tolerance in (("FMPM(3)", transfers["FMPM3"], 0.006), ("APIC", transfers["APIC"], 0.04)):
        for D in (5.0, 1.0):
            out = case.run(f"wave_{name}_{D:g}", "wave.xml", entities=dict(transfer=transfer, D=repr(D)))
            t, path = vtp.collection(out)[-1]
            data = vtp.read(path)
            right = data["material"] == 2
            x, v = data["points"][right, 0], data["velocity"][right, 0] / 2e-4
            order = np.argsort(x)
            x, v = x[order], v[order]
            exact = transmitted(t - x, D)
            case.check(f"{name}, D = {D:g}: mean error of the transmitted wave", np.abs(v - exact)[x < t].mean(), 0, tolerance, "at most")
            curves.append((name, D, x, v, exact))

    def draw(axes):
        for name, D, x, v, exact in curves:
            axes.plot(x, v, label=f"{name}, D = {D:g} E/L", linewidth=1)
        for name, D, x, v, exact in curves[:2]:
            axes.plot(x, exact, "k--", linewidth=0.8)
        axes.set_xlabel("x behind the interface")
        axes.set_ylabel("velocity / incoming velocity")
        axes.legend(fontsize=8)

    case.figure("interface_wave", draw)


def transmitted(arrival, D):
    """Exact wave behind the interface at the time `arrival` after the undelayed signal: response to the smooth step."""
    s = np.linspace(0, 8, 8001)  # time since the foot of the step (x = -1) came
    step = 0.5 - 0.5 * np.cos(np.pi * np.clip((s - 1) / 0.5, 0, 1))
    rate = 2 * D
    out = np.zeros_like(s)
    ds = s[1] - s[0]
    decay = np.exp(-rate * ds)
    for k in range(1, len(s)):  # out' = rate (step - out), exact for a linear step within ds
        slope = (step[k] - step[k - 1]) / ds
        out[k] = step[k] - slope / rate + (out[k - 1] - step[k - 1] + slope / rate) * decay
    return np.interp(arrival, s, out)
