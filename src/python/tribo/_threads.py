# SPDX-License-Identifier: MIT
"""Loads the compiled part, whose threads shall spin only briefly while they wait, and then sleep.

By default libgomp lets them spin for milliseconds, which delays the threads that still work, at every barrier, if other
programs use the same cores. The program `tribo` does the same (src/waiting.cpp).
"""

import os

_spins = "3000"  # as in src/waiting.cpp


def _load():
    # libgomp reads the variable when it is loaded, and child processes should not get a variable that nobody has set.
    chosen = "GOMP_SPINCOUNT" in os.environ or "OMP_WAIT_POLICY" in os.environ
    if not chosen:
        os.environ["GOMP_SPINCOUNT"] = _spins
    try:
        from . import _core
    finally:
        if not chosen:
            del os.environ["GOMP_SPINCOUNT"]
    return _core


core = _load()
