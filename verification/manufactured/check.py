import math

import numpy as np

import verify
import vtp

transfer = {"FMPM": "<Transfer type='FMPM' order='4'/>", "FLIP": "<Transfer type='FLIP'/>"}


def axis_aligned(x, t):
    s = 0.05 * math.sin(100 * math.pi * t)
    return np.stack([s * np.sin(2 * math.pi * x[:, 0]), -s * np.sin(2 * math.pi * x[:, 1])], axis=1)


def error_of(out, exact):
    """Largest over the written times of the L2 error of displacement, relative to the largest L2 displacement."""
    worst = size = 0.0
    for t, path in vtp.collection(out):
        data = vtp.read(path)
        u = data["displacement"][:, :2]
        wanted = exact(data["points"][:, :2] - u, t)
        worst = max(worst, np.sqrt(((u - wanted) ** 2).sum(axis=1).mean()))
        size = max(size, np.sqrt((wanted**2).sum(axis=1).mean()))
    return worst / size


def vortex(amplitude):
    def exact(x, t):
        r = np.hypot(x[:, 0], x[:, 1])
        angle = amplitude * (1 - math.cos(2 * math.pi * t)) / 2 * (abs(r - 1) < 0.25) * (1 - 16 * (r - 1) ** 2) ** 2
        c, s = np.cos(angle), np.sin(angle)
        return np.stack([c * x[:, 0] - s * x[:, 1], s * x[:, 0] + c * x[:, 1]], axis=1) - x

    return exact


def ring(x, t):
    r = np.hypot(x[:, 0], x[:, 1])
    k = 0.1 * math.sin(math.pi * math.sqrt(10) * t) * (9.25925925925926 * r**2 - 13.88888888888889 * r + 6.666666666666667)
    return k[:, None] * x


def run(case):
    for A in (float(__import__("os").environ["AA"]),):
      for kernel in ("uGIMP","quadratic","cubic","lCPDI"):
       for points in (int(__import__("os").environ["PP"]),):
        es=[]
        for n in (8,16,32):
            try:
                out=case.run(f"v{A}{n}{kernel}{points}",file="vortex.xml",entities=dict(h=1/n,step=1/(6*n),kernel=kernel,points=points,A=A))
                es.append(error_of(out,vortex(A)))
            except SystemExit as e: print(e); es.append(float('nan'))
        print(A,kernel,points,["%.2e"%e for e in es],["%.2f"%math.log2(a/b) for a,b in zip(es,es[1:])],flush=True)
    for kernel in ("uGIMP","quadratic","cubic","lCPDI"):
       for points in (int(__import__("os").environ["PP"]),):
        es=[]
        for n in (4,8,16,32):
            out=case.run(f"v{n}{kernel}{points}",file="ring.xml",entities=dict(h=.2/n,kernel=kernel,points=points))
            es.append(error_of(out,ring))
        print(kernel,points,["%.2e"%e for e in es],["%.2f"%math.log2(a/b) for a,b in zip(es,es[1:])],flush=True)
