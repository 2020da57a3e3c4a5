# SPDX-License-Identifier: MIT
"""Results of runs: tables, frames and provenance, from the files in the folder of a run."""

import builtins
import csv
import json
import os
from collections.abc import Mapping, Sequence

import numpy as np

from . import vtk
from .errors import OutputError

__all__ = ["Frame", "Results", "Table", "open"]


def _column(cells):
    try:
        return np.array([float(c) if c else np.nan for c in cells])
    except ValueError:
        return np.array(cells, dtype=object)


class Table(Mapping):
    """A table: arrays by the names of its columns, in order. Columns with words are arrays of texts."""

    def __init__(self, columns, units=None):
        self._columns = dict(columns)
        self.units = dict(units or {})  # of columns, by name, as far as they are known

    @classmethod
    def read(cls, path, units=None):
        """A table from a file of comma-separated values. `units`: of columns, by name."""
        try:
            with builtins.open(path, newline="", encoding="utf-8") as file:
                rows = list(csv.reader(file))
        except OSError as error:
            raise OutputError(f"cannot read '{path}': {error.strerror}") from None
        if not rows:
            raise OutputError(f"the file '{path}' is empty")
        body = [row for row in rows[1:] if len(row) == len(rows[0])]  # a run may be writing the last row
        return cls({name: _column([row[k] for row in body]) for k, name in enumerate(rows[0])}, units)

    def __getitem__(self, name):
        if name not in self._columns:
            raise KeyError(f"there is no column '{name}'; valid: {', '.join(self._columns)}")
        return self._columns[name]

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    @property
    def rows(self):
        """Number of rows."""
        return len(next(iter(self._columns.values()), ()))

    def to_pandas(self):
        """The table as a pandas.DataFrame; needs pandas."""
        try:
            import pandas
        except ModuleNotFoundError:
            raise ModuleNotFoundError("to_pandas() needs pandas: install Debian's package python3-pandas (apt install "
                                      "python3-pandas), or pandas with pip", name="pandas") from None
        return pandas.DataFrame(self._columns)

    def write(self, path):
        """Writes the table as comma-separated values."""
        with builtins.open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(self._columns)
            for row in zip(*self._columns.values()):
                writer.writerow([c if isinstance(c, str) else "" if c != c else repr(c.item()) for c in row])

    def plot(self, x=None, y=None, *, ax=None):
        """Draws columns over another one, by default all with numbers over the first; needs matplotlib."""
        from .plots import plot_table

        return plot_table(self, x, y, ax)

    def __repr__(self):
        return f"Table of {self.rows} rows: {', '.join(self._columns)}"

    def __str__(self):
        shown = min(self.rows, 20)
        cells = [[name, *(c[k] if isinstance(c[k], str) else format(c[k], ".6g") for k in range(shown))]
                 for name, c in self._columns.items()]
        widths = [max(map(len, column)) for column in cells]
        lines = ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in zip(*cells)]
        rest = [f"and {self.rows - shown} further rows"] if self.rows > shown else []
        return "\n".join(lines + rest)

    def _repr_html_(self):
        shown = range(min(self.rows, 20))
        head = "".join(f"<th>{name}</th>" for name in self._columns)
        body = "".join("<tr>" + "".join(f"<td>{c[k] if isinstance(c[k], str) else format(c[k], '.6g')}</td>"
                                        for c in self._columns.values()) + "</tr>" for k in shown)
        rest = f"<p>and {self.rows - 20} further rows</p>" if self.rows > 20 else ""
        return f"<table><tr>{head}</tr>{body}</table>{rest}"


class Frame(Mapping):
    """One file of a run: its time, and its arrays by name. They are read when they are first asked for."""

    def __init__(self, time, path):
        self.time, self.path = time, path
        self._arrays = None

    @property
    def particles(self):
        """The arrays by name; `position` are the points."""
        if self._arrays is None:
            self._arrays = vtk.read(self.path)
        return self._arrays

    def __getitem__(self, name):
        if name not in self.particles:
            raise KeyError(f"there is no field '{name}'; valid: {', '.join(self.particles)}")
        return self.particles[name]

    def __iter__(self):
        return iter(self.particles)

    def __len__(self):
        return len(self.particles)

    def __repr__(self):
        return f"Frame at time {self.time:.6g} ({os.path.basename(self.path)})"


class Frames(Sequence):
    """The files of a run in the order of time."""

    def __init__(self, entries):
        self._frames = [Frame(time, path) for time, path in entries]

    @property
    def times(self):
        """The times of the files."""
        return np.array([f.time for f in self._frames])

    def at(self, time):
        """The file nearest to a time."""
        if not self._frames:
            raise OutputError("there are no such files")
        return min(self._frames, key=lambda f: abs(f.time - time))

    def __getitem__(self, k):
        if isinstance(k, slice):
            return [self._frames[i] for i in range(*k.indices(len(self._frames)))]
        return self._frames[k]

    def __len__(self):
        return len(self._frames)

    def __repr__(self):
        return f"{len(self)} frames" + (f" to time {self._frames[-1].time:.6g}" if self._frames else "")


class Results:
    """The results of a run in its folder, finished or in progress. Tables and files are read anew at each access."""

    def __init__(self, folder):
        self.folder = os.fspath(folder)
        if not os.path.isdir(self.folder):
            raise OutputError(f"there is no folder '{self.folder}'")
        if not os.path.exists(os.path.join(self.folder, "provenance.json")):
            raise OutputError(f"'{self.folder}' is not the folder of a run: it has no provenance.json")

    def _path(self, name):
        return os.path.join(self.folder, name)

    def _table(self, name):
        if not os.path.exists(self._path(name)):
            raise OutputError(f"this run has no {name}")
        return Table.read(self._path(name), self.units)

    @property
    def provenance(self):
        """The record of the run: program, input, machine, status, computing times, units, what it noticed."""
        try:
            with builtins.open(self._path("provenance.json"), encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError) as error:
            raise OutputError(f"cannot read '{self._path('provenance.json')}': {error}") from None

    status = property(lambda self: self.provenance["status"], doc="finished, stopped, failed or running.")
    @property
    def units(self):
        """Units of fields and columns by name; none if the folder has no record."""
        if not os.path.exists(self._path("provenance.json")):
            return {}
        time = self.provenance.get("model", {}).get("unit of time")
        return ({"time": time} if time else {}) | self.provenance.get("unit_of", {})

    @property
    def remarks(self):
        """What the run noticed about itself: signs that its results are wrong, then figures of its end, which need not be."""
        record = self.provenance
        return record.get("to_look_at", []) + record.get("figures", [])

    history = property(lambda self: self._table("history.csv"), doc="Table of the histories.")
    energy = property(lambda self: self._table("energy.csv"), doc="Table of the energy balance.")
    events = property(lambda self: self._table("events.csv"), doc="Table of the events at joints between bodies.")
    tips = property(lambda self: self._table("tips.csv"), doc="Table of the crack tips.")
    stages = property(lambda self: self._table("stages.csv"), doc="Table of the stages.")

    def _files(self, name):
        return Frames(vtk.collection(self._path(name + ".pvd")))

    frames = property(lambda self: self._files("run"), doc="Files of the particles.")
    grid = property(lambda self: self._files("grid"), doc="Files of the grid.")
    cracks = property(lambda self: self._files("cracks"), doc="Files of the cracks.")
    joints = property(lambda self: self._files("joints"), doc="Files of the joints.")
    blocks = property(lambda self: self._files("blocks"), doc="Files of the rigid blocks.")
    contacts = property(lambda self: self._files("contacts"), doc="Files of the contacts between blocks.")
    times = property(lambda self: self.frames.times, doc="Times of the files of the particles.")

    def table(self, name):
        """Any table of the folder by its file name, such as 'block_energy.csv'."""
        return self._table(name)

    def plot(self, field="velocity", *, of=None, time=None, component=None, range=None, ax=None):
        """Draws the particles or the rigid blocks at a time (by default the last file), coloured by a field; needs
        matplotlib.

        `of` is "particles" or "blocks", by default the particles if the run has any. The magnitude of vectors is shown,
        or a `component` ('x', 'xy'); `range` is (lowest, highest).
        """
        from .plots import plot_blocks, plot_particles

        if of not in (None, "particles", "blocks"):
            raise ValueError(f"a picture is of 'particles' or of 'blocks', not of '{of}'")
        particles, blocks = self.frames, self.blocks
        draws_blocks = of == "blocks" or (of is None and not len(particles) and len(blocks) > 0)
        frames = blocks if draws_blocks else particles
        if not len(frames):
            raise OutputError(f"this run has no files of {'blocks' if draws_blocks else 'particles'}")
        frame = frames[-1] if time is None else frames.at(time)
        return (plot_blocks if draws_blocks else plot_particles)(frame, field, component, range, ax, self.units)

    def __repr__(self):
        return f"Results of '{self.folder}': {self.status}, {self.frames!r}"


def open(folder):
    """The results of any run, from its folder. Runs in progress can be read, too."""
    return Results(folder)
