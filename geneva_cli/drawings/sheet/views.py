"""All views of a machine's sheet."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from geneva_cli.curves.measure import bounds
from geneva_cli.curves.plates import Plate, Stack, plates
from geneva_cli.curves.shapes import Shape
from geneva_cli.drawings.machine_drawing import machine
from geneva_cli.drawings.parts_list import part_rows
from geneva_cli.drawings.sheet.crank import draw_arm, draw_assembly, draw_disc
from geneva_cli.drawings.sheet.cut import (
    Face,
    balloons,
    balloons_in_section,
    draw_section,
    faces,
    steps,
)
from geneva_cli.drawings.sheet.linked import (
    Begin,
    flat_plates,
    geared,
    linked,
    rolling,
    shafted,
    titled,
)
from geneva_cli.drawings.sheet.paper import scale_name
from geneva_cli.drawings.sheet.standing import draw_frame, draw_groove
from geneva_cli.drawings.sheet.view import View
from geneva_cli.drawings.sheet.wheel import draw_wheel
from geneva_cli.layout.alike import alike
from geneva_cli.parts.flat_parts import FlatParts


class SheetContent(NamedTuple):
    """The content of a sheet, independent of its scale."""

    parts: FlatParts
    together: tuple[Shape, ...]
    rows: list[dict[str, Any]]  # the list of parts
    largest: float  # mm: a part's width or height
    area: float  # mm², of the boxes about some parts: the views need more than that
    items: dict[Plate, int]  # the number of each kind of plate in the list
    cut: list[Face]  # the faces of the section


def shown_on_sheet(parts: FlatParts) -> SheetContent:
    """Return the content of the views, computed once for all scales."""
    every = [one.part for one in parts.members]
    rows: list[dict[str, Any]] = list(part_rows(parts.mechanism.spec, every))
    sizes = [row[f"size_{axis}_mm"] for row in rows for axis in "xy"]
    # each plate of these layers has a view
    apart = [one for part in every for one in plates(part) if one.layer in ("WHEEL", "ARM")]
    boxes = [bounds(plate.outline) for plate in (*apart, *plates(parts.frame.part))]
    area = sum((box.x1 - box.x0) * (box.y1 - box.y0) for box in boxes)
    kinds = enumerate(alike(every), 1)
    flat = ((i, kind[0]) for i, kind in kinds if isinstance(kind[0], Plate | Stack))
    items = {step: i for i, part in flat for step in steps(part)}
    # chords of 1.5 mm on a part of 500 mm: spans are within 0.1 mm on any paper
    cut = faces(parts.members, 500.0 / max(sizes))
    return SheetContent(parts, machine(parts).shapes, rows, max(sizes), area, items, cut)


def views(shown: SheetContent, scale: float) -> Iterator[View]:
    """Yield a view of each part."""
    parts = shown.parts
    begin = titled(shown.rows, scale, parts.mechanism.spec.size.process)
    yield from _wheels(parts, begin)
    if parts.arm:
        view = begin("arm")
        draw_arm(view, parts.mechanism, parts.arm)
        yield view
    yield from rolling(begin, parts.mechanism)
    yield from linked(begin, parts)
    yield from geared(begin, parts)
    yield from _standing(parts, begin)


def _wheels(parts: FlatParts, begin: Begin) -> Iterator[View]:
    """Yield the views of wheels and locking discs; of two wheels in series, of both."""
    for front, of in (("", parts), ("first ", parts.front)):
        if of is None:
            continue
        view = begin(f"{front}wheel", f"{front}wheel's hub")
        draw_wheel(view, of)
        yield view
        if of.outlines.crank:
            view = begin(
                *(f"{front}{name}" for name in ("locking disc", "locking sector", "crank's hub")),
            )
            draw_disc(view, of)
            yield view


def _standing(parts: FlatParts, begin: Begin) -> Iterator[View]:
    """Yield the views of shafts, and of the plates that stand still."""
    yield from shafted(begin, parts.shafts)
    grooved = flat_plates(parts.groove_plate)
    if grooved:
        view = begin(*(plate.name for plate in grooved), "groove")
        draw_groove(view, parts.groove, parts.outlines.sizes.half_width, grooved[0])
        yield view
    (frame,) = flat_plates([parts.frame])
    view = begin(frame.name)
    draw_frame(view, frame)
    yield view


def section(shown: SheetContent, scale: float) -> View:
    """Return the section along the line of centres, with balloons."""
    view = View(f"A-A ({scale_name(scale)})", scale)
    draw_section(view, shown.cut, (0.0, shown.parts.outlines.assembly.L))
    balloons_in_section(view, shown.cut, shown.items)
    return view


def together(shown: SheetContent, scale: float) -> View:
    """Return the view of the assembled machine, with balloons of what the section does not cut."""
    view = View(f"assembly ({scale_name(scale)})", scale)
    draw_assembly(view, shown.parts.outlines, shown.together)
    boxes = [bounds(shape) for shape in shown.together]
    ends = ((min(box.x0 for box in boxes), 0.0), (max(box.x1 for box in boxes), 0.0))
    view.section(*ends, "A")
    marked = {shown.items[face.plate] for face in shown.cut}
    balloons(view, shown.parts.members, shown.items, marked)
    return view
