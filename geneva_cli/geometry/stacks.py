"""The levels of turned parts, and the walls between the holes of a plate."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import combinations
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.moments import area, with_material_left
from geneva_cli.geometry.plates import Plate, Stack
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Shape, as_contour

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
    """A face across the axis, to the left of its loops of edges; the outer one is the first."""

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
    """Return the faces across the axis of a turned part, from the lowest up."""
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
    starting = {run.piece.start: run for run in runs}
    loops = []
    while starting:  # edges end to end
        loop = [starting.pop(next(iter(starting)))]
        while loop[-1].piece.end != loop[0].piece.start:
            loop.append(starting.pop(loop[-1].piece.end))
        size = abs(area(Contour("", tuple(run.piece for run in loop))))
        loops.append((size, tuple(loop)))
    loops.sort(key=lambda each: each[0], reverse=True)
    return Level(z, tuple(loop for _, loop in loops), sizes[0] > sizes[1])


FINE, LONGEST = 1e-4, 0.5  # mm: sagitta and length of samples of a hole that is not a circle


def least_wall(holes: Sequence[Shape], outline: Sequence[Shape] = ()) -> float:
    """Return the least wall between holes, and to an outline; negative where they overlap."""
    least = [apart(one, two) for one, two in combinations(holes, 2)]
    if outline:
        whole = _boundary(outline)
        least += [-beyond(whole, hole) for hole in holes]
    return min(least, default=math.inf)


def plate_wall(plate: Plate) -> float:
    """Return the least wall between the holes of a plate, and around them."""
    return least_wall(plate.holes, [plate.outline])


def beyond(outline: Polyarc, hole: Shape) -> float:
    """Return how far a hole's edge reaches past an outline, mm; negative inside."""
    if isinstance(hole, Circle):
        return float(outline.signed(np.array([hole.centre]))[0]) + hole.radius
    return float(outline.signed(_points(hole)).max())


def apart(one: Shape, two: Shape) -> float:
    """Return the wall between two holes, mm; negative where they overlap."""
    if isinstance(one, Circle) and isinstance(two, Circle):
        return math.dist(one.centre, two.centre) - one.radius - two.radius
    if isinstance(one, Circle):
        one, two = two, one
    away = _boundary([one])
    if isinstance(two, Circle):
        return float(away.signed(np.array([two.centre]))[0]) - two.radius
    return float(away.signed(_points(two)).min())


def _points(hole: Shape) -> np.ndarray:
    return _boundary([hole]).samples(FINE, LONGEST)


def _boundary(shapes: Iterable[Shape]) -> Polyarc:
    return Polyarc([with_material_left(as_contour(shape), True) for shape in shapes])
