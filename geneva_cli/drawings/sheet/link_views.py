"""The views of links, and a table of the round parts between links."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.paper import table
from geneva_cli.drawings.sheet.standing import bored
from geneva_cli.drawings.sheet.view import Block, View, grouped
from geneva_cli.geometry.measure import at
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import ORIGIN, Arc, Circle, Contour, Point
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.assembly import same
from geneva_cli.parts.links.link_sizes import roller_pins
from geneva_cli.parts.links.links import Links, placed_holes
from geneva_cli.parts.shafts.bores import radius_of
from geneva_cli.parts.shafts.fits import Fits
from geneva_cli.spec.written import degrees, length

UP = 0.5 * math.pi


def draw_link(view: View, member: Member, bars: Links, mechanism: Mechanism) -> None:
    """Draw a link, or a block that slides in one, with dimensions from its first hole."""
    plate = member.part
    assert isinstance(plate, Plate)
    view.draw_plate(plate)
    holes = [hole for hole in plate.holes if isinstance(hole, Circle)]
    slots = [hole for hole in plate.holes if isinstance(hole, Contour) and hole.layer == "LINK"]
    shaped = [hole for hole in plate.holes if isinstance(hole, Contour) and hole not in slots]
    for hole in holes:
        view.cross(hole.centre, 2.0 * hole.radius)
    base = ORIGIN if shaped else _base(view, plate, holes)
    for slot in slots:
        _slot(view, slot, base)
    _places(view, holes, base)
    pressed = [centre for _, centre in roller_pins(mechanism)]  # in a link or in its block

    def written(hole: Circle, there: Circle) -> str:
        if plate.name in bars.standing:
            return sized.screw_hole(hole.radius)
        if any(same(there.centre, p, mechanism.center_distance_mm) for p in pressed):
            return sized.pin_hole(view.fits, mechanism, hole.radius)
        return sized.bore(view.fits, hole.radius)

    pairs = zip(holes, placed_holes(member), strict=True)
    for text, some in grouped((written(hole, there), hole) for hole, there in pairs):
        view.diameter(some, text)
    if shaped:
        view.cross(ORIGIN, 2.0 * radius_of(shaped[0]))
        bored(view, shaped, mechanism.spec.size, "crank")  # no other shaft of links has a shape
    _outline(view, plate, plate.name in bars.blocks)


def _base(view: View, plate: Plate, holes: list[Circle]) -> Point:
    """Return the origin of a link's dimensions: its own if on the link, else its first hole."""
    assert isinstance(plate.outline, Contour)
    eyes = (piece for piece in plate.outline.segments if isinstance(piece, Arc))
    own = next((eye for eye in eyes if math.hypot(*eye.centre) < SAME_ON_SHEET), None)
    nearest = sorted((hole.centre for hole in holes), key=lambda p: math.hypot(*p))
    if nearest and (own is None or math.hypot(*nearest[0]) < SAME_ON_SHEET):
        return nearest[0]
    view.cross((0.0, 0.0), own.radius if own else 0.0)
    view.remark("one piece with its shaft")
    return 0.0, 0.0


def _places(view: View, holes: list[Circle], base: Point) -> None:
    """Draw the distances of the other holes from the first, along the link and across it."""
    for axis, turn in ((0, 0.0), (1, UP)):
        texts = {length(0.0)}
        for hole in sorted(holes, key=lambda h: abs(h.centre[axis] - base[axis])):
            text = length(abs(hole.centre[axis] - base[axis]))
            if text not in texts:
                texts.add(text)
                view.linear(base, hole.centre, turn, text)


def _slot(view: View, slot: Contour, base: Point) -> None:
    """Draw width and ends of a slot with round ends, and its direction if not the link's."""
    ends = [piece for piece in slot.segments if isinstance(piece, Arc)]
    near, far = sorted(ends, key=lambda arc: math.dist(arc.centre, base))
    (x0, y0), (x1, y1) = near.centre, far.centre
    turn = math.atan2(y1 - y0, x1 - x0)
    view.centre_line(at(near, 0.5), at(far, 0.5))
    view.linear(base, near.centre, turn, sized.plain(_along(base, near.centre, turn)))
    view.linear(near.centre, far.centre, turn, sized.plain(math.dist(near.centre, far.centre)))
    half = near.radius
    sides = [(x1 + s * half * math.sin(turn), y1 - s * half * math.cos(turn)) for s in (-1.0, 1.0)]
    view.linear(sides[0], sides[1], turn + UP, sized.fitted(view.fits, 2.0 * half, "", "H7"))
    off = abs(math.remainder(turn, math.tau))
    if math.degrees(off) > SAME_ON_SHEET and math.hypot(*base) < SAME_ON_SHEET:
        legs = (0.0, turn) if turn > 0.0 else (turn, 0.0)
        reach = math.dist(base, near.centre)
        view.angular([legs], 0.0, reach, degrees(off))


def _along(p: Point, q: Point, turn: float) -> float:
    return abs((q[0] - p[0]) * math.cos(turn) + (q[1] - p[1]) * math.sin(turn))


def _outline(view: View, plate: Plate, slides: bool) -> None:
    """Draw the radii of eyes; of a sliding block, its width in the slot and its length."""
    assert isinstance(plate.outline, Contour)
    arcs = [piece for piece in plate.outline.segments if isinstance(piece, Arc)]
    if slides:
        half, (x, _) = arcs[0].radius, arcs[0].centre
        end = abs(x) + half
        view.linear((0.0, -half), (0.0, half), UP, sized.fitted(view.fits, 2.0 * half, "", "g6"))
        view.linear((-end, 0.0), (end, 0.0), 0.0, sized.plain(2.0 * end))
        return
    view.radii(arcs)


def round_parts(members: Sequence[Member], mechanism: Mechanism) -> list[Block]:
    """Return a table of the pins, washers, spacers and rollers between links, and on the frame."""
    rows = list(_rows(members, mechanism))
    if not rows:
        return []
    columns = (62.0, 44.0, 46.0, 16.0)  # mm
    return [table(("round parts",), [("part", "outside", "bore", "length"), *rows], columns)]


def _rows(members: Sequence[Member], mechanism: Mechanism) -> Iterator[tuple[str, str, str, str]]:
    for plate in dict.fromkeys(one.part for one in members if isinstance(one.part, Plate)):
        assert isinstance(plate.outline, Circle)
        fits = Fits(mechanism.spec.size.process, plate.thickness)
        outer, bores = plate.outline.radius, [h for h in plate.holes if isinstance(h, Circle)]
        rolls, on_screw = plate.layer == "ROLLER", plate.layer == "SHAFT"
        outside = sized.plain(2.0 * outer, "Ø ")
        if not bores:
            outside = sized.shaft(fits, outer)
        elif rolls:
            outside = sized.roller(fits, mechanism, outer)
        inside = "".join(
            sized.plain(2.0 * bore.radius, "Ø ")
            if on_screw
            else sized.roller_bore(fits, mechanism, bore.radius)
            for bore in bores
        )
        yield plate.name, outside, inside, length(plate.thickness)
