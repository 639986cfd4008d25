"""The levels of turned parts: where one plate ends and the next one begins."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

from geneva_cli.geometry.moments import area, with_material_left
from geneva_cli.geometry.plates import Plate, Stack
from geneva_cli.geometry.shapes import Arc, Contour, Line, as_contour

Side: TypeAlias = Line | Arc


class Run(NamedTuple):
    """A piece of an outline, and the sense in which a face's edge runs along it."""

    side: Side
    forward: bool

    @property
    def piece(self) -> Side:
        """The piece in the edge's sense."""
        if self.forward:
            return self.side
        turned = self.side._replace(start=self.side.end, end=self.side.start)
        return turned._replace(bulge=-turned.bulge) if isinstance(turned, Arc) else turned


class Level(NamedTuple):
    """A face across the axis: its loops of edges, the outer one first.

    Seen against its normal, the face lies to the left of its edges.
    """

    z: float
    loops: tuple[tuple[Run, ...], ...]
    up: bool  # True if the material is below it


def outline_of(plate: Plate) -> Contour:
    """Return a plate's outline as lines and arcs, counterclockwise."""
    return with_material_left(as_contour(plate.outline), True)


def sides(contour: Contour) -> tuple[Side, ...]:
    """Return the pieces of a turned part's outline, which has no cubics."""
    return tuple(piece for piece in contour.segments if isinstance(piece, Line | Arc))


def levels(stack: Stack) -> list[Level]:
    """Return the faces across the axis of a turned part, from the lowest up.

    >>> from geneva_cli.geometry.shapes import Circle
    >>> wide, thin = Circle("", (0.0, 0.0), 5.0), Circle("", (0.0, 0.0), 4.0)
    >>> plates = Plate("", "", wide, (), 0.0, 3.0), Plate("", "", thin, (), 3.0, 9.0)
    >>> [(level.z, len(level.loops), level.up) for level in levels(Stack("", "", plates))]
    [(0.0, 1, False), (3.0, 2, True), (9.0, 1, True)]
    """
    outlines = [outline_of(plate) for plate in stack.plates]
    heights = [stack.low, *(plate.high for plate in stack.plates)]
    pairs = zip([None, *outlines], [*outlines, None], heights, strict=True)
    every = [_level(lower, upper, z) for lower, upper, z in pairs]
    return [level for level in every if level.loops]


def _level(lower: Contour | None, upper: Contour | None, z: float) -> Level:
    below, above = (sides(one) if one else () for one in (lower, upper))
    common = set(below) & set(above)
    runs = [Run(side, True) for side in below if side not in common]
    runs += [Run(side, False) for side in above if side not in common]
    sizes = [area(one) if one else 0.0 for one in (lower, upper)]
    loops = sorted(_loops(runs), key=_size, reverse=True)
    return Level(z, tuple(loops), sizes[0] > sizes[1])


def _loops(runs: list[Run]) -> list[tuple[Run, ...]]:
    """Return edges end to end, as closed loops."""
    starting = {run.piece.start: run for run in runs}
    loops = []
    while starting:
        loop = [starting.pop(next(iter(starting)))]
        while loop[-1].piece.end != loop[0].piece.start:
            loop.append(starting.pop(loop[-1].piece.end))
        loops.append(tuple(loop))
    return loops


def _size(loop: tuple[Run, ...]) -> float:
    return abs(area(Contour("", tuple(run.piece for run in loop))))
