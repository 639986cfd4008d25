"""The drawing sheet of a machine: dimensioned parts, the list of items and a title block.

The assembled machine and its section are drawn at the scale of the parts, or at half of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TypeAlias

from geneva_cli.drawings.part_drawings import machine
from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.content import SheetContent, sheet_of, shown_on_sheet
from geneva_cli.drawings.sheet.crank_views import (
    draw_arm,
    draw_assembly,
    draw_disc,
    draw_link,
    draw_roller,
    round_parts,
)
from geneva_cli.drawings.sheet.paper import table
from geneva_cli.drawings.sheet.standing import draw_frame, draw_groove, draw_shaft
from geneva_cli.drawings.sheet.view import Block, View
from geneva_cli.drawings.sheet.wheel_views import draw_wheel
from geneva_cli.geometry.plates import Group, Member, Plate, Shell
from geneva_cli.geometry.shapes import Circle
from geneva_cli.geometry.sheet import Sheet
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Dimension, Pivot
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.shafts.fits import Fits
from geneva_cli.spec.written import length, number


def sheet(parts: FlatParts) -> Sheet:
    """Return the drawing sheet of a machine. Raises GenevaError where no scale fits on one."""
    mechanism, L = parts.mechanism, parts.mechanism.center_distance_mm
    shown = shown_on_sheet(mechanism.spec, parts.members, machine(parts).shapes)
    fixed = [
        *round_parts((*parts.links.joined, *parts.spacers), mechanism),
        *layout(mechanism),
    ]

    def together(view: View) -> None:
        draw_assembly(view, parts.outlines, shown.together)

    views = partial(_views, shown, parts)
    return sheet_of(mechanism.spec, shown, views, together, (0.0, L), fixed)


def _views(shown: SheetContent, parts: FlatParts, scale: float) -> Iterator[View]:
    begin = titled(shown.rows, scale, parts)
    yield from _wheels(parts, begin)
    if parts.arm:
        view = begin("arm")
        draw_arm(view, parts.mechanism, parts.arm)
        yield view
    yield from rolling(begin, parts.mechanism)
    yield from linked(begin, parts)
    yield from _standing(parts, begin)


def _wheels(parts: FlatParts, begin: Begin) -> Iterator[View]:
    for front, of in zip(("", "first "), (parts, *parts.in_front), strict=False):
        view = begin(f"{front}wheel", f"{front}wheel's hub")
        draw_wheel(view, of)
        yield view
        if of.outlines.crank:
            view = begin(
                *(f"{front}{name}" for name in ("locking disc", "locking sector", "crank's hub"))
            )
            draw_disc(view, of)
            yield view


def _standing(parts: FlatParts, begin: Begin) -> Iterator[View]:
    yield from shafted(begin, parts.shafts)
    grooved = flat_plates(parts.groove_plate)
    if grooved:
        view = begin(*(plate.name for plate in grooved), "groove")
        draw_groove(view, parts.groove, parts.outlines.sizes.half_width, grooved[0])
        yield view
    for plate in flat_plates(parts.bridge):
        view = begin(plate.name)
        _, *through = (hole for hole in plate.holes if isinstance(hole, Circle))
        screws = {hole: sized.screw_hole(hole.radius) for hole in through}
        draw_frame(view, plate, axis_name="the crank's axis", screws=screws)
        yield view
    (frame,) = flat_plates([parts.frame])
    view = begin(frame.name)
    draw_frame(
        view,
        frame,
        screws={h: sized.screw_hole(h.radius, tapped=True) for h in parts.frame_threads},
    )
    yield view


def layout(mechanism: Mechanism) -> list[Block]:
    """Return a table of pivots and lengths of the drive in front of the crank, if any."""
    own = mechanism.layout
    rows = [("drive", "x or value", "y or unit")]
    rows += [(p.name, length(p.x_mm), length(p.y_mm)) for p in own if isinstance(p, Pivot)]
    rows += [
        (d.name, d.value if isinstance(d.value, str) else number(d.value), d.unit)
        for d in own
        if isinstance(d, Dimension)
    ]
    return [table((), rows, (60.0, 36.0, 20.0))] if len(rows) > 1 else []  # mm


Begin: TypeAlias = Callable[..., View]


def titled(rows: Sequence[Mapping[str, object]], scale: float, parts: Parts) -> Begin:
    """Return a function that begins a view, titled with its parts' numbers and thicknesses.

    Its fits are those of the process, for the thickness of the first part.
    """
    process = parts.mechanism.spec.size.process
    unborne = {name for name, _ in parts.unborne}

    def begin(*names: str, thick: bool = True) -> View:
        titles: list[str] = []
        fits = Fits(process)
        for i, row in enumerate(rows, 1):
            if row["name"] in names:
                long = row["thickness_mm"]
                assert isinstance(long, float)
                fits = fits if titles else Fits(process, long)
                titles.append(f"{i} {row['name']}" + f", t = {length(long)}" * thick)
        view = View("; ".join(titles) or names[0], scale, fits)
        for name in names:
            if name in unborne:
                view.remark("no bearing: hold it from above")
        return view

    return begin


def linked(begin: Begin, parts: FlatParts) -> Iterator[View]:
    """Yield views of links, each once."""
    bars = parts.links
    for one in {member.part: member for member in bars.cut}.values():
        view = begin(one.part.name)
        draw_link(view, one, bars, parts.mechanism)
        yield view


def rolling(begin: Begin, mechanism: Mechanism) -> Iterator[View]:
    """Yield the view of the roller with its pin."""
    view = begin("roller", "pin")
    draw_roller(view, mechanism)
    yield view


def shafted(begin: Begin, shafts: Iterable[Member]) -> Iterator[View]:
    """Yield a view of each kind of shaft."""
    for part in dict.fromkeys(member.part for member in shafts):
        assert not isinstance(part, Group | Shell)
        view = begin(part.name, thick=False)
        draw_shaft(view, part)
        yield view


def flat_plates(members: Iterable[Member]) -> list[Plate]:
    """Return the plates among some parts."""
    return [one.part for one in members if isinstance(one.part, Plate)]
