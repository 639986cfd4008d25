"""Centre marks: a cross at the centre of every hole, on a layer of its own, for drill and punch."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from geneva_cli.curves.shapes import Circle, Contour, Line, Shape

LAYER = "CENTER"
BEYOND = 1.25  # of the hole's radius: how far a cross reaches


def centre_marks(holes: Iterable[Shape]) -> Iterator[Contour]:
    """Two lines across each round hole, level and upright.

    >>> [mark.segments[0].end for mark in centre_marks([Circle("BORE", (10.0, 0.0), 4.0)])]
    [(15.0, 0.0), (10.0, 5.0)]
    """
    for hole in holes:
        if isinstance(hole, Circle):
            (x, y), reach = hole.centre, BEYOND * hole.radius
            for dx, dy in ((reach, 0.0), (0.0, reach)):
                yield Contour(LAYER, (Line((x - dx, y - dy), (x + dx, y + dy)),), closed=False)
