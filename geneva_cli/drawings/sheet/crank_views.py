"""The views of locking disc, arm, roller with pin, links, and of the assembled machine."""

import math
from collections.abc import Sequence
from itertools import pairwise

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.paper import Block, table
from geneva_cli.drawings.sheet.sized import Fits, degrees
from geneva_cli.drawings.sheet.view import View, grouped, times, turns
from geneva_cli.drawings.sheet.wheel_views import bolted, bored, circle_of, draw_hub
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import ORIGIN, Arc, Circle, Contour, Point, at, legs, polar
from geneva_cli.geometry.sheet import OUTLINE
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.assembly import same
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.links.links import Links, placed_holes, roller_pins
from geneva_cli.parts.outlines.crank_outline import crank_bore, is_whole
from geneva_cli.parts.shafts.arm_and_shafts import CrankArm, bolts, crank_hub
from geneva_cli.table import in_decimals as length

UP = 0.5 * math.pi


def draw_disc(view: View, parts: FlatParts) -> View:
    """Draw the locking disc, or its sectors, about the crank's axis."""
    outlines = parts.outlines
    assembly, sizes = outlines.assembly, outlines.sizes
    contours, screwed, hub = outlines.crank, bolts(outlines), crank_hub(outlines)
    whole = is_whole(assembly, sizes)
    bores = crank_bore(assembly, sizes) if whole else ()
    view.draw(OUTLINE, *contours, *screwed, *bores, *((hub.outline,) if hub else ()))
    circle_of(view, screwed)
    view.cross(ORIGIN, sizes.lock if whole else 0.2 * sizes.lock)
    if hub:
        draw_hub(view, hub)
    bored(view, bores, "crank", sizes.crank_bore if whole else 0.0)
    locking, reliefs = list[Arc](), dict[tuple[str, str], list[Arc]]()
    for arc in (s for contour in contours for s in contour.segments if isinstance(s, Arc)):
        if max(math.hypot(*arc.centre), abs(arc.radius - sizes.lock)) < SAME_ON_SHEET:
            locking.append(arc)
        else:
            far = length(math.hypot(*at(arc, 0.5)))
            reliefs.setdefault((sized.plain(arc.radius, "R "), far), []).append(arc)
    # between locking arcs that do not adjoin: first, as their legs have no other place
    ends = sorted(map(legs, locking))
    gaps = (
        (end, end + (start - end) % math.tau) for (_, end), (start, _) in pairwise(ends + ends[:1])
    )
    view.angles(gaps, sizes.lock, most=math.tau - SAME_ON_SHEET)
    view.diameter(locking, view.fits.made("lock", sizes.lock))
    for (radius, far), some in reliefs.items():
        view.radius(some, times(len(some), radius))
        arc, middle = some[0], at(some[0], 0.5)
        if math.hypot(*arc.centre) > SAME_ON_SHEET and math.hypot(*middle) > SAME_ON_SHEET:
            view.radial(middle, times(len(some), far))
    bolted(view, screwed)
    return view


def draw_arm(view: View, parts: FlatParts, arm: CrankArm) -> View:
    """Draw the crank arm with its holes."""
    mechanism, radius = parts.mechanism, parts.outlines.sizes.arm_bore
    view.draw(OUTLINE, arm.outline, arm.bore, *arm.pins, *arm.bolts)
    view.cross(ORIGIN, arm.hub)
    for pin in arm.pins:
        view.cross(pin.centre, arm.eye, math.atan2(pin.centre[1], pin.centre[0]))
    circle_of(view, arm.bolts)
    deviation = mechanism.spec.tolerance.crank_radius_mm
    shown = ((sized.plain(math.hypot(*pin.centre), off=deviation), pin) for pin in arm.pins)
    for text, (pin, *_) in grouped(shown):
        view.radial(pin.centre, text)
    angles = sorted(math.atan2(p.centre[1], p.centre[0]) for p in arm.pins)
    reach = max(math.hypot(*p.centre) for p in arm.pins) + arm.eye
    # the rest of a turn, and a straight line, need no dimension
    view.angles(turns(angles), reach, most=math.pi - SAME_ON_SHEET)
    bored(view, [arm.bore], "crank", radius)
    hole = view.fits.made("pin hole", arm.pins[0].radius)
    view.diameter(arm.pins, times(len(arm.pins), hole))
    view.radii(arm.outline.segments)
    bolted(view, arm.bolts, tapped=True)
    return view


def draw_roller(view: View, parts: FlatParts) -> View:
    """Draw a roller about its pin."""
    mechanism, pin = parts.mechanism, parts.outlines.sizes.pin
    roller = mechanism.roller_radius_mm
    hole = pin + 0.5 * mechanism.spec.size.allowances.shaft_fit_mm
    circles = [Circle("", ORIGIN, roller)] + ([Circle("", ORIGIN, hole)] if pin else [])
    view.draw(OUTLINE, *circles)
    view.cross(ORIGIN, roller)
    view.diameter(circles[:1], view.fits.made("roller", roller))
    if pin:
        view.diameter(circles[1:], view.fits.made("roller bore", hole))
        view.notes.append(f"turns on its pin {view.fits.shaft(pin)}, which is pressed in")
    return view


def draw_link(view: View, member: Member, bars: Links, mechanism: Mechanism) -> View:
    """Draw a link, or a block that slides in one, with dimensions from its first hole."""
    plate = member.part
    assert isinstance(plate, Plate) and isinstance(plate.outline, Contour)
    view.draw(OUTLINE, plate.outline, *plate.holes)
    holes = [hole for hole in plate.holes if isinstance(hole, Circle)]
    slots = [hole for hole in plate.holes if isinstance(hole, Contour) and hole.layer == "LINK"]
    shaped = [hole for hole in plate.holes if isinstance(hole, Contour) and hole not in slots]
    for hole in holes:
        view.cross(hole.centre, 2.0 * hole.radius)
    # the origin of dimensions: the link's own if on it, else its first hole
    eyes = [piece for piece in plate.outline.segments if isinstance(piece, Arc)]
    own = next((eye for eye in eyes if math.hypot(*eye.centre) < SAME_ON_SHEET), None)
    nearest = min((hole.centre for hole in holes), key=lambda p: math.hypot(*p), default=None)
    base = ORIGIN
    if not shaped and nearest and (own is None or math.hypot(*nearest) < SAME_ON_SHEET):
        base = nearest
    elif not shaped:
        view.cross(ORIGIN, own.radius if own else 0.0)
        view.notes.append("one piece with its shaft")
    for slot in slots:
        _slot(view, slot, base)
    view.places((hole.centre for hole in holes), base)
    pressed = [centre for _, centre in roller_pins(mechanism)]  # in a link or in its block
    texts = []
    for hole, there in zip(holes, placed_holes(member), strict=True):
        text = view.fits.bore(hole.radius)
        if plate.name in bars.standing:
            text = sized.screw_hole(hole.radius)
        elif any(same(there.centre, p, mechanism.center_distance_mm) for p in pressed):
            text = view.fits.made("pin hole", hole.radius)
        texts.append(text)
    for text, some in grouped(zip(texts, holes, strict=True)):
        view.diameter(some, text)
    if shaped:
        L = mechanism.center_distance_mm  # no shaft of links but the crank's has a shape
        radius = bars.shaft((L, 0.0), L)
        view.cross(ORIGIN, 2.0 * radius + mechanism.spec.size.allowances.shaft_fit_mm)
        bored(view, shaped, "crank", radius)
    if plate.name in bars.blocks:
        half, end = eyes[0].radius, abs(eyes[0].centre[0]) + eyes[0].radius
        view.linear((0.0, -half), (0.0, half), UP, view.fits.fitted(2.0 * half, "g6"))
        view.linear((-end, 0.0), (end, 0.0), 0.0)
    else:
        view.radii(eyes)
    return view


def _slot(view: View, slot: Contour, base: Point) -> None:
    ends = [piece for piece in slot.segments if isinstance(piece, Arc)]
    near, far = sorted(ends, key=lambda arc: math.dist(arc.centre, base))
    (x0, y0), (x1, y1) = near.centre, far.centre
    turn = math.atan2(y1 - y0, x1 - x0)
    view.centre_line(at(near, 0.5), at(far, 0.5))
    view.linear(base, near.centre, turn)
    view.linear(near.centre, far.centre, turn)
    side, other = (polar(far.centre, half, turn + UP) for half in (near.radius, -near.radius))
    view.linear(side, other, turn + UP, view.fits.fitted(2.0 * near.radius, "H7"))
    off = abs(math.remainder(turn, math.tau))
    if math.degrees(off) > SAME_ON_SHEET and math.hypot(*base) < SAME_ON_SHEET:
        between = min(turn, 0.0), max(turn, 0.0)
        view.angular([between], 0.0, math.dist(base, near.centre), degrees(off))


def round_parts(members: Sequence[Member], mechanism: Mechanism) -> list[Block]:
    """Return a table of the pins, washers, spacers and rollers between links, and on the frame."""
    rows = [("part", "outside", "bore", "length")]
    for plate in dict.fromkeys(one.part for one in members if isinstance(one.part, Plate)):
        assert isinstance(plate.outline, Circle)
        fits = Fits(mechanism.spec, plate.thickness)
        outer, bores = plate.outline.radius, [h for h in plate.holes if isinstance(h, Circle)]
        outside, inside = sized.plain(2.0 * outer, "Ø "), ""
        if not bores:
            outside = fits.shaft(outer)
        elif plate.layer == "ROLLER":
            outside = fits.made("roller", outer)
        for bore in bores:
            if plate.layer == "SHAFT":  # on a screw
                inside += sized.plain(2.0 * bore.radius, "Ø ")
            else:
                inside += fits.made("roller bore", bore.radius)
        rows.append((plate.name, outside, inside, length(plate.thickness)))
    columns = (62.0, 44.0, 46.0, 16.0)  # mm
    return [table(rows, columns, "round parts")] if len(rows) > 1 else []
