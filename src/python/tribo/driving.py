# SPDX-License-Identifier: MIT
"""Laboratory tests of a single law."""

import math
import os
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from . import _core
from .laws import MaterialLaw, registered
from .results import Table
from .running import text_of

__all__ = ["drive"]


def _cell(value):
    return "" if value is None or (isinstance(value, float) and math.isnan(value)) else text_of(value)


def _path_text(path):
    if isinstance(path, str):
        return path
    columns = {name: np.atleast_1d(np.asarray(values, dtype=object)) for name, values in path.items()}
    rows = max(len(c) for c in columns.values())
    wrong = [name for name, c in columns.items() if len(c) not in (1, rows)]
    if wrong:
        raise ValueError(f"the columns of a path have {rows} rows or one value for all, not so '{wrong[0]}'")
    lines = [",".join(_cell(c[k if len(c) > 1 else 0]) for c in columns.values()) for k in range(rows)]
    return "\n".join([",".join(columns), *lines])


def _kind(law):
    """The attribute of <Drive> for a law; a name that is not known counts as a material, which the reader refuses."""
    kinds = {"contact law": "contact", "joint law": "joint"}
    own = {name.lower(): "material" if issubclass(of, MaterialLaw) else "contact" for name, of in registered.items()}
    known = {entry.lower(): kinds[kind] for kind, entry, *_ in _core.manual() if kind in kinds}
    return {**known, **own}.get(law.lower(), "material")


def _xml(law, properties, path, initial_stress, units, attributes):
    given = "".join(f" {name.replace('_', '-')}={quoteattr(text_of(value))}" for name, value in attributes.items())
    inside = f"<Path>\n{escape(_path_text(path))}\n</Path>" if path is not None else ""
    if initial_stress:
        inside += "<InitialStress" + "".join(f" {k}={quoteattr(text_of(v))}" for k, v in initial_stress.items()) + "/>"
    names = "".join(f"<{name}>{escape(text_of(value))}</{name}>" for name, value in properties.items())
    head = ""
    if units:
        length, mass, time = (quoteattr(unit) for unit in units)
        head = f"<Header><Analysis>10</Analysis><ConsistentUnits length={length} mass={mass} time={time}/></Header>"
    return (f"<JANFEAInput version='3'>{head}<Drive {_kind(law)}='law'{given}>{inside}</Drive>"
            f"<Material Type={quoteattr(law)} Name='law'>{names}</Material></JANFEAInput>")


def drive(file=None, *, set=None, law=None, properties=None, path=None, initial_stress=None,
          units=("m", "kg", "s"), **attributes):
    """Drives a single law along a path and returns the Table of what happens, as `tribo drive`.

    Either of a command file with <Drive>, or of a law with its properties:

        tribo.drive(law="MohrCoulomb", properties={"rho": 2000, "E": 1e7, "nu": 0.3, "cohesion": 5e3, "friction": 35,
                    "dilation": 5}, test="triaxial_compression", strain=0.06, steps=300, pressure=100e3)

    The attributes are those of <Drive> (`tribo.doc("Drive")`). `path` has the columns of a path by name, a list or one
    value for all rows each. Laws registered in Python can be driven, too.
    """
    if (file is None) == (law is None):
        raise ValueError("drive() needs a command file or a law, and not both")
    if file is not None:
        names, rows = _core.drive_file(os.fspath(file), {k: text_of(v) for k, v in (set or {}).items()})
    else:
        text = _xml(law, properties or {}, path, initial_stress, units, attributes)
        names, rows = _core.drive_text(text, "drive", {})
    return Table({name: rows[:, k] for k, name in enumerate(names)})
