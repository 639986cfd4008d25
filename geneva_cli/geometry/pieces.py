"""A drawing's pieces as a file shows them: without duplicates or empty pieces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import segment_length
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Cubic,
    Line,
    Point,
    Segment,
    Shape,
    closed,
    joined,
)
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.table import Reading, Table, rows_table

SHORTEST_MM = 1e-9  # no file shows a piece that is shorter, or the bend of one that is flatter


def pieces_table(drawing: Drawing) -> Table:
    """Table with one row per segment or circle; contours and their pieces are counted from 1.

    It has columns for control points only if there are cubics. Raises GenevaError as
    ``prepared`` does.
    """
    rows = list[dict[str, Any]]()
    for number, shape in enumerate(prepared(drawing).shapes, 1):
        pieces = shape.segments if isinstance(shape, Contour) else (shape,)
        for i, piece in enumerate(pieces, 1):
            kind = type(piece).__name__.lower()
            row = {"layer": shape.layer, "contour": number, "piece": i, "kind": kind}
            # decimals beyond the twelfth are rounding
            rows.append(row | {k: round(v, 12) + 0.0 for k, v in _numbers(piece)})
    points = [f"{name}_mm" for name in ("x", "y", "end_x", "end_y", "center_x", "center_y")]
    names = ["layer", "contour", "piece", "kind", *points, "radius_mm", "sweep_deg"]
    if any(row["kind"] == "cubic" for row in rows):
        names += [f"control{k}_{axis}_mm" for k in (1, 2) for axis in "xy"]
    table = rows_table(names, [tuple(map(row.get, names)) for row in rows], drawing.title)
    # A narrow window keeps the kind of a piece, its start, and its circle.
    first = (*names[:6], "radius_mm", *points[4:], *points[2:4])
    return table.replaced(reading=Reading(first))


def _numbers(piece: Segment | Circle) -> Iterator[tuple[str, float]]:
    """Start, end, centre, radius, sweep in degrees and control points that a piece has."""
    places: dict[str, Point] = {}
    if not isinstance(piece, Circle):
        places = {"": piece.start, "end_": piece.end}
    if isinstance(piece, Cubic):
        places |= {"control1_": piece.first, "control2_": piece.second}
    if isinstance(piece, Arc | Circle):
        places["center_"] = piece.centre
        yield "radius_mm", piece.radius
        yield "sweep_deg", math.degrees(piece.sweep) if isinstance(piece, Arc) else 360.0
    for name, point in places.items():
        yield from zip((f"{name}x_mm", f"{name}y_mm"), point, strict=True)


def prepared(drawing: Drawing) -> Drawing:
    """Drawing without duplicate shapes and pieces shorter than ``SHORTEST_MM``.

    Raises GenevaError for a coordinate that is not finite.
    """
    shapes = dict.fromkeys(shape for original in drawing.shapes for shape in _cleaned(original))
    return drawing._replace(shapes=tuple(shapes))


def _cleaned(shape: Shape) -> Iterator[Shape]:
    _require_finite(shape)
    if isinstance(shape, Circle):
        if shape.radius > SHORTEST_MM:
            yield shape
        return
    kept = [_straightened(s) for s in shape.segments if segment_length(s) > SHORTEST_MM]
    if kept and shape.closed:
        yield closed(shape.layer, kept)
    elif kept:
        yield Contour(shape.layer, joined(kept), closed=False)


def _straightened(segment: Segment) -> Segment:
    """Replace an arc by a line if it is so flat that its centre would only be noise."""
    flat = isinstance(segment, Arc) and (
        0.5 * math.dist(segment.start, segment.end) * abs(segment.bulge) < SHORTEST_MM
    )
    return Line(segment.start, segment.end) if flat else segment


def _require_finite(shape: Shape) -> None:
    for piece in shape.segments if isinstance(shape, Contour) else (shape,):
        for value in piece:
            numbers = value if isinstance(value, tuple) else (value,)
            if not all(math.isfinite(n) for n in numbers if not isinstance(n, str)):
                kind = type(piece).__name__.lower()
                raise GenevaError(
                    f"layer {shape.layer}: a {kind} at {value}: coordinates must be finite"
                )
