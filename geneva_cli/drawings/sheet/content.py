"""The content of a flat machine's sheet, independent of its scale, its section and its balloons.

The content is rows of the list, items and cut faces.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, partial
from typing import Any, NamedTuple

from geneva_cli.drawings.parts_list import part_rows
from geneva_cli.drawings.sheet.composed import on_paper
from geneva_cli.drawings.sheet.paper import scale_name, smaller
from geneva_cli.drawings.sheet.view import Block, View
from geneva_cli.geometry.board import chords
from geneva_cli.geometry.measure import at, bounds, bounds_of, mapped
from geneva_cli.geometry.plates import Member, Plate, in_place, plates
from geneva_cli.geometry.shapes import Circle, Point, Shape, two_arcs
from geneva_cli.geometry.sheet import HATCH, OUTLINE, Sheet, line, rectangle
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.parts.projection import alike
from geneva_cli.spec.written import length


class SheetContent(NamedTuple):
    """The content of a sheet, independent of its scale."""

    members: tuple[Member, ...]  # all parts at their positions
    together: tuple[Shape, ...]  # what the assembled machine shows of them
    rows: list[dict[str, Any]]  # the list of parts
    largest: float  # mm: a part's width or height
    area: float  # mm², of the boxes about some parts: the views need more than that
    items: dict[Plate, int]  # the number of each kind of plate in the list
    cut: list[Face]  # the faces of the section


def shown_on_sheet(
    spec: Spec, members: tuple[Member, ...], together: tuple[Shape, ...]
) -> SheetContent:
    """Return the content of the views, computed once for all scales."""
    every = [one.part for one in members]
    rows: list[dict[str, Any]] = list(part_rows(spec, every))
    sizes = [row[f"size_{axis}_mm"] for row in rows for axis in "xy"]
    # each plate of these layers has a view, and so has the frame
    apart = [one for part in every for one in plates(part) if one.layer in ("WHEEL", "ARM")]
    boxes = [bounds(plate.outline) for plate in (*apart, *plates(every[-1]))]
    area = sum((box.x1 - box.x0) * (box.y1 - box.y0) for box in boxes)
    kinds = enumerate(alike(every), 1)
    items = {one: i for i, kind in kinds for one in kind if isinstance(one, Plate)}
    # chords of 1.5 mm on a part of 500 mm: spans are within 0.1 mm on any paper
    cut = faces(members, 500.0 / max(sizes))
    return SheetContent(members, together, rows, max(sizes), area, items, cut)


def sheet_of(
    spec: Spec,
    shown: SheetContent,
    parts: Callable[[float], Iterator[View]],
    together: Callable[[View], None],
    axes: tuple[float, ...],
    fixed: Sequence[Block] = (),
) -> Sheet:
    """Return a sheet of a flat machine, at half their scale the machine and its section if need be.

    ``parts`` returns the views of each part at a scale, and ``together`` draws the machine.
    ``axes`` are the shafts' x, for the section. ``fixed`` are tables, which have no scale. Raises
    GenevaError where no scale fits on one sheet.
    """

    @cache
    def whole(scale: float) -> Block:
        view = View(f"assembly ({scale_name(scale)})", scale)
        together(view)
        box = bounds_of(shown.together)
        view.section((box.x0, 0.0), (box.x1, 0.0), "A")
        marked = {shown.items[face.plate] for face in shown.cut}
        tips: dict[int, list[Point]] = {}
        for own, plate in in_place(shown.members):
            if shown.items[own] not in marked:
                tips.setdefault(shown.items[own], []).extend(_around(plate.outline))
        _balloons(view, tips)
        return view.block()

    @cache
    def cut(scale: float) -> Block:
        view = View(f"A-A ({scale_name(scale)})", scale)
        _draw_section(view, shown.cut, axes)
        sides: dict[int, list[Point]] = {}
        for face in sorted(shown.cut, key=lambda f: f.left - f.right):
            sides.setdefault(shown.items[face.plate], []).extend(face.sides)
        _balloons(view, sides)
        return view.block()

    def rest(scale: float) -> Iterator[list[Block]]:
        half = smaller(scale, 2.0)
        for of_cut, of_whole in ((scale, scale), (scale, half), (half, half)):
            yield [cut(of_cut), whole(of_whole)]

    def blocks(scale: float) -> tuple[list[Block], Callable[[], Iterator[list[Block]]]]:
        return [*(view.block() for view in parts(scale)), *fixed], partial(rest, scale)

    return on_paper(spec, shown.rows, shown.largest, blocks, shown.area)


def _balloons(view: View, tips: Mapping[int, Iterable[Point]]) -> None:
    """Draw the balloon of each item at one of some places."""
    for item, places in sorted(tips.items()):
        view.balloon(places, str(item))


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


def _draw_section(view: View, cut: list[Face], axes: Iterable[float]) -> None:
    """Draw cut faces and the height; all but rods are hatched (ISO 128-3)."""
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


def _around(shape: Shape) -> list[Point]:
    pieces = two_arcs(shape) if isinstance(shape, Circle) else shape.segments
    longest = sorted(pieces, key=lambda piece: -math.dist(piece.start, piece.end))
    return [at(piece, 0.5) for piece in longest[:8]]
