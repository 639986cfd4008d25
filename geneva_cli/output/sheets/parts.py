"""Shared parts of the sheets' formats: the lines of each layer."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.curves.shapes import Contour, Shape
from geneva_cli.curves.sheet import DIMENSION, WIDTHS, Arrow, Sheet


def by_layer(sheet: Sheet) -> Iterator[tuple[str, list[Shape]]]:
    """The shapes of each layer, including the lines of its dimensions."""
    for layer in WIDTHS:
        shapes = [shape for shape in sheet.shapes if shape.layer == layer]
        if layer == DIMENSION:
            for measure in sheet.measures:
                shapes += [Contour(DIMENSION, (piece,), closed=False) for piece in measure.lines]
        if shapes:
            yield layer, shapes


def arrows(sheet: Sheet) -> list[Arrow]:
    """All arrows of the sheet's dimensions."""
    return [arrow for measure in sheet.measures for arrow in measure.arrows]
