"""The section of a machine along the line of centres, and balloons with the numbers of its items.

The section shows the faces that the plane of both axes cuts, at input angle 0. Items that it does
not cut have their balloons in the view of the assembled machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from geneva_cli.drawings.sheet.view import View
from geneva_cli.geometry.board import chords
from geneva_cli.geometry.measure import at, mapped
from geneva_cli.geometry.placed import in_place
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle, Point, Shape, two_arcs
from geneva_cli.geometry.sheet import HATCH, OUTLINE, line, rectangle
from geneva_cli.spec.written import length


class Face(NamedTuple):
    """A rectangle in which the plane cuts a plate, mm: along the line of centres, and upwards."""

    plate: Plate  # in its own frame
    left: float
    right: float

    @property
    def sides(self) -> tuple[Point, ...]:
        """The middles of its sides."""
        low, high = self.plate.low, self.plate.high
        x, z = 0.5 * (self.left + self.right), 0.5 * (low + high)
        return (x, high), (x, low), (self.right, z), (self.left, z)


def faces(members: Iterable[Member], scale: float) -> list[Face]:
    """Return the faces that the plane y = 0 cuts, by chords of 1.5 mm at a scale."""
    return [
        Face(own, left, right)
        for own, plate in in_place(members)
        for left, right in _spans((plate.outline, *plate.holes), scale)
    ]


def _spans(shapes: Iterable[Shape], scale: float) -> list[tuple[float, float]]:
    """Return the spans of the x axis inside of an outline and outside of its holes."""
    crossings: list[float] = []
    for shape in shapes:
        on_paper = mapped(shape, lambda p: (scale * p[0], scale * p[1]), lambda r: scale * r)
        for x, y, u, v in chords(on_paper).tolist():
            # chords that follow each other share their ends within rounding, 1e-9 mm
            if (round(y, 9) <= 0.0) != (round(v, 9) <= 0.0):
                crossings.append((x - y * (u - x) / (v - y)) / scale)
    ends = sorted(crossings)
    return [(a, b) for a, b in zip(ends[::2], ends[1::2], strict=True) if b - a > 1e-6]


def draw_section(view: View, cut: list[Face], axes: Iterable[float]) -> None:
    """Draw cut faces, hatched but for shafts, pins and rollers (ISO 128-3), and the whole height.

    ``axes`` are the places of the shafts' axes on the line of centres.
    """
    numbers = {plate: k for k, plate in enumerate(dict.fromkeys(face.plate for face in cut))}
    low, high = min(f.plate.low for f in cut), max(f.plate.high for f in cut)
    for face in cut:
        low_, high_ = face.plate.low, face.plate.high
        view.draw(rectangle("", face.left, low_, face.right, high_), OUTLINE)
        if face.plate.layer not in ("SHAFT", "ROLLER"):
            _hatch(view, face, numbers[face.plate])
    for x in axes:
        view.centre_line((x, low), (x, high))
    left = min(face.left for face in cut)
    view.linear((left, low), (left, high), 0.5 * math.pi, length(high - low))


def _hatch(view: View, face: Face, k: int) -> None:
    """Draw lines at 45 degrees, 2 mm apart on paper or 3, rising or falling by the plate."""
    rising, step = k % 2 == 0, (2.0 if k % 4 < 2 else 3.0) * math.sqrt(2.0) / view.scale
    (a, b), (c, d) = (face.left, face.right), (face.plate.low, face.plate.high)
    # a line x - z = level, or x + z = level, between its crossings with the sides
    least, most = (a - d, b - c) if rising else (a + c, b + d)
    for i in range(math.ceil(least / step), math.floor(most / step) + 1):
        level = i * step
        if rising:
            start, end = max(a, level + c), min(b, level + d)
            ends = (start, start - level), (end, end - level)
        else:
            start, end = max(a, level - d), min(b, level - c)
            ends = (start, level - start), (end, level - end)
        if end - start > 1e-9 * step:
            view.draw(line("", *ends), HATCH)


def balloons_in_section(view: View, cut: list[Face], items: Mapping[Plate, int]) -> None:
    """Draw a balloon at one face of each item."""
    widest: dict[int, list[Face]] = {}
    for face in sorted(cut, key=lambda f: f.left - f.right):
        widest.setdefault(items[face.plate], []).append(face)
    for item, some in sorted(widest.items()):
        view.balloon([side for face in some for side in face.sides], str(item))


def balloons(
    view: View, members: Iterable[Member], items: Mapping[Plate, int], without: set[int]
) -> None:
    """Draw balloons at the outlines of the items that have none yet."""
    tips: dict[int, list[Point]] = {}
    for own, plate in in_place(members):
        if items[own] not in without:
            tips.setdefault(items[own], []).extend(_around(plate.outline))
    for item, places in sorted(tips.items()):
        view.balloon(places, str(item))


def _around(shape: Shape) -> list[Point]:
    """Return the middles of an outline's longest pieces."""
    pieces = two_arcs(shape) if isinstance(shape, Circle) else shape.segments
    longest = sorted(pieces, key=lambda piece: -math.dist(piece.start, piece.end))
    return [at(piece, 0.5) for piece in longest[:8]]
