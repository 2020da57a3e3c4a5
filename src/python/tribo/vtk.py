# SPDX-License-Identifier: MIT
"""Files of particles, cracks, joints, blocks and grids, and their collections. `_vtp` is scripts/vtp.py, which the build
copies into the package."""

import os
import zlib

from . import _vtp
from .errors import OutputError


def read(path):
    """The arrays of a file by name; `position` are its points. Arrays in memory of their own."""
    try:
        arrays = _vtp.file_arrays(path)
    except OSError as error:
        raise OutputError(f"cannot read '{path}': {error.strerror}") from None
    except (ValueError, KeyError, IndexError, zlib.error) as error:
        raise OutputError(f"the file '{path}' is damaged: {error}") from None
    if "Points" in arrays:
        arrays["position"] = arrays.pop("Points")
    return arrays


def collection(path):
    """(time, path) of every file of a collection .pvd; nothing if there is no such file."""
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as file:
        text = file.read()
    folder = os.path.dirname(path)
    return [(time, os.path.join(folder, name)) for time, name in _vtp.files(text)]
