"""A drawing's pieces as a file shows them: without duplicates or empty pieces."""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import segment_length
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Shape, closed, joined
from geneva_cli.geometry.sheet import Drawing

SHORTEST_MM = 1e-9  # no file shows a piece that is shorter, or the bend of one that is flatter


def prepared(drawing: Drawing) -> Drawing:
    """Drawing without duplicate shapes and pieces shorter than ``SHORTEST_MM``.

    Raises GenevaError for a coordinate that is not finite.
    """
    shapes: dict[Shape, None] = {}
    for shape in drawing.shapes:
        _require_finite(shape)
        if isinstance(shape, Circle):
            if shape.radius > SHORTEST_MM:
                shapes[shape] = None
            continue
        kept = []
        for one in shape.segments:
            if segment_length(one) > SHORTEST_MM:
                # the centre of an arc that is so flat would only be noise
                half = 0.5 * math.dist(one.start, one.end)
                flat = isinstance(one, Arc) and half * abs(one.bulge) < SHORTEST_MM
                kept.append(Line(one.start, one.end) if flat else one)
        if kept and shape.closed:
            shapes[closed(shape.layer, kept)] = None
        elif kept:
            shapes[Contour(shape.layer, joined(kept), closed=False)] = None
    return drawing._replace(shapes=tuple(shapes))


def _require_finite(shape: Shape) -> None:
    for piece in shape.segments if isinstance(shape, Contour) else (shape,):
        for value in piece:
            numbers = value if isinstance(value, tuple) else (value,)
            if not all(math.isfinite(n) for n in numbers if not isinstance(n, str)):
                kind = type(piece).__name__.lower()
                raise GenevaError(
                    f"layer {shape.layer}: a {kind} at {value}: coordinates must be finite"
                )
