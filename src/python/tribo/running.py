# SPDX-License-Identifier: MIT
"""Runs and checks of models."""

import inspect
import os

from . import _core
from .errors import InputError, ModelWarning, RunWarning, warn
from .model import Model
from .results import open as open_results

__all__ = ["Check", "check", "document", "load", "resume", "run", "warn_of"]


def text_of(value):
    """A value of a setting as on the command line."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else repr(value.item() if hasattr(value, "item") else value)


def load(model, set=None, body_force=None):
    """The model that the reader makes of a command file or of a Model."""
    values = {name: text_of(value) for name, value in (set or {}).items()}
    if isinstance(model, Model):
        try:
            loaded = _core.read_text(model.script(), model.name, values)
        except InputError as error:
            model._locate(error)
            raise
    else:
        loaded = _core.read_file(os.fspath(model), values)
    for text in loaded.warnings:
        warn(text, ModelWarning)
    if body_force is not None:
        loaded.set_body_force(body_force)
    return loaded


def name_of(model):
    """The name that results get by default."""
    return model.name if isinstance(model, Model) else os.path.splitext(os.path.basename(os.fspath(model)))[0]


def options_of(call, folder, threads, quiet, **more):
    """The options of a run for the solver."""
    if threads is not None and threads < 1:
        raise ValueError("threads must be a positive number")
    return {"folder": os.fspath(folder), "threads": threads, "quiet": quiet, "command_line": call, **more}


def warn_of(results, before=""):
    """A warning for each sign that results are wrong, as the run has noted them; not for figures that need not be."""
    for remark in results.provenance.get("to_look_at", []):
        warn(before + remark, RunWarning)


def _finish(loaded, options):
    outcome = _core.run(loaded, options)
    if outcome == "signal":
        raise KeyboardInterrupt(f"stopped with a checkpoint; tribo.resume({options['folder']!r}) continues the run")
    results = open_results(options["folder"])
    warn_of(results)
    return results


def run(model, *, set=None, folder=None, threads=None, overwrite=False, quiet=True, max_wall=None, body_force=None):
    """Runs a model to its end and returns its Results.

    `model` is a command file or a Model, `set` gives values to its variables. The results are written to `folder`
    (NAME.out in the current one), with the same bits as by `tribo run`; those of an earlier run are replaced only with
    `overwrite`. Ctrl-C ends the run after its present step: a checkpoint is written and KeyboardInterrupt is raised.
    After `max_wall` seconds the run stops with a checkpoint, and the results have the status 'stopped'.
    `body_force(x, t)` is a function that gives the acceleration of all particles, called once per step: `x` has a row
    per particle, and so has what it returns (or one row for all).

    What the run notices about itself is in `results.remarks`; signs that its results are wrong are also warnings of the
    class RunWarning. With `quiet=False` the run prints its progress.
    """
    loaded = load(model, set, body_force)
    folder = folder or name_of(model) + ".out"
    call = f"tribo.run({name_of(model)!r}, set={set or {}!r})"
    return _finish(loaded, options_of(call, folder, threads, quiet, overwrite=overwrite, max_wall=max_wall))


def resume(folder, *, threads=None, quiet=True, max_wall=None, body_force=None):
    """Continues a stopped run from its checkpoint, as `tribo resume`, and returns its Results.

    A run with a `body_force` needs the same function again.
    """
    loaded = _core.read_stopped(os.fspath(folder))
    if body_force is not None:
        loaded.set_body_force(body_force)
    call = f"tribo.resume({os.fspath(folder)!r})"
    return _finish(loaded, options_of(call, folder, threads, quiet, resume=True, max_wall=max_wall))


class Check(str):
    """The summary of a model before it runs: a text, with its parts as data.

    `lines` is a dictionary from what a line describes, such as 'time step', to the list of what it says, and `advice`
    the list of what stands below 'to look at'.
    """

    @property
    def lines(self):
        out = {}
        for line in self._parts()[0]:
            what, colon, said = line.strip().partition(": ")
            if colon:
                out.setdefault(what, []).append(said)
        return out

    @property
    def advice(self):
        return [line.strip().removeprefix("- ") for line in self._parts()[1] if line.strip()]

    def _parts(self):
        lines = self.splitlines()
        at = next((k for k, line in enumerate(lines) if line.strip().lower().startswith("to look at")), len(lines))
        return lines[:at], lines[at + 1 :]

    def __repr__(self):
        return str(self)


def check(model, *, set=None, threads=None):
    """What `tribo check` tells: places the particles of a model, takes some steps, and writes nothing."""
    return Check(_core.check(load(model, set), threads))


def document(method, function):
    """Gives a method of Model the description and the arguments of the function that it calls."""
    own = inspect.signature(function)
    method.__doc__ = function.__doc__
    method.__signature__ = own.replace(parameters=[next(iter(own.parameters.values())).replace(name="self"),
                                                   *list(own.parameters.values())[1:]])


document(Model.run, run)
document(Model.check, check)
