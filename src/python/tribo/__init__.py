# SPDX-License-Identifier: MIT
"""Tribo, a material point method solver with contact, for Python.

    import tribo
    results = tribo.run("two_disks.fmcmd", set={"speed": 30})
    results.history.plot()
    results.plot("velocity")

`run`, `resume` and `check` do what the program does, `open` reads the results of any run, `Model` builds a model in
Python, `simulate` takes a run step by step, `drive` tests a single law, `sweep` varies parameters. Laws of your own
are classes of `MaterialLaw` and `ContactLaw`. `doc("MohrCoulomb")` describes a keyword.
"""

from . import _processor  # first: it refuses a processor on which _core would crash

try:
    from . import _threads  # loads _core
except ImportError as error:
    if "partially initialized" not in str(error) and "cannot import name '_core'" not in str(error):
        raise
    raise ImportError("the compiled part of the package is not there; build it (cmake --build --preset release --target tribo_python) "
                      "or install the package (scripts/install-python)") from None
from .driving import drive
from .errors import InputError, ModelWarning, NumericalError, OutputError, Problem, RunWarning, TriboError, UsageError
from .laws import ContactLaw, ContactState, MaterialLaw, Parameter, check_contact_law, register
from .manual import doc, keywords, parameters
from .model import Model
from .results import Frame, Results, Table, open
from .running import Check, check, resume, run
from .shapes import Expression, Shape, box, cut, cylinder, oval, polygon, rect, sphere, surface
from .simulation import Simulation, simulate
from .sweeping import Sweep, open_sweep, sweep

__version__ = _threads.core.version().split()[1]

__all__ = [
    "Check", "ContactLaw", "ContactState", "Expression", "Frame", "InputError", "MaterialLaw", "Model", "ModelWarning", "NumericalError",
    "OutputError", "Parameter", "Problem", "Results", "RunWarning", "Shape", "Simulation", "Sweep", "Table", "TriboError",
    "UsageError", "box", "check", "check_contact_law", "cut", "cylinder", "doc", "drive", "keywords", "open", "open_sweep",
    "oval", "parameters", "polygon", "rect", "register", "resume", "run", "simulate", "sphere", "surface", "sweep",
]
