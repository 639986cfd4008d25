"""What the formats of sheets share: which lines are on which layer."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.curves.shapes import Contour, Shape
from geneva_cli.curves.sheet import DIMENSION, WIDTHS, Arrow, Sheet


def by_layer(sheet: Sheet) -> Iterator[tuple[str, list[Shape]]]:
    """The shapes of each layer, with the lines of the dimensions on theirs."""
    for layer in WIDTHS:
        found = [shape for shape in sheet.shapes if shape.layer == layer]
        if layer == DIMENSION:
            for measure in sheet.measures:
                found += [Contour(DIMENSION, (piece,), closed=False) for piece in measure.lines]
        if found:
            yield layer, found


def arrows(sheet: Sheet) -> list[Arrow]:
    """All arrows."""
    return [arrow for measure in sheet.measures for arrow in measure.arrows]
