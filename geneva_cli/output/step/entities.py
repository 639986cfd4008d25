"""Instances of a STEP file (ISO 10303-21): numbers, texts, points, placements, edges and faces."""

from collections.abc import Sequence
from typing import TypeAlias

from geneva_cli.geometry.sphere import POLE, Vector, combined

LENGTH = 12  # decimals of lengths in mm: with large coordinates more than a double has
DIRECTION = 16  # decimals of directions, which act through a length
ORIGIN, AHEAD = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)
Frame: TypeAlias = tuple[Vector, Vector, Vector]  # origin, axis, and x ahead


class Entities:
    """The lines of a data section; instances refer to each other by their ``#numbers``."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._shared: dict[str, str] = {}
        self.origin = self.placement()

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

    def point(self, at: Vector) -> str:
        """A point."""
        return self.shared(f"CARTESIAN_POINT('',{listed([real(value) for value in at])})")

    def direction(self, v: Vector) -> str:
        """A unit vector."""
        parts = listed([real(value, DIRECTION) for value in v])
        return self.shared(f"DIRECTION('',{parts})")

    def placement(self, at: Vector = ORIGIN, axis: Vector = POLE, ahead: Vector = AHEAD) -> str:
        """A frame at a point, with its axis up and its x ahead by default."""
        frame = self.point(at), self.direction(axis), self.direction(ahead)
        return self.shared(f"AXIS2_PLACEMENT_3D('',{','.join(frame)})")

    def line(self, at: Vector, along: Vector) -> str:
        """A line's text, from a point on it and its direction."""
        vector = self.shared(f"VECTOR('',{self.direction(along)},1.)")
        return f"LINE('',{self.point(at)},{vector})"

    def circle(self, at: Vector, radius: float, axis: Vector = POLE, ahead: Vector = AHEAD) -> str:
        """A circle's text, counterclockwise about its axis."""
        return f"CIRCLE('',{self.placement(at, axis, ahead)},{real(radius)})"

    def vertex(self, at: Vector) -> str:
        """A vertex at a point."""
        return self.add(f"VERTEX_POINT('',{self.point(at)})")

    def edge(self, start: str, end: str, curve: str, along: bool = True) -> str:
        """An edge between two vertices, on a curve that is written once."""
        return self.add(f"EDGE_CURVE('',{start},{end},{self.shared(curve)},{_flag(along)})")

    def rise(self, ends: Sequence[Vector], along: Vector) -> tuple[str, str, str]:
        """Vertices at two points, and the straight edge between them, which runs ``along``."""
        low, high = map(self.vertex, ends)
        return low, high, self.edge(low, high, self.line(ends[0], along))

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

    def tube(
        self, radius: float, levels: Sequence[float], outside: bool, frame: Frame
    ) -> tuple[str, str, str]:
        """Circles on two levels of a frame's axis, counterclockwise about it, and their wall."""
        at, axis, ahead = frame
        middles = [combined(axis, level, at, 1.0) for level in levels]
        starts = [combined(ahead, radius, middle, 1.0) for middle in middles]
        *ends, seam = self.rise(starts, axis)
        circles = [self.circle(middle, radius, axis, ahead) for middle in middles]
        low, high = map(self.edge, ends, ends, circles)
        around = self.loop([(low, outside), (seam, True), (high, not outside), (seam, False)])
        place = self.placement(middles[0], axis, ahead)
        surface = self.add(f"CYLINDRICAL_SURFACE('',{place},{real(radius)})")
        return low, high, self.face([around], surface, outside)

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
