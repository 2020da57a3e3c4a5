# SPDX-License-Identifier: MIT
"""The manual of all names, from the tables that the program reads its input with."""

from . import _core

__all__ = ["doc", "keywords", "parameters"]

_kinds = ("element", "material", "contact law", "joint law", "custom task", "command", "history", "history of blocks",
          "field", "grid field")


class Text(str):
    """A text that an interactive session shows as it is."""

    def __repr__(self):
        return str(self)


def doc(name=None):
    """What `tribo doc NAME` prints of a material, law, command, element, quantity or property; of all without a name."""
    return Text(_core.manual_list() if name is None else _core.manual_text(name))


def keywords(kind):
    """The names of one kind: 'material', 'contact law', 'joint law', 'command', 'history', 'field' and others."""
    if kind not in _kinds:
        raise ValueError(f"there are no keywords of the kind '{kind}'; valid: {', '.join(_kinds)}")
    return [name.strip("<>") for entry_kind, name, *_ in _core.manual() if entry_kind == kind]


def parameters(name):
    """The parameters of a material, contact law or joint law: a dictionary of (unit and range, meaning) by name."""
    for kind, entry, _, _, rows in _core.manual():
        if entry.lower() == name.lower() and kind in ("material", "contact law", "joint law"):
            return {row.strip("<>"): (unit, meaning) for row, unit, meaning in rows}
    _core.manual_text(name)  # names what is similar
    raise ValueError(f"'{name}' is no material, contact law or joint law")
