# SPDX-License-Identifier: MIT
import numpy as np

import verify

faces = dict(contact="<MultiMaterialMode Impulses='faces'/>")
wide = "<Grid xmin='-0.8' xmax='1.6' ymin='-0.8' ymax='1.6'><Horiz cellsize='0.05'/><Vert cellsize='0.05'/></Grid>"


def run(case):
    runs = (("one cell thick", 0, {}), ("two cells thick", 0, dict(thick="0.1")), ("one cell thick, impulses on faces", 0, faces),
            ("one cell thick, turned by 17 degrees", 17, {}), ("two cells thick, turned by 45 degrees", 45, dict(thick="0.1")),
            ("one cell thick, impulses on faces, turned by 17 degrees", 17, faces), ("one cell thick, impulses on faces, turned by 45 degrees", 45, faces))
    for label, angle, entities in runs[:1] if case.quick else runs:
        c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        if angle:
            entities = entities | dict(c=repr(c), s=repr(s), grid=wide)
        got = verify.history(case.run(label.replace(" ", "_").replace(",", ""), entities=entities))
        late = got["time"] > 50

        def force(other=""):
            """On the plate, from one of the blocks or from both: along the plate, and across it."""
            x, y = (got[f"contact{axis}:plate{other}"][late].mean() for axis in "xy")
            return np.array([c * x + s * y, c * y - s * x])

        for other, mu in (("bottom", 0.1), ("press", 0.3)):
            along, across = force(f":{other}")
            case.check(f"plate {label}: friction over pressure with the {other}", along / abs(across), mu, 5e-3)
        load = abs(force(":press")[1])
        case.check(f"plate {label}: what holds it over the load", force()[0] / load, 0.4, 5e-3)
        if "faces" in label:
            case.check(f"plate {label}: load over that of its stiffness", load / (5e-5 / 0.05), 1, 0.03)
