# SPDX-License-Identifier: MIT
"""Material and contact laws that are written in Python, for trying them out: they are slow."""

import math

import numpy as np

from . import _core
from ._arrays import fit_impulse
from ._core import ContactResponse, ContactState, ContactStatus

__all__ = ["ContactLaw", "ContactResponse", "ContactState", "ContactStatus", "MaterialLaw", "Parameter", "Points",
           "check_contact_law", "register"]


registered = {}  # the class of each law of Python, by its name
made = set()  # names of the laws of Python that the reader has made, until somebody clears it
_by_reader = False  # whether the reader makes a law, whose values it has checked in the units of the input


class Parameter:
    """A parameter of a law: its dimension ('stress', 'length', '1/time', '-' ...), which the reader uses for units, a
    default (None: required), the admissible values from `low` to `high`, without these if they are `open`, and its
    meaning in a phrase."""

    def __init__(self, dimension="-", default=None, *, low=-math.inf, high=math.inf, open=False, meaning=""):
        self.dimension, self.default, self.meaning = dimension, default, meaning
        self.low, self.high, self.open = low, high, open

    @property
    def range_text(self):
        """The admissible values in words, as in messages of the reader."""
        below, above = ("(", ")") if self.open else ("[", "]")
        if math.isfinite(self.low) and math.isfinite(self.high):
            return f"in {below}{self.low:g}, {self.high:g}{above}"
        if math.isfinite(self.low):
            return f"{'>' if self.open else '>='} {self.low:g}"
        return f"{'<' if self.open else '<='} {self.high:g}" if math.isfinite(self.high) else "any number"

    def admits(self, value):
        """Whether a number is in the range."""
        return self.low < value < self.high if self.open else self.low <= value <= self.high

    def row(self, name):
        return name, self.dimension, self.default, self.low, self.high, self.open, self.open, self.meaning or name


class Points:
    """The points of a batch: what a material law computes their stresses from.

    `L` is the velocity gradient during the step and `F` the deformation gradient at its end, `stress` the Cauchy stress
    at its start, all of the shape (n, 3, 3); `volume` and `temperature` (or None) have the shape (n,), `dt` is the
    step. `state` has an array for each state variable, which the law changes in place or replaces. All arrays are
    copies. `D` and `W` are the symmetric and the skew part of `L`.
    """

    def __init__(self, dt, F, L, stress, volume, temperature, state):
        self.dt, self._F, self.L, self.stress = dt, F, L, stress
        self.volume, self.temperature, self.state = volume, temperature, state

    @property
    def F(self):
        """The deformation gradient at the end of the step, for laws with `needs_deformation`."""
        if self._F is None:
            raise AttributeError("F is there only for laws with needs_deformation = True")
        return self._F

    D = property(lambda self: 0.5 * (self.L + self.L.transpose(0, 2, 1)), doc="Rate of deformation.")
    W = property(lambda self: 0.5 * (self.L - self.L.transpose(0, 2, 1)), doc="Spin.")

    def __len__(self):
        return len(self.stress)

    def rotated(self):
        """The stress turned with the material over the step (Jaumann rate)."""
        half = 0.5 * self.dt * self.W
        one = np.eye(3)
        turn = np.linalg.solve(one - half, one + half)  # Cayley's formula: a rotation for any step
        return turn @ self.stress @ turn.transpose(0, 2, 1)


class _Law:
    """What both kinds of laws have in common."""

    parameters = {}

    def __init__(self, **values):
        own, known = type(self).__name__, self._all_parameters()
        for name, value in values.items():
            if name not in known:
                raise TypeError(f"{own} has no parameter '{name}'; it has: {', '.join(known) or 'none'}")
            if not _by_reader and not known[name].admits(value):
                raise ValueError(f"'{name}' of {own} is {value} but must be {known[name].range_text}")
            setattr(self, name, value)
        for name, parameter in self.parameters.items():
            if name in values:
                continue
            if parameter.default is None:
                raise TypeError(f"{own}() needs the parameter '{name}'")
            setattr(self, name, parameter.default)
        self.prepare()

    @classmethod
    def _all_parameters(cls):
        for name, parameter in cls.parameters.items():
            if not isinstance(parameter, Parameter):
                raise TypeError(f"'{name}' among the parameters of {cls.__name__} must be a tribo.Parameter")
        return dict(cls.parameters)

    def prepare(self):
        """Computes constants, once the parameters are set; raises ValueError if they contradict each other."""


class MaterialLaw(_Law):
    """Base of material laws in Python. A law has

    - `parameters`: {name: Parameter}; the density `rho` is added. They are attributes of the law.
    - `state`: {name: (dimension, initial value)}, optional. 'dissipation' is the dissipated energy per initial volume.
    - `stress(self, p)`: the Cauchy stress at the end of the step, of the shape (n, 3, 3), for the Points `p`.
    - `wave_modulus(self)`: the largest rho c^2, from which the time step follows.
    - `energy(self, p)`, optional: the stored energy per current volume, of the shape (n,). Without it, and without the
      state 'dissipation' if the law dissipates, the energy balance of the run does not close, and the run says so.
    - `needs_deformation`: whether the law uses `p.F`, which is not there otherwise.

    `register` makes it known. The solver calls `stress` for up to 64 points at once, hundreds of times slower than a
    law in C++. It works in all analyses but plane stress.
    """

    state = {}
    needs_deformation = False

    def stress(self, p):
        raise NotImplementedError("a material law needs the method stress(self, p)")

    def wave_modulus(self):
        raise NotImplementedError("a material law needs the method wave_modulus(self)")

    @classmethod
    def _all_parameters(cls):
        rho = Parameter("mass/length^3", low=0, open=True, meaning="mass density before deformation")
        return {"rho": rho, **super()._all_parameters()}

    @property
    def _has_energy(self):
        return hasattr(self, "energy")

    def _state_rows(self):
        return [(name, dimension, float(start)) for name, (dimension, start) in self.state.items()]


class ContactLaw(_Law):
    """Base of contact laws in Python. A law has

    - `parameters`: {name: Parameter}, which are attributes of the law.
    - `response(self, s)`: the impulse [mass velocity] on the first of two faces, for the ContactState `s`: an array of
      three numbers, None for faces that do not act on each other, or what `s.frictional(limit)` returns.
    - `uses_area`, `has_memory`, `uses_face`: whether it reads the area, slip or bond, normal or gap.
    - `needs_closed_faces`: whether faces that do not meet within the step have no impulse. The law is then not asked
      about faces that are far apart.

    `s.normal_contact()` solves the normal contact, `s.frictional(limit)` adds sliding once the tangential impulse
    reaches a limit. The solver calls `response` for one pair at a node at a time. `check_contact_law` tests a law.
    """

    uses_area = False
    has_memory = False
    uses_face = True
    needs_closed_faces = False

    def response(self, s):
        raise NotImplementedError("a contact law needs the method response(self, s)")


def register(law, name=None):
    """Makes a class of MaterialLaw or ContactLaw known under a name, by default its own, in command files and models.

    It can be used as a decorator. The name must not be that of a law of Tribo. Returns the class.
    """
    name = name or getattr(law, "__name__", str(law))
    summary = (law.__doc__ or name).strip().splitlines()[0]
    if not isinstance(law, type) or not issubclass(law, (MaterialLaw, ContactLaw)):
        raise TypeError("a law is a class of tribo.MaterialLaw or tribo.ContactLaw")
    add = _core.add_material if issubclass(law, MaterialLaw) else _core.add_contact_law
    rows = law._all_parameters()
    add(name, summary, [parameter.row(key) for key, parameter in rows.items()], _maker(name, law))
    registered[name] = law
    return law


def _maker(name, law):
    """The function by which the reader makes a law of a name."""

    def make(**values):
        global _by_reader
        made.add(name)
        _by_reader = True
        try:
            return law(**values)
        finally:
            _by_reader = False

    return make


def own_law(name):
    """(name, class) of the law of Python with this name, in capitals or not; (name, None) if there is none."""
    return next((item for item in registered.items() if item[0].lower() == name.lower()), (name, None))


def _impulse(law, state):
    given = law.response(state)
    if given is None:
        return np.zeros(3)
    return np.asarray(given.impulse) if isinstance(given, ContactResponse) else fit_impulse(given, "response()")


def _random_state(random, law):
    state = ContactState()
    normal = random.normal(size=3)
    state.normal = normal / np.linalg.norm(normal)
    state.mass, state.dt, state.cell = random.uniform(0.1, 2), random.uniform(0.01, 0.1), 1.0
    state.area = random.uniform(0.5, 2)
    state.velocity = random.normal(size=3)
    state.start = state.velocity + 0.1 * random.normal(size=3)
    state.gap = random.choice([0.0, random.uniform(-0.1, 0.1)])
    return state


def check_contact_law(law, count=1000, seed=0):
    """Tests a contact law for random states: that it creates no energy, and that the impulse changes only its sign if
    the faces are exchanged. Returns the list of what is wrong, a sentence each; it is empty for a sound law."""
    if isinstance(law, type):
        values = ", ".join(f"{name}=..." for name in getattr(law, "parameters", {}))
        raise TypeError(f"check_contact_law() tests a law with values of its parameters, {law.__name__}({values}), not the class")
    random = np.random.default_rng(seed)
    problems = []
    for _ in range(count):
        s = _random_state(random, law)
        impulse = _impulse(law, s)
        after = s.velocity - impulse / s.mass
        gained = 0.5 * s.mass * (after @ after - s.velocity @ s.velocity)
        if gained > 1e-9 * s.mass * (s.velocity @ s.velocity):
            problems.append(f"it creates the energy {gained:.3g} at the relative velocity {s.velocity}")
        turned = ContactState()
        for name in ("mass", "dt", "cell", "area", "gap"):
            setattr(turned, name, getattr(s, name))
        turned.normal, turned.velocity, turned.start = -s.normal, -s.velocity, -s.start
        if not np.allclose(_impulse(law, turned), -impulse, rtol=1e-9, atol=1e-12):
            problems.append(f"the impulse does not change its sign with the faces, at the velocity {s.velocity}")
        if len(problems) >= 10:
            break
    return problems
