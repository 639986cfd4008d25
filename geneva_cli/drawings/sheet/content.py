"""The content of a flat machine's sheet, independent of its scale, and the sheet of its views.

The content is rows of the list, items and cut faces.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache, partial
from typing import Any, NamedTuple

from geneva_cli.drawings.parts_list import part_rows
from geneva_cli.drawings.sheet.composed import on_paper
from geneva_cli.drawings.sheet.cut import Face, balloons, balloons_in_section, draw_section, faces
from geneva_cli.drawings.sheet.paper import scale_name, smaller
from geneva_cli.drawings.sheet.view import Block, View
from geneva_cli.geometry.measure import bounds, bounds_of
from geneva_cli.geometry.plates import Member, Plate, Stack, plates, steps_of
from geneva_cli.geometry.shapes import Shape
from geneva_cli.geometry.sheet import Sheet
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.parts.alike import alike


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
    flat = ((i, one) for i, kind in kinds for one in kind if isinstance(one, Plate | Stack))
    items = {step: i for i, part in flat for step in steps_of(part)}
    # chords of 1.5 mm on a part of 500 mm: spans are within 0.1 mm on any paper
    cut = faces(members, 500.0 / max(sizes))
    return SheetContent(members, together, rows, max(sizes), area, items, cut)


class Views(NamedTuple):
    """The views of a flat machine's sheet at a scale: of its parts, and of all of them together."""

    parts: Callable[[float], Iterator[View]]
    together: Callable[[float], View]
    axes: tuple[float, ...]  # the shafts' x, for the section


def sheet_of(spec: Spec, shown: SheetContent, views: Views, fixed: Sequence[Block] = ()) -> Sheet:
    """Return a sheet of views, at half their scale the machine and its section if need be.

    ``fixed`` are tables, which have no scale. Raises GenevaError where no scale fits on one sheet.
    """

    @cache
    def whole(scale: float) -> Block:
        return views.together(scale).block()

    @cache
    def cut(scale: float) -> Block:
        return section(shown, views.axes, scale).block()

    def rest(scale: float) -> Iterator[list[Block]]:
        half = smaller(scale, 2.0)
        for of_cut, of_whole in ((scale, scale), (scale, half), (half, half)):
            yield [cut(of_cut), whole(of_whole)]

    def blocks(scale: float) -> tuple[list[Block], Callable[[], Iterator[list[Block]]]]:
        return [*(view.block() for view in views.parts(scale)), *fixed], partial(rest, scale)

    return on_paper(spec, shown.rows, shown.largest, blocks, shown.area)


def section(shown: SheetContent, axes: Iterable[float], scale: float) -> View:
    """Return the section along the line of centres, with balloons; ``axes`` are the shafts' x."""
    view = View(f"A-A ({scale_name(scale)})", scale)
    draw_section(view, shown.cut, axes)
    balloons_in_section(view, shown.cut, shown.items)
    return view


def mark_items(view: View, shown: SheetContent) -> None:
    """Draw where the section is, and balloons of the items that it does not cut."""
    box = bounds_of(shown.together)
    view.section((box.x0, 0.0), (box.x1, 0.0), "A")
    marked = {shown.items[face.plate] for face in shown.cut}
    balloons(view, shown.members, shown.items, marked)
