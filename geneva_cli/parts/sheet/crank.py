"""The views of what the crank carries: locking disc, arm, roller and pin; and of the machine."""

from __future__ import annotations

import math

from geneva_cli.curves.measure import at, legs
from geneva_cli.curves.shapes import Arc, Circle, Shape
from geneva_cli.curves.sheet import CENTRE, HIDDEN, OUTLINE
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.arm import CrankArm, bolts
from geneva_cli.parts.crank import crank_circles, is_whole
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.shafts import crank_hub
from geneva_cli.parts.sheet import sized
from geneva_cli.parts.sheet.bores import bolted, bored, circle_of, radius_of
from geneva_cli.parts.sheet.standing import draw_hub
from geneva_cli.parts.sheet.view import View, number, times
from geneva_cli.parts.sizes import pin_radius


def draw_disc(view: View, found: Outlines) -> None:
    """The locking disc, or its sectors, about the crank's axis."""
    assembly, sizes = found.assembly, found.sizes
    for contour in found.crank:
        view.draw(contour, OUTLINE)
    screwed = bolts(found)
    whole = is_whole(assembly, sizes)
    bores = [c for c in crank_circles(assembly, sizes) if c.layer == "BORE" and whole]
    for shape in (*screwed, *bores):
        view.draw(shape, OUTLINE)
    hub = crank_hub(found)
    if hub:
        view.draw(hub.outline, OUTLINE)
    circle_of(view, screwed)
    view.cross((0.0, 0.0), sizes.lock if whole else 0.2 * sizes.lock)
    if hub:
        draw_hub(view, hub)
    bored(view, bores, sizes.crank_bore, assembly.mechanism.spec.size.crank_keyway)
    arcs = [s for contour in found.crank for s in contour.segments if isinstance(s, Arc)]
    locking = [
        a for a in arcs if math.hypot(*a.centre) < SAME_ON_SHEET and _is(a.radius, sizes.lock)
    ]
    view.of_arcs(locking, sized.lock(assembly.mechanism, sizes.lock), whole=True)
    seen: set[tuple[str, str]] = set()
    for arc in arcs:
        if arc in locking:
            continue
        middle = at(arc, 0.5)
        far = math.hypot(*middle)
        shown = sized.plain(arc.radius, "R "), number(far)
        if shown in seen:
            continue
        seen.add(shown)
        view.of_arcs([arc], shown[0])
        if math.hypot(*arc.centre) > SAME_ON_SHEET and far > SAME_ON_SHEET:
            turn = math.atan2(middle[1], middle[0])
            view.linear((0.0, 0.0), middle, turn, shown[1], near=True)
    _gaps(view, found, locking)
    bolted(view, screwed)


def _gaps(view: View, found: Outlines, locking: list[Arc]) -> None:
    """The angles between the arcs that lock."""
    ends = sorted(legs(arc) for arc in _joined(locking))
    gaps: dict[str, list[tuple[float, float]]] = {}
    for (_, end), (start, _) in zip(ends, [*ends[1:], *ends[:1]], strict=True):
        wide = (start - end) % math.tau
        if wide > SAME_ON_SHEET:
            gaps.setdefault(f"{number(math.degrees(wide))}°", []).append((end, end + wide))
    for text, pairs in gaps.items():
        view.angular(pairs, found.sizes.lock, found.sizes.lock, times(len(pairs), text))


def _joined(arcs: list[Arc]) -> list[Arc]:
    """Arcs of one circle that go on in each other as one."""
    found: list[Arc] = []
    for arc in arcs:
        if found and found[-1].end == arc.start:
            sweep = found[-1].sweep + arc.sweep
            found[-1] = Arc(found[-1].start, arc.end, math.tan(0.25 * sweep))
        else:
            found.append(arc)
    return found


def draw_arm(view: View, found: Outlines, made: CrankArm) -> None:
    """The crank arm with its holes."""
    view.draw(made.outline, OUTLINE)
    for shape in (made.bore, *made.pins, *made.bolts):
        view.draw(shape, OUTLINE)
    view.cross((0.0, 0.0), made.hub)
    for pin in made.pins:
        view.cross(pin.centre, made.eye, math.atan2(pin.centre[1], pin.centre[0]))
    circle_of(view, made.bolts)
    mechanism = found.assembly.mechanism
    deviation = mechanism.spec.tolerance.crank_radius_mm
    shown: dict[str, list[Circle]] = {}
    for pin in made.pins:
        text = sized.plain(math.hypot(*pin.centre), deviation=deviation)
        shown.setdefault(text, []).append(pin)
    for text, some in shown.items():
        centre = some[0].centre
        turn = math.atan2(centre[1], centre[0])
        view.linear((0.0, 0.0), centre, turn, times(len(some), text), near=True)
    _between(view, made)
    bored(view, [made.bore], radius_of(made.bore), mechanism.spec.size.crank_keyway)
    view.diameter(made.pins, times(len(made.pins), sized.pin_hole(mechanism, made.pins[0].radius)))
    radii: dict[str, list[Arc]] = {}
    for arc in made.outline.segments:
        if isinstance(arc, Arc):
            radii.setdefault(sized.plain(arc.radius, "R "), []).append(arc)
    for text, arcs in radii.items():
        view.of_arcs(arcs, times(len(arcs), text))
    bolted(view, made.bolts)


def _between(view: View, made: CrankArm) -> None:
    """The angles from one pin to the next."""
    ways = sorted(math.atan2(p.centre[1], p.centre[0]) for p in made.pins)
    reach = max(math.hypot(*p.centre) for p in made.pins) + made.eye
    pairs: dict[str, list[tuple[float, float]]] = {}
    for start, end in zip(ways, [*ways[1:], ways[0] + math.tau], strict=True):
        wide = end - start
        if (
            wide < math.pi - SAME_ON_SHEET
        ):  # what is left of a turn, and what is straight on, is seen
            pairs.setdefault(f"{number(math.degrees(wide))}°", []).append((start, end))
    for text, some in pairs.items():
        view.angular(some, reach, reach, times(len(some), text))


def draw_roller(view: View, mechanism: Mechanism) -> None:
    """A roller about its pin."""
    roller, axis = mechanism.roller_radius_mm, (0.0, 0.0)
    pin = pin_radius(mechanism.spec.size, roller)
    circles = [Circle("", axis, roller)] + ([Circle("", axis, pin)] if pin else [])
    for c in circles:
        view.draw(c, OUTLINE)
    view.cross(axis, roller)
    view.diameter(circles[:1], sized.roller(mechanism, roller))
    if pin:
        view.diameter(circles[1:], sized.roller_bore(pin))
        view.remark(f"turns on its pin {sized.pin(pin)}, which is pressed in")


def draw_assembly(view: View, found: Outlines, shapes: tuple[Shape, ...]) -> None:
    """The machine put together, with the centre distance."""
    layers = {"PITCH": CENTRE, "ARM": HIDDEN, "FRAME": HIDDEN, "GROOVE": HIDDEN, "HUB": HIDDEN}
    for shape in shapes:
        view.draw(shape, layers.get(shape.layer, OUTLINE))
    L = found.assembly.L
    deviation = found.assembly.mechanism.spec.tolerance.center_distance_mm
    reach = found.sizes.outer or found.sizes.rim
    view.cross((0.0, 0.0), reach)
    view.cross((L, 0.0), max(found.sizes.lock, 0.1 * L))
    view.linear((0.0, 0.0), (L, 0.0), 0.0, sized.plain(L, "L = ", deviation))


def _is(a: float, b: float) -> bool:
    return abs(a - b) < SAME_ON_SHEET
