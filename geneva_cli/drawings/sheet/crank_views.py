"""The views of locking disc, arm, roller with pin, and of the assembled machine."""

from __future__ import annotations

import math

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.standing import bolted, bored, circle_of, draw_hub, holes_of
from geneva_cli.drawings.sheet.view import View, grouped, times
from geneva_cli.geometry.measure import at, legs
from geneva_cli.geometry.plates import plates
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Shape
from geneva_cli.geometry.sheet import CENTRE, HIDDEN, OUTLINE
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.arm import CrankArm
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.machine_sizes import drawn_pin_radius
from geneva_cli.parts.outlines.crank_outline import is_whole
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.held_hubs import hub_note
from geneva_cli.spec.written import degrees, length


def draw_disc(view: View, parts: FlatParts) -> None:
    """Draw the locking disc, or its sectors, about the crank's axis."""
    outlines, mechanism = parts.outlines, parts.mechanism
    assembly, sizes = outlines.assembly, outlines.sizes
    own = plates(parts.crank.part)
    discs, hubs = ([plate for plate in own if plate.layer == layer] for layer in ("CRANK", "HUB"))
    bores, screwed = holes_of(discs)
    contours = [disc.outline for disc in discs if isinstance(disc.outline, Contour)]
    view.draw_all((*contours, *screwed, *bores, *(hub.outline for hub in hubs)))
    circle_of(view, screwed)
    view.cross((0.0, 0.0), sizes.lock if is_whole(assembly, sizes) else 0.2 * sizes.lock)
    for hub in hubs:
        draw_hub(view, hub, hub_note(mechanism.spec.size, "crank"))
    bored(view, bores, mechanism.spec.size, "crank")
    arcs = [s for contour in contours for s in contour.segments if isinstance(s, Arc)]
    locking = [
        arc
        for arc in arcs
        if max(math.hypot(*arc.centre), abs(arc.radius - sizes.lock)) < SAME_ON_SHEET
    ]
    _gaps(view, sizes.lock, locking)  # first, as their legs have no other place
    view.of_arcs(locking, sized.lock(view.fits, mechanism, sizes.lock), whole=True)
    _reliefs(view, [arc for arc in arcs if arc not in locking])
    bolted(view, screwed)


def _reliefs(view: View, arcs: list[Arc]) -> None:
    """Draw the radii of arcs, and how far those of reliefs are from the axis."""
    alike: dict[tuple[str, str], list[Arc]] = {}
    for arc in arcs:
        far = length(math.hypot(*at(arc, 0.5)))
        alike.setdefault((sized.plain(arc.radius, "R "), far), []).append(arc)
    for (radius, far), some in alike.items():
        view.of_arcs(some, times(len(some), radius))
        arc, middle = some[0], at(some[0], 0.5)
        if math.hypot(*arc.centre) > SAME_ON_SHEET and math.hypot(*middle) > SAME_ON_SHEET:
            turn = math.atan2(middle[1], middle[0])
            view.linear((0.0, 0.0), middle, turn, times(len(some), far), near=True)


def _gaps(view: View, lock: float, locking: list[Arc]) -> None:
    """Draw the angles between the locking arcs."""
    ends = sorted(legs(arc) for arc in _joined(locking))
    after = zip(ends, [*ends[1:], *ends[:1]], strict=True)
    gaps = ((end, (start - end) % math.tau) for (_, end), (start, _) in after)
    named = ((degrees(wide), (end, end + wide)) for end, wide in gaps if wide > SAME_ON_SHEET)
    for text, pairs in grouped(named):
        view.angular(pairs, lock, lock, text)


def _joined(arcs: list[Arc]) -> list[Arc]:
    """Return arcs of one circle, with adjoining ones joined."""
    joined: list[Arc] = []
    for arc in arcs:
        if joined and joined[-1].end == arc.start:
            sweep = joined[-1].sweep + arc.sweep
            joined[-1] = Arc(joined[-1].start, arc.end, math.tan(0.25 * sweep))
        else:
            joined.append(arc)
    return joined


def draw_arm(view: View, mechanism: Mechanism, arm: CrankArm) -> None:
    """Draw the crank arm with its holes."""
    view.draw_all((arm.outline, arm.bore, *arm.pins, *arm.bolts))
    view.cross((0.0, 0.0), arm.hub)
    for pin in arm.pins:
        view.cross(pin.centre, arm.eye, math.atan2(pin.centre[1], pin.centre[0]))
    circle_of(view, arm.bolts)
    deviation = mechanism.spec.tolerance.crank_radius_mm
    shown = ((sized.plain(math.hypot(*pin.centre), off=deviation), pin) for pin in arm.pins)
    for text, (pin, *_) in grouped(shown):
        turn = math.atan2(pin.centre[1], pin.centre[0])
        view.linear((0.0, 0.0), pin.centre, turn, text, near=True)
    _between(view, arm)
    bored(view, [arm.bore], mechanism.spec.size, "crank")
    hole = sized.pin_hole(view.fits, mechanism, arm.pins[0].radius)
    view.diameter(arm.pins, times(len(arm.pins), hole))
    view.radii(arm.outline.segments)
    bolted(view, arm.bolts, tapped=True)


def _between(view: View, arm: CrankArm) -> None:
    """Draw the angles from one pin to the next."""
    angles = sorted(math.atan2(p.centre[1], p.centre[0]) for p in arm.pins)
    reach = max(math.hypot(*p.centre) for p in arm.pins) + arm.eye
    pairs = zip(angles, [*angles[1:], angles[0] + math.tau], strict=True)
    # the rest of a turn, and a straight line, need no dimension
    bent = ((a, b) for a, b in pairs if b - a < math.pi - SAME_ON_SHEET)
    for text, some in grouped((degrees(b - a), (a, b)) for a, b in bent):
        view.angular(some, reach, reach, text)


def draw_roller(view: View, mechanism: Mechanism) -> None:
    """Draw a roller about its pin."""
    roller, axis = mechanism.roller_radius_mm, (0.0, 0.0)
    pin = drawn_pin_radius(mechanism)
    loose = 0.5 * mechanism.spec.size.allowances.shaft_fit_mm
    circles = [Circle("", axis, roller)] + ([Circle("", axis, pin + loose)] if pin else [])
    view.draw_all(circles)
    view.cross(axis, roller)
    view.diameter(circles[:1], sized.roller(view.fits, mechanism, roller))
    if pin:
        view.diameter(circles[1:], sized.roller_bore(view.fits, mechanism, pin + loose))
        view.remark(f"turns on its pin {sized.shaft(view.fits, pin)}, which is pressed in")


def draw_assembly(view: View, parts: Outlines, shapes: tuple[Shape, ...]) -> None:
    """Draw the assembled machine, with the centre distance."""
    layers = {"PITCH": CENTRE, "ARM": HIDDEN, "FRAME": HIDDEN, "GROOVE": HIDDEN, "HUB": HIDDEN}
    for shape in shapes:
        view.draw(shape, layers.get(shape.layer, OUTLINE))
    L = parts.assembly.L
    deviation = parts.assembly.mechanism.spec.tolerance.center_distance_mm
    reach = parts.sizes.outer or parts.sizes.rim
    view.cross((0.0, 0.0), reach)
    for place in parts.assembly.full.crank_places:
        view.cross(place.at, max(parts.sizes.lock, 0.1 * L))
    view.linear((0.0, 0.0), (L, 0.0), 0.0, sized.plain(L, "L = ", deviation))
