import verify


def run(case):
    for kernel in ("uGIMP", "quadratic") if not case.quick else ("uGIMP",):
        l = verify.history(case.run(f"apic_{kernel}", entities=dict(kernel=kernel)))["Lpz"]
        case.check(f"{kernel}, APIC: drift of the angular momentum in a revolution", abs(l / l[0] - 1).max(), 0, 1e-4, "at most")
