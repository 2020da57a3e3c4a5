# SPDX-License-Identifier: MIT
"""Models that are built in Python. A Model writes a script, which the reader of command files reads: names, units,
checks and messages are those of scripts, and every command of a script is a method of Model."""

import difflib
import os
import re
import sys

from . import _core
from .errors import InputError, ModelWarning, warn
from .shapes import Expression, arguments, formatted

__all__ = ["Model"]

_here = os.path.dirname(__file__)


_analyses = {"plane strain": "Plane Strain MPM", "plane stress": "Plane Stress MPM", "axisymmetric": "Axisymmetric MPM",
             "3d": "3D MPM", "three-dimensional": "3D MPM"}


def _analysis(name):
    plain = name.lower().replace("mpm", "").replace("2d", "").replace("three dim", "three-dim").strip()
    if plain not in _analyses:
        raise ValueError(f"there is no analysis '{name}'; valid: {', '.join(_analyses)}")
    return _analyses[plain]


def _cells(name, axis, cell):
    """The number of cells along an axis of the grid."""
    if len(axis) not in (2, 3) or (len(axis) == 2 and cell is None):
        raise ValueError("grid() needs (low, high, cells) for each axis, or (low, high) and the size of the cell")
    texts = [part for part in axis if isinstance(part, str) and not isinstance(part, Expression)]
    if texts:
        raise ValueError(f"grid() needs (low, high, cells) along {name}, not '{texts[0]}'; an edge of another kind is given by "
                         f"grid_edge(), for example m.grid_edge(\"{name}min\", \"symmetry\", 0)")
    if len(axis) == 3:
        return axis[2]
    if any(isinstance(part, Expression) for part in (*axis, cell)):
        raise ValueError(f"along {name}, grid() cannot compute the number of cells from variables of the script; give (low, high, cells)")
    length = axis[1] - axis[0]
    cells = max(1, round(length / cell))
    if abs(length / cells - cell) > 1e-6 * cell:
        warn(f"grid(): {cells} cells of {length / cells:.6g} fill {axis[0]:g} to {axis[1]:g} along {name}, not cells of {cell:g}",
             ModelWarning)
    return cells


class _Block:
    """A command whose further lines end with another one; `with` writes it."""

    def __init__(self, model, end):
        self._model, self._end = model, end

    def __enter__(self):
        return self._model

    def __exit__(self, *error):
        self._model._add(self._end)
        return False


class Model:
    """A model, built with the commands of scripts.

        m = tribo.Model("plane strain", units=("m", "kg", "s"))
        m.grid(x=(0, 2), y=(0, 1), cell=0.05)
        m.material("steel", "LinearElastic", rho=7800, E=2e11, nu=0.3)
        m.body("steel", tribo.rect(0.5, 1, 0, 1), velocity=(10, 0))
        m.time(end=1e-3, courant=0.4)
        m.output(every=1e-4)

    Every command of scripts is a method with its name in lower case: `m.mpm_method("USL", "B2SPLINE")`. Commands with
    further lines are used with `with`: `with m.grid_bc(): m.rect(0, 1, 0, 0.1); m.velocity("x", "constant", 0)`.
    `script()` and `xml()` show the command file.

    `analysis` is "plane strain", "plane stress", "axisymmetric" or "3d" (also "three-dimensional"). Models in space have
    z in `grid`, three components of velocities, and the shapes `box`, `sphere`, `cylinder` and `surface`.
    """

    def __init__(self, analysis="plane strain", *, title=None, units=("m", "kg", "s"), name="model"):
        self.name = name
        self._lines, self._places = [], []
        self._thickness = 1
        self._has_output = False
        if title:
            self._add(f"Title {formatted(title)}")
        self._add(f"Analysis {formatted(_analysis(analysis))}")
        if units:
            self._add("ConsistentUnits " + ",".join(units))

    def _add(self, line):
        frame = sys._getframe(1)
        while frame.f_back and frame.f_code.co_filename.startswith(_here):
            frame = frame.f_back
        for _ in line.split("\n"):
            self._places.append((frame.f_code.co_filename, frame.f_lineno))
        self._lines.append(line)

    def _locate(self, error):
        """Adds to the problems of the script their places in the Python program."""
        for problem in error.problems:
            if problem.file == self.name and problem.line and problem.line <= len(self._places):
                problem.source = self._places[problem.line - 1]

    def script(self):
        """The model as a script, a command file that `tribo run` runs."""
        return "\n".join(self._lines) + "\n"

    def xml(self):
        """The model as an XML command file."""
        try:
            return _core.xml_of_text(self.script(), self.name, {})
        except InputError as error:
            self._locate(error)
            raise

    def save(self, path):
        """Writes the script to a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.script())

    def command(self, name, *values):
        """Any command of scripts by its name."""
        self._add(f"{name} {arguments(values)}".rstrip())

    def text(self, lines):
        """Lines of a script as they are, such as loops or the text of a header."""
        self._add(lines.strip("\n"))

    def variable(self, name, value):
        """A variable of the script, which `set` and `sweep` may change. Returns it for use in commands."""
        self._add(f"#{name}={formatted(value)}")
        return Expression(f"#{name}")

    def grid(self, x, y, z=None, *, cell=None, thickness=None):
        """The grid: (low, high, cells) along each axis, or (low, high) with the size of the `cell`.

        The edges are exact: a number of cells that is not whole is rounded, and a ModelWarning tells the size that
        follows. Planes of symmetry, walls and periodic edges are given by `grid_edge`, for example
        `m.grid_edge("xmin", "symmetry", 0)`.
        """
        axes = [axis for axis in (x, y, z) if axis is not None]
        if thickness is not None:
            self.command("GridThickness", thickness)
            self._thickness = thickness
        for name, command, axis in zip("xyz", ("GridHoriz", "GridVert", "GridDepth"), axes):
            self.command(command, _cells(name, axis, cell))
        self.command("GridRect", *(bound for axis in axes for bound in axis[:2]))

    def material(self, name, type=None, *, called=None, contact=None, properties=None, **more):
        """A material, contact law or joint law of a type, with its properties; see `tribo.parameters(type)`.

        `called` is its name in results, if that is another one than the name in commands. `contact` names the contact law with other materials: {other: law}. In a stage only the properties that change
        are given, without the type. `properties` is for names that are no names of Python.
        """
        self._add("Material " + (formatted(name) if type is None else arguments((name, called or name, type))))
        for key, value in {**(properties or {}), **more}.items():
            self._add(f"  {key} {formatted(value)}")
        for other, law in (contact or {}).items():
            self._add(f"  Contact {arguments((law, other))}")
        self._add("Done")

    def body(self, material, *shapes, velocity=(0, 0), thickness=None, **attributes):
        """A body of a material: its shapes, the initial velocity, and attributes of <Body> such as `angle`."""
        numbers = list(velocity) + ([thickness] if thickness is not None else [])
        if attributes and len(numbers) == 2:
            numbers.append(self._thickness)
        with self.region(material, *numbers, **attributes):
            self.shapes(*shapes)

    def shapes(self, *shapes):
        """Shapes, within a body or a condition."""
        for shape in shapes:
            for line in shape.lines():
                self._add("  " + line)

    def points(self, *points):
        """Corners (x, y) of a polygon, or of the `polygon_block` before them, or nuclei of the `voronoi` before them."""
        for point in points:
            self.command("PolyPt", *point)

    def prescribe(self, *shapes, x=None, y=None, z=None):
        """Velocities of the nodes in the shapes: numbers, or texts that are functions of t, x, y, z."""
        with self.grid_bc():
            self.shapes(*shapes)
            for axis, value in (("x", x), ("y", y), ("z", z)):
                if value is not None:
                    self.command("  Velocity", axis, "function" if isinstance(value, str) else "constant", value)

    def time(self, end, *, step=None, courant=None):
        """The end of the run, its largest time step and the step as a fraction of the stable one."""
        self.command("TimeStep", end if step is None else step, end, *([] if courant is None else [courant]))

    def output(self, every, *, after=None, history_every=None, fields=None):
        """The time between particle files, that between rows of the histories, and the fields of the files.

        A further call with `after` gives another time between particle files from a time on.
        """
        if after is None and self._has_output:
            raise ValueError("output() has been called before; a further interval of the particle files applies from a time on: "
                             "output(every, after=time)")
        self._has_output = True
        self.command("ArchiveTime", every, *([] if after is None else [after]))
        if history_every is not None:
            self.command("GlobalArchiveTime", history_every)
        if fields:
            self.command("ToArchive", *fields)

    def history(self, quantity, material=None, point=None, **of):
        """A column of the histories: a quantity of all, of a material, of the particle next to a point, of a `block` or
        of a `platen`."""
        values = ([material] if material is not None else []) + list(point or ())
        self.command("GlobalArchive", quantity, *values, *_pairs(of))

    def multimaterial_mpm(self, *values, impulses=None):
        """MultimaterialMPM: contact between materials.

        Arguments: [normals[, bias or azimuth[, polar]]], with the normals maxgrad, maxvol, avggrad, owngrad, specify,
        linreg or logreg. `impulses` is where the conditions of contact hold, "nodes" or "faces"; the program chooses it
        if it is not given (`tribo.doc("MultiMaterialMode")`).
        """
        self.command("MultimaterialMPM", *values)
        if impulses is not None:
            if impulses not in ("nodes", "faces"):
                raise ValueError(f"impulses are on 'nodes' or on 'faces', not '{impulses}'")
            self.xml_data("MPMHeader", f"<MultiMaterialMode Impulses='{impulses}'/>")

    def xml_data(self, section=None, text="", material=None):
        """XML that is added to a section of the file, for what has no command."""
        head = [] if section is None else [section] + ([material] if material else [])
        self._add(("XMLData " + ",".join(head)).rstrip())
        self._add(text.strip("\n"))
        self._add("EndXMLData")

    def run(self, **options):
        """See tribo.run."""
        from .running import run

        return run(self, **options)

    def check(self, **options):
        """See tribo.check."""
        from .running import check

        return check(self, **options)

    def simulate(self, **options):
        """See tribo.simulate."""
        from .simulation import simulate

        return simulate(self, **options)

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        similar = difflib.get_close_matches(name, dir(type(self)), 1)
        hint = f" (did you mean '{similar[0]}'?)" if similar else ""
        raise AttributeError(f"a model has no command '{name}'{hint}; tribo.keywords('command') names all")


def _python_name(command):
    spaced = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", command)
    return spaced.lower()


def _pairs(attributes):
    """Keyword arguments as pairs of a name and a value."""
    return [part for item in attributes.items() for part in item]


def _method(command, end, doc, has_attributes):
    if has_attributes:

        def method(self, *values, **attributes):
            self.command(command, *values, *_pairs(attributes))
            return _Block(self, end) if end else None

    elif end:

        def method(self, *values):
            self.command(command, *values)
            return _Block(self, end)

    else:

        def method(self, *values):
            self.command(command, *values)

    method.__name__ = _python_name(command)
    method.__qualname__ = f"Model.{method.__name__}"
    method.__doc__ = doc
    return method


def _add_commands():
    for command, _, _, expected, meaning in _core.commands():
        name = _python_name(command)
        if name in Model.__dict__ or name == "name":  # the name of the model; command("Name", ...) is the author
            continue
        end = re.search(r"up to (End\w+)", expected)
        how = f"\n\nArguments: {expected}." if expected else "\n\nWithout arguments."
        use = "\nUse it with `with`; the lines in between are further commands." if end else ""
        has_attributes = "attribute, value" in expected + meaning
        if has_attributes:
            use = "\nPairs of an attribute and its value may be keyword arguments." + use
        doc = f"{command}: {meaning}.{how}{use}"
        setattr(Model, name, _method(command, end.group(1) if end else None, doc, has_attributes))


_add_commands()
