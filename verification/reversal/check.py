# SPDX-License-Identifier: MIT
import verify

E, tangent, limit, most = 1000.0, 200.0, 1.0, 1.5
plastic = (most - limit) * (1 / tangent - 1 / E)


def run(case):
    rows = verify.history(case.run("reverse"))
    peak = rows["sxx"].argmax()
    case.check("largest stress", rows["sxx"][peak], most, 0.01)
    case.check("strain at the largest stress", rows["exx"][peak], most / E + plastic, 0.02)
    case.check("end of the run over the time of the reversal", rows["time"][-1] / rows["time"][peak], 2, 0.02)
    case.check("stress at the end over the largest", abs(rows["sxx"][-1]) / most, 0, 0.02, "at most")
    case.check("strain that remains", rows["exx"][-1], plastic, 0.02)
    case.check("plastic strain at the end", rows["exxp"][-1], plastic, 0.02)
    ways = {"</Schedule>": "<Parameter name='hold'>20</Parameter><Parameter name='minValue'>0.5</Parameter></Schedule>"}
    rows = verify.history(case.run("held", replace=ways))
    first = rows["time"][(rows["sxx"] >= most).argmax()]
    held = (rows["time"] > first) & (rows["time"] < first + 20)
    case.check("held before it goes back: stress", rows["sxx"][held].mean(), most, 0.01)
    case.check("held before it goes back: stress at the end of the run", rows["sxx"][-1], 0.5, 0.02)
    case.check("held before it goes back: time to the end / time to the peak", (rows["time"][-1] - first - 20) / first, 1 - 0.5 / most, 0.02)
    if case.quick:
        return
    rows = verify.history(case.run("hold", entities=dict(style=1)))
    case.check("held: stress at the end", rows["sxx"][-1], most, 0.01)
    rows = verify.history(case.run("stop", entities=dict(style=3)))
    case.check("stopped: stress at the end", rows["sxx"][-1], most, 0.01)
