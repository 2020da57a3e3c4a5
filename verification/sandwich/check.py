import numpy as np

import verify


def run(case):
    for label, entities in (("one cell thick", {}), ("two cells thick", dict(thick="0.1")), ("one cell thick, impulses on faces", dict(contact="<MultiMaterialMode Impulses='faces'/>")))[: 1 if case.quick else 3]:
        got = verify.history(case.run(label.replace(" ", "_").replace(",", ""), entities=entities))
        late = got["time"] > 50
        mean = lambda name: got[name][late].mean()
        for other, mu in (("bottom", 0.1), ("press", 0.3)):
            case.check(f"plate {label}: friction over pressure with the {other}", mean(f"contactx:plate:{other}") / abs(mean(f"contacty:plate:{other}")), mu, 5e-3)
        load = abs(mean("contacty:plate:press"))
        case.check(f"plate {label}: what holds it over the load", mean("contactx:plate") / load, 0.4, 5e-3)
        if "faces" in label:
            case.check(f"plate {label}: load over that of its stiffness", load / (5e-5 / 0.05), 1, 0.03)
