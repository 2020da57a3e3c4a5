# SPDX-License-Identifier: MIT
import numpy as np

from verify import history

B, H, DAMPING, END = 12.0, 8.0, 3.0, 4.0
UPDATES = {
    "USL-": "<MPMMethod>USL</MPMMethod><SkipPostExtrapolation/>",
    "USL+": "<MPMMethod>USL</MPMMethod>",
    "USAVG-": "<MPMMethod>USAVG</MPMMethod><SkipPostExtrapolation/>",
    "USAVG+": "<MPMMethod>USAVG</MPMMethod>",
}
TRANSFERS = {"FLIP": "type='FLIP'", "APIC": "type='APIC'", "FMPM(2)": "type='FMPM' order='2'", "FMPM(4)": "type='FMPM' order='4'"}


def tipped(ax=2.0, ay=-1.0, steps=4000):
    """Displacement of the centre of a rigid block that turns about its lower right corner (fourth order Runge-Kutta)."""
    def centre(angle):
        return -B / 2 * np.cos(angle) + H / 2 * np.sin(angle), H / 2 * np.cos(angle) + B / 2 * np.sin(angle)

    def rate(t, state):
        x, y = centre(state[0])
        return np.array([state[1], t * (ax * y - ay * x) / ((B * B + H * H) / 3) - DAMPING * state[1]])

    state, dt = np.zeros(2), END / steps
    for k in range(steps):
        t = k * dt
        a = rate(t, state)
        b = rate(t + dt / 2, state + dt / 2 * a)
        c = rate(t + dt / 2, state + dt / 2 * b)
        d = rate(t + dt, state + dt * c)
        state = state + dt / 6 * (a + 2 * b + 2 * c + d)
    x, y = centre(state[0])
    return x + B / 2, y - H / 2


def run(case):
    def last(name, transfer, update, **entities):
        out = case.run(name, entities=dict(transfer=f"<Transfer {TRANSFERS[transfer]}/>", update=UPDATES[update], **entities))
        h = history(out)
        return h["dispx:block"][-1], h["dispy:block"][-1]

    x, y = tipped()
    rows = []
    for kernel, label in (("quadratic", "splines"), ("uGIMP", "uGIMP"), ("lCPDI", "lCPDI")):
        for transfer in ("FLIP", "APIC", "FMPM(4)", "FMPM(2)"):
            for update in ("USL-",) if case.quick else ("USL-", "USL+", "USAVG+"):
                if case.quick and transfer.startswith("FMPM"):
                    continue
                dx, dy = last(f"tip_{label}_{transfer[:4]}{transfer[5:6]}_{update}", transfer, update, kernel=kernel)
                if transfer.startswith("FMPM"):
                    rows.append([label, transfer, update, f"{dx / x:.3f}", f"{dy / y:.3f}"])
                    continue
                case.check(f"{label}, {transfer}, {update}: horizontal displacement", dx, x, 0.06)
                case.check(f"{label}, {transfer}, {update}: vertical displacement", dy, y, 0.06)
        if case.quick:
            break
    if rows:
        case.table("The same with FMPM: displacement over that of a rigid block", ["shape functions", "transfer", "update", "horizontal", "vertical"], rows)

    def glue(strength):
        return f"<Material Type='AdhesiveFriction' Name='law'><coeff>0.3</coeff><Na>{strength}</Na><Sa>{1.5 * strength}</Sa></Material>"

    pull = dict(ax="0", ay="4.27")
    for transfer in ("FLIP",) if case.quick else ("FLIP", "APIC", "FMPM(2)"):
        name = f"glued_{transfer[:4]}"
        _, first = last(f"{name}_strong_USL-", transfer, "USL-", law=glue(100), **pull)
        for update in ("USL-", "USL+") if case.quick else UPDATES:
            if update != "USL-":
                _, dy = last(f"{name}_strong_{update}", transfer, update, law=glue(100), **pull)
                case.check(f"glued, {transfer}: elongation with {update} over that with USL-", dy / first, 1.0, 0.01)
            _, dy = last(f"{name}_{update}", transfer, update, law=glue(0.2), **pull)
            case.check(f"glued, {transfer}, {update}, 82 % of the strength: elongation over that without limit", dy / first, 1.0, 0.12)

    # 2 mm high and sheared without pressure: u = rho a (h y - y^2/2)/G, with the mean rho a h^2/(3 G)
    shear = dict(ax="5", ay="0", height="2", law=glue(100))
    mean = 1.2e-3 * 5 * END * 2.0**2 / (3 * 600 / 2.6)
    for kernel, label in (("uGIMP", "uGIMP"),) if case.quick else (("uGIMP", "uGIMP"), ("quadratic", "splines")):
        for transfer in ("FLIP",) if case.quick else ("FLIP", "APIC", "FMPM(4)"):
            for update in ("USL-", "USL+"):
                dx, _ = last(f"sheared_{label}_{transfer[:4]}_{update}", transfer, update, kernel=kernel, **shear)
                case.check(f"glued and sheared, {label}, {transfer}, {update}: mean displacement", dx, mean, 0.15)
