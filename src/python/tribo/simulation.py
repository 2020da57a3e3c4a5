# SPDX-License-Identifier: MIT
"""Runs that a Python program takes step by step."""

import shutil
import tempfile
import weakref
from collections.abc import Mapping

import numpy as np

from . import _core
from .model import Model
from .results import open as open_results
from .running import document, load, name_of, options_of, warn_of

__all__ = ["Body", "Simulation", "SimulationFrame", "simulate"]

_vector = ("_x", "_y", "_z")
_full = ("_xx", "_xy", "_xz", "_yx", "_yy", "_yz", "_zx", "_zy", "_zz")


class Body(Mapping):
    """The particles of one material while the simulation stands: arrays by the names of their columns.

    `body["velocity_x"]` is the memory of the solver, without a copy and read-only; `body["velocity"]` puts the
    components next to each other and is a copy. `writable(name)` gives an array through which values can be changed.
    An array that is kept while the simulation goes on has its numbers for good.
    """

    def __init__(self, frame, number, name, count, rigid):
        self._frame, self._number = frame, number
        self.name, self.count, self.rigid = name, count, rigid
        self._columns = {column: k for k, column in enumerate(frame._core().columns(number))}

    @property
    def ids(self):
        """The numbers of the particles, which never change; their order does."""
        return self._frame._core().ids(self._number)

    def _column(self, name, writable=False):
        return self._frame._core().column(self._number, self._columns[name], writable)

    def __getitem__(self, name):
        if name in self._columns:
            return self._column(name)
        parts = [name + s for s in (*_vector, *_full) if name + s in self._columns]
        if not parts:
            raise KeyError(f"'{self.name}' has no column '{name}'; valid: {', '.join(self._columns)}")
        return np.stack([self._column(part) for part in parts], axis=1)

    def writable(self, name):
        """A column that may be changed: components of velocity and stress, temperature, history variables of the law.

        The energy that a change brings or takes appears in the residual of the energy balance.
        """
        may = [c for c in self._columns if c.startswith(("velocity_", "stress_")) or c == "temperature"]
        may += [c for c in self._frame._core().histories(self._number) if c in self._columns]
        if self.rigid or name not in may:
            valid = "none of a rigid body" if self.rigid else ", ".join(may)
            raise KeyError(f"'{name}' of '{self.name}' cannot be changed; valid: {valid}")
        return self._column(name, True)

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    def __repr__(self):
        return f"Body '{self.name}' of {self.count} particles"


class Particles(Mapping):
    """The fields of the particle files, for all particles: copies, computed when they are first asked for."""

    def __init__(self, frame):
        self._frame, self._arrays = frame, {}

    def _load(self, names):
        self._arrays.update(self._frame._core().fields(names))

    def __getitem__(self, name):
        if name not in self._arrays:
            try:
                self._load(["id"] if name in ("position", "domain") else [name])
            except KeyError:
                self._load(["history"])  # variables of the laws
                if name not in self._arrays:
                    raise
        return self._arrays[name]

    def __iter__(self):
        self._load([])
        return iter(list(self._arrays))

    def __len__(self):
        self._load([])
        return len(self._arrays)


class SimulationFrame:
    """The state of a simulation while it stands: `time`, `step` and `step_size`, `particles` with the fields of all
    particles, `bodies` with the columns of each body, and the tables up to now."""

    def __init__(self, simulation):
        self._simulation, self._core_now = simulation, simulation._core
        self.time, self.step, self.step_size = self._core_now.time, self._core_now.step, self._core_now.step_size
        self.particles = Particles(self)
        self._bodies = None

    def _core(self):
        if self._simulation._frame is not self:
            raise RuntimeError("the simulation has gone on; read what you need of a frame before the next one")
        return self._core_now

    @property
    def bodies(self):
        """The bodies by the name of their material."""
        if self._bodies is None:
            self._bodies = {row[0]: Body(self, k, *row) for k, row in enumerate(self._core().bodies())}
        return self._bodies

    history = property(lambda self: self._simulation.results.history, doc="Table of the histories up to now.")
    energy = property(lambda self: self._simulation.results.energy, doc="Table of the energy balance up to now.")
    events = property(lambda self: self._simulation.results.events, doc="Table of the events up to now.")

    def __repr__(self):
        return f"SimulationFrame at time {self.time:.6g}, step {self.step}"


class Simulation:
    """A run that is taken step by step; made by `simulate`. It is iterated over, or advanced with `advance`."""

    def __init__(self, model, *, every, set, folder, threads, overwrite, quiet, body_force):
        if every is not None and every < 1:
            raise ValueError("every must be a positive number of steps")
        loaded = load(model, set, body_force)
        self._every, self._ended, self._kept, self._frame = every, False, folder is not None, None
        self.folder = folder if self._kept else tempfile.mkdtemp(prefix="tribo-")
        self._clean = None if self._kept else weakref.finalize(self, shutil.rmtree, self.folder, ignore_errors=True)
        call = f"tribo.simulate({name_of(model)!r}, set={set or {}!r})"
        options = options_of(call, self.folder, threads, quiet, overwrite=overwrite)
        self._core = _core.Simulation(loaded, options)

    time = property(lambda self: self._core.time, doc="The present time.")
    step = property(lambda self: self._core.step, doc="Number of steps done.")
    finished = property(lambda self: self._ended, doc="Whether the run is at its end.")

    @property
    def frame(self):
        """The present state."""
        if self._frame is None:
            self._frame = SimulationFrame(self)
        return self._frame

    def advance(self, steps=None):
        """Takes some steps, or by default those up to the next output time. Returns the present state, or None if the
        run had ended before."""
        if self._ended:
            return None
        if steps is not None and steps < 1:
            raise ValueError("steps must be a positive number")
        self._frame, before = None, self._core.step
        try:
            pause = self._core.advance(steps or 0)
        except BaseException:
            self._ended = True
            raise
        if pause == "signal":
            raise KeyboardInterrupt(f"stopped after step {self._core.step}")
        self._ended = pause == "end"
        if self._ended:
            warn_of(self.results)
        return None if self._ended and self._core.step == before else self.frame

    def __iter__(self):
        if self._core.step == 0 and not self._ended:
            yield self.frame
        while True:
            frame = self.advance(self._every)
            if frame is None:
                return
            yield frame

    @property
    def results(self):
        """The Results so far. Without a folder of its own they vanish with the simulation."""
        self._core.flush()
        return open_results(self.folder)

    def close(self):
        """Ends the run here: with a folder of its own it can be resumed from a checkpoint."""
        self._frame = None
        if not self._ended and self._kept:
            self._core.stop("closed by the program")
        elif not self._ended:
            self._core.flush()
        self._ended = True
        if self._clean is not None:
            self._clean()

    def __del__(self):
        if "_core" in self.__dict__ and not self._ended:
            self.close()

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.close()
        return False


def simulate(model, *, every=None, set=None, folder=None, threads=None, overwrite=False, quiet=True, body_force=None):
    """Starts a run and gives its states one after the other:

        for frame in tribo.simulate("two_disks.fmcmd"):
            print(frame.time, frame.particles["velocity"][:, 0].max())

    The first state is that of the start; the others are those of the output times, or with `every=n` of every n-th
    step. With a `folder` the results are written as by `run`, with the same bits; otherwise they are temporary.
    `body_force(x, t)` is as for `run`. Ctrl-C ends the present step and raises KeyboardInterrupt.
    """
    return Simulation(model, every=every, set=set, folder=folder, threads=threads, overwrite=overwrite, quiet=quiet,
                      body_force=body_force)


document(Model.simulate, simulate)
