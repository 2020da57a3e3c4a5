# SPDX-License-Identifier: MIT
"""Exceptions. Their texts are those of the program `tribo`."""

import os
import re
import sys
import warnings

__all__ = ["InputError", "ModelWarning", "NumericalError", "OutputError", "Problem", "RunWarning", "TriboError", "UsageError"]


_here = os.path.dirname(__file__)


def warn(text, category):
    """A warning at the line of the program that called the package."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and frame.f_code.co_filename.startswith(_here):
        level, frame = level + 1, frame.f_back
    warnings.warn(text, category, stacklevel=level)


class TriboError(Exception):
    """Base of all errors that Tribo reports."""


class Problem:
    """A problem of the input and its place.

    `file`, `line` and `column` say where it is (None if that is not known), `message` what is wrong. For a model that
    was built in Python, `source` is the place (file, line) in the Python program that wrote this line.
    """

    def __init__(self, file, line, column, message):
        self.file = file
        self.line = line or None
        self.column = column or None
        self.message = message
        self.source = None

    @property
    def remedy(self):
        """The part of the message that says what to do or what is valid, or None if it has no such part."""
        meant = re.search(r"\((did you mean '.*?'\?)\)", self.message)
        rest = [part for part in self.message.split("; ")[1:] if not part.startswith(("called from ", "with #"))]
        parts = ([meant.group(1)] if meant else []) + rest
        return "; ".join(parts) or None

    def __repr__(self):
        return f"Problem({self.file!r}, {self.line}, {self.column}, {self.message!r})"


class InputError(TriboError, ValueError):
    """The input is invalid. `problems` lists all that is wrong; the attributes `file`, `line`, `column` and `remedy`
    are those of the first one."""

    def __init__(self, text, problems=()):
        super().__init__(text)
        self.problems = [Problem(*p) for p in problems]

    def __str__(self):
        """The text of the program. Lines of a model that was built in Python begin with their place in the Python
        program."""
        lines = super().__str__().split("\n")
        for problem in self.problems:
            place = f"{problem.file}:{problem.line}:{problem.column}: "
            at = next((k for k, line in enumerate(lines) if line == f"{place}error: {problem.message}"), None)
            if problem.source and at is not None:
                file, line = problem.source
                lines[at] = f"{file}:{line}: error: {problem.message} (in the script: {place[:-2]})"
        unknown = [p for p in self.problems if p.message.startswith("there is no material type ")]
        if any("did you mean" not in p.message for p in unknown):
            lines.append("A law that is written in Python is known after tribo.register(CLASS).")
        return "\n".join(lines)

    @property
    def _first(self):
        return self.problems[0] if self.problems else Problem(None, 0, 0, str(self))

    file = property(lambda self: self._first.file, doc="Name of the file of the first problem.")
    line = property(lambda self: self._first.line, doc="Line of the first problem, from 1.")
    column = property(lambda self: self._first.column, doc="Column of the first problem, from 1.")
    remedy = property(lambda self: self._first.remedy, doc="What to do about the first problem, or None.")


class UsageError(TriboError, ValueError):
    """A name or an option is not known."""


class NumericalError(TriboError, ArithmeticError):
    """The state of a run has become invalid; the last checkpoint remains in its folder."""


class OutputError(TriboError, OSError):
    """A file cannot be read or written."""


class ModelWarning(UserWarning):
    """A possible mistake in a model, which does not prevent the run."""


class RunWarning(UserWarning):
    """A sign that the results of a run are wrong, or a measure of a sweep that failed."""
