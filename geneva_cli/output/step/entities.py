"""Instances of a STEP file (ISO 10303-21): numbers, texts, points, placements, edges and faces."""

from __future__ import annotations

from collections.abc import Sequence

from geneva_cli.geometry.shapes import Point

LENGTH = 12  # decimals of lengths in mm: with large coordinates more than a double has
DIRECTION = 16  # decimals of directions, which act through a length


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

    def vertex(self, point: str) -> str:
        """A vertex at a point."""
        return self.add(f"VERTEX_POINT('',{point})")

    def edge(self, start: str, end: str, curve: str, along: bool = True) -> str:
        """An edge between two vertices, on a curve that is written once."""
        return self.add(f"EDGE_CURVE('',{start},{end},{self.shared(curve)},{_flag(along)})")

    def loop(self, edges: Sequence[tuple[str, bool]]) -> str:
        """A loop of edges end to end, each with its orientation."""
        sides = [self.add(f"ORIENTED_EDGE('',*,*,{edge},{_flag(along)})") for edge, along in edges]
        return self.add(f"EDGE_LOOP('',{listed(sides)})")

    def face(self, loops: list[str], surface: str, same: bool) -> str:
        """A face on a surface; ``same`` means that the normals have the same direction."""
        first, *inner = loops
        bounds = [self.add(f"FACE_OUTER_BOUND('',{first},.T.)")]
        bounds += [self.add(f"FACE_BOUND('',{loop},.T.)") for loop in inner]
        return self.add(f"ADVANCED_FACE('',{listed(bounds)},{surface},{_flag(same)})")

    def closed_solid(self, faces: list[str]) -> str:
        """The solid within a closed shell of faces."""
        shell = self.add(f"CLOSED_SHELL('',{listed(faces)})")
        return self.add(f"MANIFOLD_SOLID_BREP('',{shell})")


def _flag(value: bool) -> str:
    return ".T." if value else ".F."


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
