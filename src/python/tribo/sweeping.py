# SPDX-License-Identifier: MIT
"""Sweeps: the same model with other parameters, and a table of what came out."""

import itertools
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from . import errors, laws
from .model import Model
from .results import Table
from .results import open as open_results
from .running import load, name_of, run, text_of, warn_of

__all__ = ["Sweep", "open_sweep", "sweep"]

_problem = "measure_error"  # the column of what a measure failed with


class Sweep(Table):
    """The table of a sweep: the parameters, the folder and the outcome of each run, the last values of its histories
    and its measures. `results` has the Results of each run, None if it failed; `errors` its error, that of its measure,
    or None. `path` is the folder of the sweep."""

    def __init__(self, columns, parameters, results, problems, path):
        super().__init__(columns)
        self.parameters, self.results, self.errors, self.path = parameters, results, problems, path

    def measure(self, function):
        """A Sweep with what `function(results)` makes of each run that did not fail, a number or a dictionary of numbers,
        in addition to the columns of this one. It is also written to sweep.csv in the folder of the sweep.

        A measure that raises an exception leaves empty cells: the exception is in `errors`, its text in the column
        `measure_error`, and a RunWarning tells it.
        """
        rows, problems = [], []
        for name, results, error in zip(self["folder"], self.results, self.errors):
            given, failure = ({}, error) if results is None else _measured(function, results, name)
            rows.append(given)
            problems.append(failure)
        measured = {key: _numbers([row.get(key) for row in rows]) for key in dict.fromkeys(k for row in rows for k in row)}
        kept = {key: column for key, column in self._columns.items() if key != _problem}
        table = Sweep({**kept, **measured}, self.parameters, self.results, problems, self.path)
        table.write(os.path.join(self.path, "sweep.csv"))
        return table

    def plot(self, x=None, y=None, *, ax=None):
        """Draws a column over a parameter, a line for each value of the other parameters."""
        from .plots import plot_sweep

        return plot_sweep(self, x, y, ax)


def _work(task):
    """Runs a point in a process of its own; returns None or the error."""
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    path = os.pathsep.join([package, *filter(None, [os.environ.get("PYTHONPATH")])])
    done = subprocess.run([sys.executable, "-m", "tribo._worker"], input=json.dumps(task), text=True,
                          stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": path})
    if done.returncode != 0 or not done.stdout:
        return errors.TriboError(f"the process of this run ended with {done.returncode}")
    kind, text = json.loads(done.stdout.splitlines()[-1])
    return None if kind is None else getattr(errors, kind, errors.TriboError)(text)


def _try(action):
    try:
        action()
    except errors.TriboError as error:
        return error
    return None


class _Point:
    """One run of a sweep."""

    def __init__(self, model, values, base, folder):
        self.model = model(**values) if callable(model) else model
        self.set = dict(base) if callable(model) else {**base, **values}
        name = "_".join(f"{key}={text_of(value)}" for key, value in values.items())
        self.folder = os.path.join(folder, name.replace("/", "%"))

    def task(self, threads, overwrite):
        of_python = isinstance(self.model, Model)
        return {"text": self.model.script() if of_python else None, "name": name_of(self.model),
                "file": None if of_python else os.fspath(self.model),
                "set": {k: text_of(v) for k, v in self.set.items()}, "folder": self.folder, "threads": threads,
                "overwrite": overwrite}


def _ends(folder):
    """The results of a run, its outcome, and the last values of its histories."""
    results = open_results(folder)
    history = results.history
    return results, {"outcome": results.status, **{name: history[name][-1] for name in history if history.rows}}


def _measured(measure, results, name):
    """What a function makes of a run, as a row, and what it failed with."""
    try:
        given = measure(results)
        row = given if isinstance(given, dict) else {"measure": given}
        return {key: v if v is None or isinstance(v, str) else float(v) for key, v in row.items()}, None
    except Exception as error:  # of the user, whose other runs are not lost by it
        text = f"{type(error).__name__}: {error.args[0] if len(error.args) == 1 else error}"
        errors.warn(f"the measure of {name} failed: {text}", errors.RunWarning)
        return {_problem: text}, error


def _numbers(values):
    if any(isinstance(v, str) for v in values):
        return np.array([v if isinstance(v, str) else "" if v is None else str(v) for v in values], dtype=object)
    return np.array([np.nan if v is None else v for v in values], dtype=float)


def sweep(model, *, parameters=None, processes=1, threads=None, folder=None, overwrite=False, set=None, measure=None,
          **values):
    """Runs a model for all combinations of some parameters and returns the table of the results, a Sweep.

        table = tribo.sweep("granular_column.fmcmd", phi=[20, 25, 30], processes=2,
                            measure=lambda results: {"run_out": results.history["maxx:Sand"][-1]})

    `model` is a command file whose variables are set, a Model with such variables, or a function of the parameters
    that returns a Model. Each run has its folder in `folder` (NAME.sweep), where the table is written to sweep.csv, as
    by `tribo sweep`. `processes` run at the same time, with `threads` each; with one process the runs take place in
    this one, as models with laws of Python need it. A run that fails leaves empty cells; errors of the input are
    raised before the first run. `measure(results)` returns a number or a dictionary of numbers for each run. It is
    called when all runs are done, as `Sweep.measure`, which also measures a sweep later; `open_sweep` reads one.
    """
    values = {**(parameters or {}), **values}
    if not values:
        raise ValueError("a sweep needs at least one parameter with a list of values")
    combinations = [dict(zip(values, point)) for point in itertools.product(*values.values())]
    name = model.__name__ if callable(model) and not isinstance(model, Model) else name_of(model)
    folder = os.fspath(folder or name + ".sweep")
    points = [_Point(model, point, set or {}, folder) for point in combinations]
    _read_all(points, processes)
    if processes == 1:
        failed = [_try(lambda p=p: run(p.model, set=p.set, folder=p.folder, threads=threads, overwrite=overwrite))
                  for p in points]
    else:
        share = threads or max(1, (os.cpu_count() or 1) // processes)
        with ThreadPoolExecutor(processes) as pool:
            failed = list(pool.map(_work, [p.task(share, overwrite) for p in points]))
    rows, results = [], []
    for values_of, point, error in zip(combinations, points, failed):
        found, row = (None, {"outcome": "failed"}) if error else _ends(point.folder)
        if found is not None and processes > 1:
            warn_of(found, before=f"{os.path.basename(point.folder)}: ")
        results.append(found)
        rows.append({**values_of, "folder": os.path.basename(point.folder), **row})
    names = list(dict.fromkeys(key for row in rows for key in row))
    columns = {key: _numbers([row.get(key) for row in rows]) for key in names}
    table = Sweep(columns, list(values), results, failed, folder)
    os.makedirs(folder, exist_ok=True)
    table.write(os.path.join(folder, "sweep.csv"))
    return table if measure is None else table.measure(measure)


def _read_all(points, processes):
    """Finds what is wrong with any model before the first one runs."""
    laws.made.clear()
    for point in points:
        load(point.model, point.set)
    if processes > 1 and laws.made:
        raise errors.UsageError(f"the laws {', '.join(sorted(laws.made))} are written in Python and known in this process "
                                "only: sweep(..., processes=1)")


def open_sweep(folder):
    """The Sweep in a folder, from its sweep.csv: that of `sweep` or of the program `tribo sweep`. `measure` adds columns."""
    folder = os.fspath(folder)
    table = Table.read(os.path.join(folder, "sweep.csv"))
    names = list(table)
    if "folder" not in names or "outcome" not in names:
        raise errors.OutputError(f"'{folder}' is not the folder of a sweep: its sweep.csv has no folders of runs")
    results, problems = [], []
    for name, outcome in zip(table["folder"], table["outcome"]):
        there = outcome not in ("failed", "not run")
        results.append(open_results(os.path.join(folder, name)) if there else None)
        problems.append(None if there else errors.TriboError(f"{name}: {outcome}"))
    return Sweep({key: table[key] for key in names}, names[: names.index("folder")], results, problems, folder)
