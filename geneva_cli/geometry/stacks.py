"""The walls between the holes of a plate."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.moments import oriented, with_material_left
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import Circle, Shape, as_contour

if TYPE_CHECKING:
    from geneva_cli.geometry.plates import Edge


FINE, LONGEST = 1e-4, 0.5  # mm: sagitta and length of samples of a hole that is not a circle


def least_wall(holes: Sequence[Shape], outline: Sequence[Shape] = ()) -> float:
    """Return the least wall between holes, and to an outline; negative where they overlap.

    >>> least_wall([Circle("", (0.0, 0.0), 2.0), Circle("", (9.0, 0.0), 3.0)])
    4.0
    """
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


def require_faces(plate: Plate) -> None:
    """Raise GenevaError, naming the key, where the plate's edge cuts off a piece of a face."""
    edge = plate.edge
    if not edge.size:
        return
    from geneva_cli.geometry.inset import inset, lines_and_arcs

    try:
        for contour in oriented(plate.outline, plate.holes):
            inset(lines_and_arcs(contour), "", edge.size)
    except GenevaError as error:
        raise _no_edge(edge, str(error)) from None
    wall = plate_wall(plate)
    if wall <= 0.0:
        raise _no_edge(edge, f"holes of the {plate.name} leave no wall to round or chamfer")
    if wall <= 2.0 * edge.size:
        says = f"the {plate.name} has a wall of {wall:.4g} mm; it must be below {0.5 * wall:.4g}"
        raise _no_edge(edge, says)


def _no_edge(edge: Edge, says: str) -> GenevaError:
    return GenevaError(f"{edge.key} = {edge.size:g}: {says}", ("size", edge.key))
