# SPDX-License-Identifier: MIT
"""Checks of arrays that functions of the user return."""

import numpy as np


def _array(given, what, wanted):
    if given is None:
        raise ValueError(f"{what} returned None; it must give {wanted}")
    try:
        return np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{what} must give {wanted}, not {type(given).__name__} {str(given)[:60]!r}") from None


def fit(given, shape, what):
    """`given` as an array of this shape; a list of numbers may also be one number for all."""
    wanted = f"an array of the shape {tuple(shape)}"
    array = _array(given, what, wanted)
    if array.ndim == 0 and len(shape) == 1:
        array = np.full(shape, array)
    if array.shape != tuple(shape):
        raise ValueError(f"{what} must give {wanted}, not {array.shape}")
    return np.ascontiguousarray(array)


def fit_impulse(given, what):
    """The impulse of a contact law."""
    wanted = "three numbers, None or a ContactResponse"
    array = _array(given, what, wanted)
    if array.shape != (3,):
        raise ValueError(f"{what} must give {wanted}, not an array of the shape {array.shape}")
    return array


def fit_acceleration(given, shape):
    """The accelerations of all particles: a row for each, or one row for all."""
    what = "a body force"
    array = _array(given, what, f"an array of the shape {tuple(shape)}")
    if array.shape == tuple(shape[1:]):
        array = np.broadcast_to(array, tuple(shape))
    array = fit(array, shape, what)
    if not np.isfinite(array).all():
        raise ValueError("a body force gave a number that is not finite")
    return array
