"""The drawing sheet of a rack's machine: dimensioned parts, section, list of items, title block."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.content import SheetContent, sheet_of, shown_on_sheet
from geneva_cli.drawings.sheet.crank_views import draw_arm
from geneva_cli.drawings.sheet.machine_sheet import flat_plates, geared, rolling, shafted, titled
from geneva_cli.drawings.sheet.standing import bolted, circle_of, draw_frame, holes_of
from geneva_cli.drawings.sheet.view import View, times
from geneva_cli.geometry.measure import bounds
from geneva_cli.geometry.plates import Plate, plates
from geneva_cli.geometry.shapes import ORIGIN, Arc, Circle, Contour
from geneva_cli.geometry.sheet import HIDDEN, OUTLINE, Sheet
from geneva_cli.kinds.linear.drawings import assembly
from geneva_cli.kinds.linear.parts import RackParts
from geneva_cli.kinds.linear.rack import crank_arm, slot_places
from geneva_cli.parts.shafts.screws import NO_SCREW
from geneva_cli.spec.written import length


def sheet(parts: RackParts) -> Sheet:
    """Return the drawing sheet of a machine.

    Raises GenevaError where no scale fits on one, and behind links or gears.
    """
    spec = parts.mechanism.spec
    frames = flat_plates([parts.frame])  # behind links or gears the error says why there is none
    shown = shown_on_sheet(spec, parts.members, assembly(parts).shapes)
    views = partial(_views, shown, parts, frames)
    return sheet_of(spec, shown, views, partial(_together, shown, parts), (parts.sizes.arm,))


def _views(
    shown: SheetContent, parts: RackParts, frames: list[Plate], scale: float
) -> Iterator[View]:
    """Yield a view of each part."""
    begin = titled(shown.rows, scale, parts)
    view = begin("rack")
    _draw_rack(view, parts)
    yield view
    if parts.sizes.lock:
        view = begin("locking sector")
        _draw_sector(view, parts)
        yield view
    if parts.arm:
        view = begin("arm")
        draw_arm(view, parts.mechanism, crank_arm(parts.mechanism))
        yield view
    yield from rolling(begin, parts.mechanism)
    yield from geared(begin, parts)
    yield from shafted(begin, parts.shafts)
    for plate in flat_plates((parts.bar, *parts.guide)):
        view = begin(plate.name)
        screws = {h: sized.screw_hole(h.radius) for h in plate.holes if isinstance(h, Circle)}
        lowest = min((hole.centre for hole in screws), key=lambda at: at[1], default=ORIGIN)
        draw_frame(view, plate, lowest, "the lowest hole", screws)
        if not screws:
            view.remark(NO_SCREW)
        yield view
    for plate in frames:
        view = begin(plate.name)
        screws = {h: sized.screw_hole(h.radius, tapped=True) for h in parts.frame_threads}
        draw_frame(view, plate, parts.axis, "the crank's axis", screws)
        yield view


def _draw_rack(view: View, parts: RackParts) -> None:
    """Draw the rack: its slots and recesses, their distances, and the bolts of its bar."""
    sizes, mechanism = parts.sizes, parts.mechanism
    (rack,) = plates(parts.wheel.part)
    view.draw_plate(rack)
    places, box = slot_places(sizes, mechanism.spec.wheel.z), bounds(rack.outline)
    end = -(sizes.slot_bottom + sizes.half_width)
    for y in places:
        view.centre_line((end, y), (sizes.edge, y))
    first, second, *_ = places
    up, corner, count = 0.5 * math.pi, (box.x0, box.y0), len(places)
    edge, recess = (sizes.edge, first), (sizes.arm, first - sizes.arm)
    view.linear((end, first), edge, 0.0, times(count, length(sizes.edge - end)), near=True)
    width = sized.made(view.fits, mechanism, "slot", sizes.half_width)
    walls = [(sizes.edge, places[-1] + side * sizes.half_width) for side in (-1.0, 1.0)]
    view.linear(walls[0], walls[1], up, times(count, width))
    view.linear(edge, (sizes.edge, second), up, times(count - 1, sized.plain(2.0 * sizes.arm)))
    if sizes.lock:
        view.linear(recess, edge, up, sized.plain(sizes.arm))
        if sizes.edge != sizes.arm:
            off = sized.plain(abs(sizes.edge - sizes.arm))
            view.linear(recess, (sizes.edge, recess[1]), 0.0, off, near=True)
    view.linear((box.x1, box.y0), edge, up, sized.plain(first - box.y0))
    view.linear(corner, (box.x1, box.y0), 0.0, length(box.x1 - box.x0))
    view.linear(corner, (box.x0, box.y1), up, length(box.y1 - box.y0))
    for bolt in holes_of([rack]).bolts[-1:]:
        x, _ = bolt.centre
        view.linear((box.x0, box.y1), bolt.centre, 0.0, sized.plain(x - box.x0))
    _draw_arcs(view, parts, rack)  # last: their texts find a place between the lines


def _draw_arcs(view: View, parts: RackParts, rack: Plate) -> None:
    """Draw the radii of slots and recesses, and the diameter of the bolts' holes."""
    sizes, mechanism = parts.sizes, parts.mechanism
    assert isinstance(rack.outline, Contour)
    arcs = [piece for piece in rack.outline.segments if isinstance(piece, Arc)]
    rounds = [arc for arc in arcs if arc.centre[0] < 0.0]
    view.of_arcs(rounds, times(len(rounds), sized.plain(sizes.half_width, "R ")))
    recesses = [arc for arc in arcs if arc not in rounds]
    if recesses:
        text = times(len(recesses), sized.made(view.fits, mechanism, "recess", sizes.recess))
        view.of_arcs(recesses, text, whole=True)
    screwed = holes_of([rack]).bolts
    if screwed:
        text = times(len(screwed), sized.screw_hole(screwed[0].radius))
        view.diameter(screwed, f"{text} on the slots' axes")
    else:
        view.remark(NO_SCREW)


def _draw_sector(view: View, parts: RackParts) -> None:
    """Draw the locking sector about the crank's axis: both radii, and its bolts."""
    sizes, mechanism = parts.sizes, parts.mechanism
    sector = next(one for one in plates(parts.crank.part) if one.layer == "CRANK")
    assert isinstance(sector.outline, Contour)
    view.draw_plate(sector)
    screwed = holes_of([sector]).bolts
    circle_of(view, screwed)
    view.cross((0.0, 0.0), sizes.floor)
    outer, inner = (piece for piece in sector.outline.segments if isinstance(piece, Arc))
    view.of_arcs([outer], sized.made(view.fits, mechanism, "lock", sizes.lock), whole=True)
    view.of_arcs([inner], sized.plain(sizes.floor, "R "))
    bolted(view, screwed)


def _together(shown: SheetContent, parts: RackParts, view: View) -> None:
    """Draw the assembled machine, with the crank's radius."""
    hidden = {"ARM": HIDDEN, "FRAME": HIDDEN}
    for shape in shown.together:
        view.draw(shape, hidden.get(shape.layer, OUTLINE))
    R = parts.sizes.arm
    view.cross(parts.axis, parts.sizes.lock or 0.2 * R)
    view.linear((0.0, 0.0), parts.axis, 0.0, sized.plain(R, "R = "))
    between = length(parts.sizes.guide.bar + 2.0 * parts.sizes.guide.slide)
    view.remark(f"guide: {between} between rail and wall")
