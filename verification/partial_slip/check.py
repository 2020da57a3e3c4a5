import numpy as np

import verify


def run(case):
    if case.quick:
        return
    mu, cell = 0.3, 0.0125
    out = case.run("slip")
    h = verify.history(out)
    shares, widths, shown = [], [], []
    for t, path in verify.vtp.collection(out):
        if t < 15.5:
            continue
        p = verify.vtp.read(path)
        X = p["points"] - p["displacement"]
        row = (p["material"] == 2) & (X[:, 1] - 0.5 * X[:, 0] ** 2 * (1 - X[:, 1] / 0.6) < 0.6 * cell)
        P, Q = (abs(np.interp(t, h["time"], h[f"contact{axis}:cylinder"])) for axis in "yx")
        a = np.sqrt(8 * P * 0.91 / np.pi)
        columns = np.unique(np.round(X[row, 0], 9))
        spacing = np.diff(columns).min()
        sticks = row & (p["contact_state"] == 1)
        shares.append(Q / (mu * P))
        widths.append(spacing * len(np.unique(np.round(X[sticks, 0], 9))) / 2 / a)
        shown.append(a / cell)
    shares, widths = np.array(shares), np.array(widths)
    case.check("half width of the contact over the cell falls short of 10 by", 10 - min(shown), 0, 0, "at most")
    rising = slice(0, np.argmax(widths == 0) + 1)
    for share in (0.25, 0.5, 0.75):
        case.check(f"Q/(mu P) = {share}: c/a", np.interp(share, shares[rising], widths[rising]), np.sqrt(1 - share), 0.1)
    case.check("largest Q/(mu P)", shares.max(), 0, 1 + 1e-6, "at most")
    case.check("Q/(mu P) when all slips", shares[np.argmax(widths == 0)], 1, 0.02)

    def draw(axes):
        axes.plot(shares, widths, ".", label="Tribo")
        s = np.linspace(0, 1, 200)
        axes.plot(s, np.sqrt(1 - s), "k--", linewidth=0.8, label="Cattaneo, Mindlin")
        axes.set_xlabel("Q / (mu P)")
        axes.set_ylabel("c / a")
        axes.legend(fontsize=8)

    case.figure("partial_slip", draw)
