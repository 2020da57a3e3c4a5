# SPDX-License-Identifier: MIT
"""The manual of all names, from the tables that the program reads its input with."""

import inspect

from . import _core
from .laws import MaterialLaw, own_law, registered

__all__ = ["doc", "keywords", "parameters"]

_kinds = ("element", "material", "contact law", "joint law", "custom task", "command", "history", "history of blocks",
          "field", "grid field")


class Text(str):
    """A text that an interactive session shows as it is."""

    def __repr__(self):
        return str(self)


def _kind(law):
    return "material" if issubclass(law, MaterialLaw) else "contact law"


def _rows(law):
    """The parameters of a law of Python as `parameters` gives them."""
    out = {}
    for name, p in law._all_parameters().items():
        default = "required" if p.default is None else f"default {p.default:g}"
        out[name] = (f"{p.dimension}, {p.range_text}", f"{p.meaning or name}; {default}")
    return out


def _text_of(name, law):
    """What `doc` tells of a law of Python."""
    rows = "".join(f"\n  {key}  [{unit}]: {meaning}" for key, (unit, meaning) in _rows(law).items())
    return f"{name}, a {_kind(law)} of Python\n\n{inspect.cleandoc(law.__doc__ or '')}\n\nparameters:{rows or ' none'}\n"


def doc(name=None):
    """What `tribo doc NAME` prints of a material, law, command, element, quantity or property; of all without a name.
    Laws that are registered in Python have an entry, too."""
    if name is None:
        return Text(_core.manual_list())
    own, law = own_law(name)
    return Text(_core.manual_text(name) if law is None else _text_of(own, law))


def keywords(kind):
    """The names of one kind: 'material', 'contact law', 'joint law', 'command', 'history', 'field' and others, with the
    laws that are registered in Python."""
    if kind not in _kinds:
        raise ValueError(f"there are no keywords of the kind '{kind}'; valid: {', '.join(_kinds)}")
    own = [name for name, law in registered.items() if _kind(law) == kind]
    return [name.strip("<>") for entry_kind, name, *_ in _core.manual() if entry_kind == kind and name not in own] + own


def parameters(name):
    """The parameters of a material, contact law or joint law: a dictionary of (unit and range, meaning) by name."""
    _, law = own_law(name)
    if law is not None:
        return _rows(law)
    for kind, entry, _, _, rows in _core.manual():
        if entry.lower() == name.lower() and kind in ("material", "contact law", "joint law"):
            return {row.strip("<>"): (unit, meaning) for row, unit, meaning in rows}
    _core.manual_text(name)  # names what is similar
    raise ValueError(f"'{name}' is no material, contact law or joint law")
