"""All views of a machine's sheet."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from geneva_cli.curves.measure import bounds
from geneva_cli.curves.plates import plates
from geneva_cli.curves.shapes import Shape
from geneva_cli.parts import drawings
from geneva_cli.parts.arm import CrankArm
from geneva_cli.parts.first_pair import first_outlines
from geneva_cli.parts.gear_drawings import gear_shapes
from geneva_cli.parts.machine_drawing import machine_and_parts
from geneva_cli.parts.model import PartsModel
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.parts_list import part_rows
from geneva_cli.parts.placed import PlacedParts
from geneva_cli.parts.sheet import wheel
from geneva_cli.parts.sheet.crank import draw_arm, draw_assembly, draw_disc
from geneva_cli.parts.sheet.linked import (
    Begin,
    flat_plates,
    geared,
    linked,
    rolling,
    shafted,
    titled,
)
from geneva_cli.parts.sheet.paper import scale_name
from geneva_cli.parts.sheet.standing import draw_frame, draw_groove
from geneva_cli.parts.sheet.view import View

HUB = "crank's hub"  # stands on the disc
APART = {"WHEEL", "ARM"}  # layers of which each plate has a view


class SheetContent(NamedTuple):
    """The content of a sheet, independent of its scale."""

    outlines: Outlines
    together: tuple[Shape, ...]
    rows: list[dict[str, Any]]  # the list of parts
    built: PlacedParts[CrankArm]
    first: Outlines | None
    groove: tuple[Shape, ...]  # flanks and pitch curve, of a cam
    gears: list[Shape]  # pitch curves and bores, of noncircular ones
    largest: float  # mm: a part's width or height
    area: float  # mm², of the boxes about some parts: the views need more than that
    tolerance: float
    curves: str


def shown_on_sheet(parts: Outlines, tolerance: float, curves: str) -> SheetContent:
    """Return the content of the views, computed once for all scales."""
    mechanism, cam = parts.assembly.full, parts.assembly.rollers[0][0].groove is not None
    whole, built = machine_and_parts(parts, tolerance, curves)
    rows: list[dict[str, Any]] = list(part_rows(mechanism.spec, built.members))
    sizes = [row[f"size_{axis}_mm"] for row in rows for axis in "xy"]
    *_, lowest = flat_plates(built.standing)
    apart = [
        bounds(plate.outline)
        for one in built.members
        for plate in plates(one.part)
        if plate.layer in APART
    ]
    boxes = [*apart, bounds(lowest.outline)]
    return SheetContent(
        parts,
        whole.shapes,
        rows,
        built,
        first_outlines(mechanism, built.links),
        drawings.groove(parts, tolerance, curves).shapes if cam else (),
        gear_shapes(PartsModel(mechanism, parts), tolerance, curves),
        max(sizes),
        sum((box.x1 - box.x0) * (box.y1 - box.y0) for box in boxes),
        tolerance,
        curves,
    )


def views(shown: SheetContent, scale: float) -> Iterator[View]:
    """Yield a view of each part."""
    begin = titled(shown.rows, scale)
    yield from _wheels(shown, begin)
    yield from _crank(shown, begin)
    yield from _links(shown, begin)
    yield from _standing(shown, begin)


def _wheels(shown: SheetContent, begin: Begin) -> Iterator[View]:
    """Yield the views of wheels and locking discs; of two wheels in series, of both."""
    for front, of in (("", shown.outlines), ("first ", shown.first)):
        if of is None:
            continue
        view = begin(f"{front}wheel", f"{front}wheel's hub")
        wheel.draw_wheel(view, of, shown.tolerance, shown.curves)
        yield view
        if of.crank:
            view = begin(
                *(f"{front}{name}" for name in ("locking disc", "locking sector", HUB)),
            )
            draw_disc(view, of)
            yield view


def _crank(shown: SheetContent, begin: Begin) -> Iterator[View]:
    """Yield the views of the arm and of the roller with its pin."""
    if shown.built.arm:
        view = begin("arm")
        draw_arm(view, shown.outlines, shown.built.arm)
        yield view
    yield from rolling(begin, shown.outlines.assembly.mechanism)


def _links(shown: SheetContent, begin: Begin) -> Iterator[View]:
    """Yield the views of links, and of gears by their pitch curves."""
    bars, mechanism = shown.built.links, shown.outlines.assembly.full
    yield from linked(begin, bars, mechanism, series=bool(shown.first))
    yield from geared(begin, shown.gears, mechanism)


def _standing(shown: SheetContent, begin: Begin) -> Iterator[View]:
    """Yield the views of shafts, and of the plates that stand still."""
    yield from shafted(begin, shown.built.shafts)
    *grooved, lowest = flat_plates(shown.built.standing)
    if shown.groove:
        view = begin(*(plate.name for plate in grooved), "groove")
        draw_groove(
            view, shown.groove, shown.outlines.sizes.half_width, grooved[0] if grooved else None
        )
        yield view
    view = begin(lowest.name)
    draw_frame(view, lowest)
    yield view


def together(shown: SheetContent, scale: float) -> View:
    """Return the view of the assembled machine."""
    view = View(f"assembly ({scale_name(scale)})", scale)
    draw_assembly(view, shown.outlines, shown.together)
    return view
