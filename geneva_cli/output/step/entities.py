"""Instances of a STEP file (ISO 10303-21): numbers, texts, points, placements, edges and faces."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.geometry.shapes import Arc, Line, Point
from geneva_cli.output.splines import Piece

LENGTH = 12  # decimals of lengths in mm: with large coordinates more than a double has
DIRECTION = 16  # decimals of directions, which act through a length


class SolidCorner(NamedTuple):
    """A corner of a contour: its lower and upper vertex, and the edge between them."""

    low: str
    high: str
    edge: str


class WallFace(NamedTuple):
    """The face over one piece of a contour, and its edges in the solid's lower and upper face."""

    face: str
    low: str
    high: str
    along: bool  # True if the edges run in the contour's direction


class Entities:
    """The lines of a data section; instances refer to each other by their ``#numbers``."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._shared: dict[str, str] = {}
        self.up = self.direction(0.0, 0.0, 1.0)
        self.ahead = self.direction(1.0, 0.0, 0.0)
        self.rise = self.shared(f"VECTOR('',{self.up},1.)")
        self.origin = self.placement((0.0, 0.0), 0.0)

    def add(self, text: str) -> str:
        """Add an instance and return its number."""
        number = f"#{len(self.lines) + 1}"
        self.lines.append(f"{number}={text};\n")
        return number

    def shared(self, text: str) -> str:
        """Return the number of an instance that is written once, however often it is requested.

        Only for geometry: two solids may touch without sharing an edge.
        """
        if text not in self._shared:
            self._shared[text] = self.add(text)
        return self._shared[text]

    def point(self, at: Point, z: float) -> str:
        """A point at a height."""
        place = ",".join(real(value, LENGTH) for value in (*at, z))
        return self.shared(f"CARTESIAN_POINT('',({place}))")

    def direction(self, x: float, y: float, z: float = 0.0) -> str:
        """A unit vector."""
        parts = ",".join(real(value, DIRECTION) for value in (x, y, z))
        return self.shared(f"DIRECTION('',({parts}))")

    def placement(self, at: Point, z: float, axis: str = "", ahead: str = "") -> str:
        """A frame at a point, with its axis up and its x ahead by default."""
        point = self.point(at, z)
        return self.shared(
            f"AXIS2_PLACEMENT_3D('',{point},{axis or self.up},{ahead or self.ahead})"
        )


def real(value: float, decimals: int = LENGTH) -> str:
    """A number in the format's notation, with a point and without an exponent."""
    text = f"{value:.{decimals}f}".rstrip("0")
    return text if text != "-0." else "0."


def listed(numbers: list[str]) -> str:
    """Instances as a list."""
    return f"({','.join(numbers)})"


def words(text: str) -> str:
    """A text in quotation marks; letters beyond ASCII by their code points."""
    out = ""
    for c in text:
        if " " <= c <= "~":
            out += {"'": "''", "\\": "\\\\"}.get(c, c)
        else:
            out += f"\\X2\\{ord(c):04X}\\X0\\" if c < "\U00010000" else f"\\X4\\{ord(c):08X}\\X0\\"
    return f"'{out}'"


def edge(file: Entities, start: str, end: str, curve: str, along: bool) -> str:
    """An edge between two vertices, on a curve that is written once."""
    return file.add(f"EDGE_CURVE('',{start},{end},{file.shared(curve)},{_flag(along)})")


def loop(file: Entities, edges: list[tuple[str, bool]]) -> str:
    """A loop of edges end to end, each with its orientation."""
    sides = [file.add(f"ORIENTED_EDGE('',*,*,{edge},{_flag(along)})") for edge, along in edges]
    return file.add(f"EDGE_LOOP('',{listed(sides)})")


def face(file: Entities, loops: list[str], surface: str, same: bool) -> str:
    """A face on a surface; ``same`` means that the normals have the same direction."""
    first, *inner = loops
    bounds = [file.add(f"FACE_OUTER_BOUND('',{first},.T.)")]
    bounds += [file.add(f"FACE_BOUND('',{loop},.T.)") for loop in inner]
    return file.add(f"ADVANCED_FACE('',{listed(bounds)},{surface},{_flag(same)})")


def _flag(value: bool) -> str:
    return ".T." if value else ".F."


def closed_solid(file: Entities, faces: list[str]) -> str:
    """The solid within a closed shell of faces."""
    shell = file.add(f"CLOSED_SHELL('',{listed(faces)})")
    return file.add(f"MANIFOLD_SOLID_BREP('',{shell})")


def level(file: Entities, z: float) -> str:
    """The plane across the axis at a height."""
    return file.add(f"PLANE('',{file.placement((0.0, 0.0), z)})")


def curve(file: Entities, piece: Piece, z: float) -> str:
    """The text of a piece's curve."""
    if isinstance(piece, Line):
        vector = file.shared(f"VECTOR('',{file.direction(*unit_of(piece))},1.)")
        return f"LINE('',{file.point(piece.start, z)},{vector})"
    if isinstance(piece, Arc):
        return circle_at(file, piece.centre, piece.radius, z)
    points = listed([file.point(pole, z) for pole in piece.poles])
    count, knots = knots_of(piece.knots)
    return (
        f"B_SPLINE_CURVE_WITH_KNOTS('',3,{points},.UNSPECIFIED.,.F.,.F.,{count},{knots},"
        ".UNSPECIFIED.)"
    )


def is_along(piece: Piece) -> bool:
    """Return True if a piece runs as its curve does: all but arcs that turn clockwise."""
    return not isinstance(piece, Arc) or piece.bulge > 0.0


def knots_of(ends: Sequence[float]) -> tuple[str, str]:
    """The multiplicity of each knot, two where a cubic is once differentiable, and the knots."""
    count = listed(["4", *["2"] * (len(ends) - 2), "4"])
    return count, listed([real(end / ends[-1], DIRECTION) for end in ends])


def unit_of(line: Line) -> Point:
    """The direction of a line."""
    (x0, y0), (x1, y1) = line
    length = math.dist(line.start, line.end)
    return (x1 - x0) / length, (y1 - y0) / length


def circle_at(file: Entities, centre: Point, radius: float, z: float) -> str:
    """The text of a circle at a height."""
    return f"CIRCLE('',{file.placement(centre, z)},{real(radius)})"
