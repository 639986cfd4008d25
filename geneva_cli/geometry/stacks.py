"""The walls between the holes of a plate."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import combinations

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.moments import with_material_left
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import Circle, Shape, as_contour

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
