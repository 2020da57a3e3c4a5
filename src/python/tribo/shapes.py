# SPDX-License-Identifier: MIT
"""Shapes of bodies and conditions, and values as a script has them."""

import os

__all__ = ["Expression", "Shape", "arguments", "box", "cut", "cylinder", "formatted", "oval", "polygon", "rect", "sphere",
           "surface"]


class Expression(str):
    """A text that the script takes as it is, such as an expression of its variables: Expression("2*#radius")."""


def formatted(value):
    """A value as a script has it."""
    if isinstance(value, Expression):
        return str(value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return "&quote&".join(f'"{part}"' for part in value.split('"'))
    if isinstance(value, int):
        return str(value)
    return repr(float(value))


def arguments(values):
    """Values with commas in between, as a script has them."""
    return ",".join(formatted(v) for v in values)


class Shape:
    """A shape of a script: a command with its numbers. `shape - hole` cuts a hole out of it."""

    def __init__(self, command, *numbers, holes=(), corners=None):
        self.command, self.numbers, self.holes, self.corners = command, numbers, tuple(holes), corners

    def __sub__(self, hole):
        return Shape(self.command, *self.numbers, holes=(*self.holes, hole), corners=self.corners)

    def lines(self, before=""):
        """The lines of the script, with a word before each command."""
        if self.corners is None:
            out = [f"{before}{self.command} {arguments(self.numbers)}"]
        else:
            out = [f"{before}PolyPt {arguments(corner)}" for corner in self.corners] + [f"{before}PolyPt"]
        for hole in self.holes:
            out += hole.lines("Cut ")
        return out


def rect(x0, x1, y0, y1):
    """A rectangle."""
    return Shape("Rect", x0, x1, y0, y1)


def oval(x0, x1, y0, y1):
    """An ellipse in a rectangle."""
    return Shape("Oval", x0, x1, y0, y1)


def polygon(*corners):
    """A polygon with the corners (x, y)."""
    return Shape("PolyPt", corners=corners)


def box(x0, x1, y0, y1, z0, z1):
    """A box."""
    return Shape("Box", x0, x1, y0, y1, z0, z1)


def sphere(x0, x1, y0, y1, z0, z1):
    """An ellipsoid in a box."""
    return Shape("Sphere", x0, x1, y0, y1, z0, z1)


def cylinder(x0, x1, y0, y1, z0, z1, axis):
    """A cylinder in a box, along an axis."""
    return Shape("Cylinder", x0, x1, y0, y1, z0, z1, axis)


def surface(file, scale=1, x=0, y=0, z=0, group=None):
    """The body in a closed surface: an STL, OBJ or PLY file, or a mesh of Gmsh (.msh), of which a physical `group` may be
    chosen. Its coordinates are multiplied by `scale` and then moved by (x, y, z)."""
    return Shape("Surface", os.fspath(file), scale, x, y, z, *([] if group is None else [group]))


def cut(shape, *holes):
    """A shape without some others."""
    for hole in holes:
        shape = shape - hole
    return shape
