import numpy as np

import verify

p, ratio, cell = 1e4, 0.3 / 0.7, 0.1


def run(case):
    for impulses in ("nodes", "faces"):
        for seam, level in (("1", "1"), ("1.05", "1.05"))[1 if case.quick else 0 :]:
            if case.quick and impulses == "faces":
                continue
            out = case.run(f"{impulses}{seam}", entities=dict(impulses=impulses, seam=seam, level=level))
            data, last = verify.last_particles(out), {q: v[-1] for q, v in verify.history(out).items()}
            where = f"{impulses}, T at ({seam}, {level})"
            error = np.hypot(data["stress"][:, 1] / p + 1, data["stress"][:, 0] / p + ratio)
            near = np.hypot(data["points"][:, 0] - float(seam), data["points"][:, 1] - float(level)) < 2.5 * cell
            case.check(f"{where}: error of the stress (RMS) over p", np.sqrt((error**2).mean()), 0, 0.01, "at most")
            case.check(f"{where}: the same next to the T", np.sqrt((error[near] ** 2).mean()), 0, 0.03, "at most")
            case.check(f"{where}: drift over the cell", max(abs(last[f"dispx:{b}"]) for b in ("left", "right", "top")) / cell, 0, 1e-3, "at most")
            case.check(f"{where}: force on the upper block over p A", last["contacty:top"] / (2 * p), 1, 1e-3)
            case.check(f"{where}: force across the seam over that of the stress", -last["contactx:left"] / (ratio * p * float(level)), 1, 0.01)
