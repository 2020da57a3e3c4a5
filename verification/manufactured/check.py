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


def run(case):
  for tr in ("FMPM",):
   for points in (4,16):
    for kernel in ("linear","uGIMP","quadratic","cubic","lCPDI"):
     for skip in ("<SkipPostExtrapolation/>",""):
        es=[]
        for n in (8,16,32,64):
            out=case.run(f"a{n}{kernel}{tr}{points}",file="axis_aligned.xml",entities=dict(n=n,kernel=kernel,points=points),replace={transfer["FMPM"]:transfer[tr]+skip})
            es.append(error_of(out,axis_aligned))
        print(tr,points,skip[1:5],kernel,["%.2e"%e for e in es],["%.2f"%math.log2(a/b) for a,b in zip(es,es[1:])],flush=True)
