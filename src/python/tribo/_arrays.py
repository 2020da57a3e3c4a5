# SPDX-License-Identifier: MIT
"""Checks of arrays that functions of the user return."""

import numpy as np


def fit(given, shape, what):
    """`given` as an array of this shape; numbers that hold for all points may have fewer axes."""
    array = np.asarray(given, dtype=float)
    try:
        return np.ascontiguousarray(np.broadcast_to(array, tuple(shape)))
    except ValueError:
        raise ValueError(f"{what} must give an array of the shape {tuple(shape)}, not {array.shape}") from None


def fit_acceleration(given, shape):
    """The accelerations of all particles."""
    array = fit(given, shape, "a body force")
    if not np.isfinite(array).all():
        raise ValueError("a body force gave a number that is not finite")
    return array
