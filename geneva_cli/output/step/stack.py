"""A turned part as one closed solid: its walls, and the faces between its steps."""

from __future__ import annotations

from geneva_cli.geometry.plates import Plate, Stack
from geneva_cli.geometry.shapes import Point
from geneva_cli.geometry.stacks import Level, Side, levels, outline_of, sides
from geneva_cli.output.solid_part import plate_contours
from geneva_cli.output.step.curves import curve, is_along, level
from geneva_cli.output.step.entities import Entities, closed_solid, edge, face, loop
from geneva_cli.output.step.solid import surface


def stack_solid(file: Entities, stack: Stack) -> str:
    """The number of the part's MANIFOLD_SOLID_BREP.

    Raises GenevaError for a coordinate that is not finite, or a step without thickness.
    """
    return closed_solid(file, _StackWriter(file, stack).faces())


class _StackWriter:
    """Writes one turned part; its vertices and edges are shared by its faces."""

    def __init__(self, file: Entities, stack: Stack) -> None:
        self.file, self.stack = file, stack
        self._vertices: dict[tuple[Point, float], str] = {}
        self._edges: dict[tuple[Side | Point, float], str] = {}

    def faces(self) -> list[str]:
        faces = []
        for plate in self.stack.plates:
            plate_contours(plate)  # refuses what is no solid
            faces += [self._wall(plate, side) for side in sides(outline_of(plate))]
        return [*faces, *(self._across(one) for one in levels(self.stack))]

    def _across(self, at: Level) -> str:
        loops = [
            loop(self.file, [(self._along(run.side, at.z), run.forward) for run in runs])
            for runs in at.loops
        ]
        return face(self.file, loops, level(self.file, at.z), at.up)

    def _wall(self, plate: Plate, side: Side) -> str:
        bounds = [
            (self._along(side, plate.low), True),
            (self._rise(side.end, plate), True),
            (self._along(side, plate.high), False),
            (self._rise(side.start, plate), False),
        ]
        # a cylinder's own normal points away from its axis, a plane's to the right
        around = loop(self.file, bounds)
        return face(self.file, [around], surface(self.file, side, plate), is_along(side))

    def _along(self, side: Side, z: float) -> str:
        """The edge along a piece at a height."""
        if (side, z) not in self._edges:
            ends = self._vertex(side.start, z), self._vertex(side.end, z)
            line = curve(self.file, side, z)
            self._edges[side, z] = edge(self.file, *ends, line, is_along(side))
        return self._edges[side, z]

    def _rise(self, at: Point, plate: Plate) -> str:
        """The edge up a corner of a step."""
        if (at, plate.low) not in self._edges:
            ends = self._vertex(at, plate.low), self._vertex(at, plate.high)
            line = f"LINE('',{self.file.point(at, plate.low)},{self.file.rise})"
            self._edges[at, plate.low] = edge(self.file, *ends, line, True)
        return self._edges[at, plate.low]

    def _vertex(self, at: Point, z: float) -> str:
        if (at, z) not in self._vertices:
            self._vertices[at, z] = self.file.add(f"VERTEX_POINT('',{self.file.point(at, z)})")
        return self._vertices[at, z]
