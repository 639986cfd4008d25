"""Centre marks: a cross on its own layer at the centre of every hole, for drill and punch."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from geneva_cli.geometry.drawing import Drawing
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Shape


def with_centre_marks(drawing: Drawing) -> Drawing:
    """Return a drawing with marks in circles and keyed bores, one for concentric ones.

    >>> bore, roller = Circle("BORE", (0.0, 0.0), 4.0), Circle("ROLLER", (0.0, 0.0), 8.0)
    >>> marked = with_centre_marks(Drawing("disc", (roller, bore)))
    >>> [mark.segments[0].end for mark in marked.shapes[2:]]
    [(5.0, 0.0), (0.0, 5.0)]
    """
    least: dict[tuple[float, float], Circle] = {}
    for circle in _circles(drawing.shapes):
        known = least.get(circle.centre, circle)
        least[circle.centre] = min(known, circle, key=lambda one: one.radius)
    return drawing._replace(shapes=(*drawing.shapes, *centre_marks(least.values())))


def _circles(shapes: Iterable[Shape]) -> Iterator[Circle]:
    """Yield circles, and round holes with a keyway as circles."""
    for shape in shapes:
        if shape.layer == "PITCH":  # lines that are not cut
            continue
        if isinstance(shape, Circle):
            yield shape
        elif shape.layer == "BORE":
            arcs = [piece for piece in shape.segments if isinstance(piece, Arc)]
            for arc in sorted(arcs, key=lambda one: -one.radius)[:1]:  # dog bones are smaller
                x, y = (round(v, 9) + 0.0 for v in arc.centre)  # mm; removes rounding errors
                yield Circle(shape.layer, (x, y), arc.radius)


def centre_marks(holes: Iterable[Circle]) -> Iterator[Contour]:
    """Yield two lines across each hole, horizontal and vertical.

    >>> [mark.segments[0].end for mark in centre_marks([Circle("BORE", (10.0, 0.0), 4.0)])]
    [(15.0, 0.0), (10.0, 5.0)]
    """
    for hole in holes:
        (x, y), reach = hole.centre, 1.25 * hole.radius  # half the length of a cross
        for dx, dy in ((reach, 0.0), (0.0, reach)):
            yield Contour("CENTER", (Line((x - dx, y - dy), (x + dx, y + dy)),), closed=False)
