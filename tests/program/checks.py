# SPDX-License-Identifier: MIT
"""Checks of a test program: the first that fails ends it, and the others are counted."""

import sys


class Checks:
    """`check(condition, what)`: ends the program unless the condition holds. `passed`: number of those that held."""

    def __init__(self):
        self.passed = 0

    def __call__(self, condition, what):
        if not condition:
            sys.exit(f"FAILED: {what}")
        self.passed += 1
