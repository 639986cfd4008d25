"""A drawing's pieces as a file shows them: in its unit, without duplicates or empty pieces."""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.errors import GenevaError, cut
from geneva_cli.geometry.measure import mapped, segment_length
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Cubic,
    Line,
    Segment,
    Shape,
    closed,
    joined,
)
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.table import Reading, Table, rows_table

UNITS = {"mm": 1.0, "inch": 25.4}  # millimetres in one
SUFFIX = {"mm": "mm", "inch": "in"}
SHORTEST_MM = 1e-9  # no file shows a piece that is shorter, or the bend of one that is flatter


def pieces_table(drawing: Drawing, units: str = "mm") -> Table:
    """Table with one row per segment or circle; contours and their pieces are counted from 1.

    It has columns for control points only if there are cubics. ``units`` is mm or inch, and names
    the columns. Raises GenevaError as ``prepared`` does.
    """
    rows = []
    for number, shape in enumerate(prepared(drawing, units).shapes, 1):
        pieces = shape.segments if isinstance(shape, Contour) else (shape,)
        for i, piece in enumerate(pieces, 1):
            kind, values = _values(piece)
            # decimals beyond the twelfth are rounding
            shown = [None if v is None else round(v, 12) + 0.0 for v in values]
            rows.append((shape.layer, number, i, kind, *shown))
    points = ("x", "y", "end_x", "end_y", "center_x", "center_y", "radius")
    controls = ("control1_x", "control1_y", "control2_x", "control2_y")
    lengths = [f"{name}_{SUFFIX[units]}" for name in (*points, *controls)]
    names = ["layer", "contour", "piece", "kind", *lengths[:7], "sweep_deg", *lengths[7:]]
    if not any(row[3] == "cubic" for row in rows):
        names = names[:-4]
        rows = [row[:-4] for row in rows]
    # A narrow window keeps the kind of a piece, its start, and its circle.
    important = ("x", "y", "radius", "center_x", "center_y", "end_x", "end_y")
    first = [f"{name}_{SUFFIX[units]}" for name in important]
    reading = Reading(("layer", "contour", "piece", "kind", *first))
    return rows_table(names, rows, drawing.title).replaced(reading=reading)


def prepared(drawing: Drawing, units: str = "mm") -> Drawing:
    """Drawing in a unit, without duplicate shapes and pieces shorter than ``SHORTEST_MM``.

    The other pieces stay end to end. Raises GenevaError for another unit, and for a coordinate that
    is not finite.
    """
    if units not in UNITS:
        raise GenevaError(f"--units {cut(units)}: it must be one of {', '.join(UNITS)}")
    unit = UNITS[units]

    def divided(shape: Shape) -> Shape:
        # a single rounding, so that 25.4 mm are exactly 1 inch
        return mapped(shape, lambda p: (p[0] / unit, p[1] / unit), lambda radius: radius / unit)

    shapes = dict.fromkeys(shape for original in drawing.shapes for shape in _cleaned(original))
    return drawing._replace(shapes=tuple(map(divided, shapes)))


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


def _values(piece: Segment | Circle) -> tuple[str, tuple[float | None, ...]]:
    """Kind; and start, end, centre, radius, sweep in degrees and control points."""
    if isinstance(piece, Circle):
        return "circle", (*[None] * 4, *piece.centre, piece.radius, 360.0, *[None] * 4)
    ends = (*piece.start, *piece.end)
    if isinstance(piece, Cubic):
        return "cubic", (*ends, *[None] * 4, *piece.first, *piece.second)
    if isinstance(piece, Line):
        return "line", (*ends, *[None] * 8)
    sweep = math.degrees(piece.sweep)
    return "arc", (*ends, *piece.centre, piece.radius, sweep, *[None] * 4)
