"""The wheel's view."""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.curves.measure import turned
from geneva_cli.curves.shapes import Arc, Contour, Point
from geneva_cli.curves.sheet import CENTRE, HIDDEN, OUTLINE
from geneva_cli.machine.engagement import Engagement
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts import drawings
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.sheet import sized
from geneva_cli.parts.sheet.bores import bolted, bored, circle_of
from geneva_cli.parts.sheet.standing import draw_hub
from geneva_cli.parts.sheet.view import View, number, times
from geneva_cli.parts.wheel import dial_bolts
from geneva_cli.parts.wheel_hub import HUB, wheel_hub


def draw_wheel(view: View, found: Outlines, tolerance: float, curves: str) -> None:
    """The wheel with all its dimensions; curved slots have theirs in a table."""
    assembly, sizes = found.assembly, found.sizes
    made = drawings.wheel(found, tolerance, curves)
    contour = next(s for s in made.shapes if isinstance(s, Contour))
    for shape in made.shapes:
        view.draw(shape, HIDDEN if shape.layer == HUB else OUTLINE)
    reach = sizes.outer or max(math.hypot(*s.start) for s in contour.segments)
    view.cross((0.0, 0.0), reach)
    _axes(view, found, reach)
    if sizes.recess:
        view.cross(_recess_centre(found), 0.0)
    arcs = [s for s in contour.segments if isinstance(s, Arc)]
    screwed = dial_bolts(assembly, sizes)
    bores = [s for s in made.shapes if s.layer == "BORE" and s not in screwed]
    circle_of(view, screwed)
    _recesses(view, found, arcs)
    for engagement in assembly.kinds:
        number_of = sum(1 for one, _ in assembly.slots if one is engagement)
        if not engagement.slot.curved:
            _slot(view, found, engagement, number_of)
    up = 0.5 * math.pi
    view.linear((0.0, -reach), (0.0, reach), up, sized.plain(2.0 * reach, "Ø "))
    _steps(view, found, reach)
    _rims(view, arcs, reach)
    hub = wheel_hub(assembly, sizes)
    if hub:
        draw_hub(view, hub)
    bored(view, bores, sizes.wheel_bore, assembly.mechanism.spec.size.wheel_keyway)
    bolted(view, screwed)


def _axes(view: View, found: Outlines, reach: float) -> None:
    """The axes of straight slots, the rollers' way in a curved one."""
    for i, (engagement, direction) in enumerate(found.assembly.slots):
        if not engagement.slot.curved:
            for end, mouth in _ends(turned(found.slots[engagement], direction)):
                view.centre_line(*((end, mouth) if found.assembly.sign > 0.0 else (mouth, end)))
        elif i == 0:
            for line in drawings.pitch_lines(found.assembly, engagement, found.fine, "arcs"):
                view.draw(line, CENTRE)


def _ends(walls: Contour) -> list[tuple[Point, Point]]:
    """The ends of straight slots' axes, of one or of a pair: the bottom of a round end, a mouth."""
    first, *_, last = walls.segments
    arcs = [piece for piece in walls.segments[1:-1] if isinstance(piece, Arc)]
    if len(arcs) == 1:
        return [_axis(first.start, first.end, arcs[0], last.end)]
    return [_axis(first.start, first.end, arcs[0]), _axis(last.end, last.start, arcs[-1])]


def _axis(corner: Point, inner: Point, arc: Arc, *corners: Point) -> tuple[Point, Point]:
    """Of a slot with a wall from a corner inwards, a round end, and perhaps another corner."""
    x, y = arc.centre
    way = math.atan2(inner[1] - corner[1], inner[0] - corner[0])
    c, s = math.cos(way), math.sin(way)
    farther = min((p[0] - x) * c + (p[1] - y) * s for p in (corner, *corners))
    return (x + arc.radius * c, y + arc.radius * s), (x + farther * c, y + farther * s)


def _slot(view: View, found: Outlines, engagement: Engagement, count: int) -> None:
    """Width, end and depth of a straight slot, and by how much it misses the wheel's centre."""
    direction = next(d for one, d in found.assembly.slots if one is engagement)
    walls = turned(found.slots[engagement], direction)
    ends = _ends(walls)
    end, mouth = ends[0]
    way = math.atan2(mouth[1] - end[1], mouth[0] - end[0])
    across = way + 0.5 * math.pi
    corner = walls.segments[0].start
    count *= len(ends)
    if len(ends) == 1:
        width = sized.slot_width(found.assembly.mechanism, found.sizes.half_width)
        view.linear(corner, walls.segments[-1].end, across, times(count, width))
    else:  # one wall each
        view.linear(corner, mouth, across, times(count, sized.plain(found.sizes.half_width)))
    foot = _foot(end, way)
    view.linear(foot, end, way, sized.plain(math.dist(foot, end)), near=True)
    view.linear(end, mouth, way, times(count, sized.plain(math.dist(end, mouth))), near=True)
    if math.hypot(*foot) > SAME_ON_SHEET:
        turn = math.atan2(foot[1], foot[0])
        view.linear((0.0, 0.0), foot, turn, sized.plain(math.hypot(*foot)))
    rounds = [
        s
        for one, d in found.assembly.slots
        if one is engagement
        for s in turned(found.slots[one], d).segments
        if isinstance(s, Arc) and math.hypot(*s.centre) > SAME_ON_SHEET
    ]
    view.of_arcs(rounds, times(count, sized.plain(rounds[0].radius, "R ")))


def _foot(p: Point, way: float) -> Point:
    """The point of a line that is nearest to the origin."""
    c, s = math.cos(way), math.sin(way)
    along = p[0] * c + p[1] * s
    return p[0] - along * c, p[1] - along * s


def _recesses(view: View, found: Outlines, arcs: list[Arc]) -> None:
    """The recesses, and where their centres are."""
    assembly, sizes = found.assembly, found.sizes
    L = assembly.L
    if not sizes.recess:
        return
    about = [arc for arc in arcs if abs(math.hypot(*arc.centre) - L) < SAME_ON_SHEET]
    own = [arc for arc in about if abs(arc.radius - sizes.recess) < SAME_ON_SHEET]
    deviation = assembly.mechanism.spec.tolerance.center_distance_mm
    centre = _recess_centre(found)
    turn = math.atan2(centre[1], centre[0])
    view.linear((0.0, 0.0), centre, turn, sized.plain(L, deviation=deviation), near=True)
    view.of_arcs(own, times(len(own), sized.recess(assembly.mechanism, sizes.recess)), whole=True)
    for radius, some in _by_radius([arc for arc in about if arc not in own]).items():
        view.of_arcs(some, times(len(some), sized.plain(radius, "R ")))


def _recess_centre(found: Outlines) -> Point:
    """The centre of the recess that lies farthest to the left."""
    L = found.assembly.L
    return min(
        ((L * math.cos(a), L * math.sin(a)) for a in found.assembly.rests), key=lambda p: p[0]
    )


def _rims(view: View, arcs: list[Arc], reach: float) -> None:
    """Arcs about the wheel's axis that are not its outside."""
    own = [arc for arc in arcs if math.hypot(*arc.centre) < SAME_ON_SHEET]
    for radius, some in _by_radius(own).items():
        if abs(radius - reach) > SAME_ON_SHEET:
            view.of_arcs(some, times(len(some), sized.plain(radius, "R ")))


def _steps(view: View, found: Outlines, reach: float) -> None:
    """The angles between slots, and from a slot to the middle of a recess."""
    assembly = found.assembly
    deviation = assembly.mechanism.spec.tolerance.slot_angle_deg
    begin = reach
    ways = sorted(
        way
        for engagement, direction in assembly.slots
        for way in _ways(found, engagement, direction)
    )
    steps: dict[str, list[tuple[float, float]]] = {}
    for start, end in zip(ways, [*ways[1:], ways[0] + math.tau], strict=True):
        shown = f"{number(math.degrees(end - start))}°" + (f" ±{deviation:g}°" if deviation else "")
        steps.setdefault(shown, []).append((start, end))
    for text, pairs in steps.items():
        view.angular(pairs, begin, reach, times(len(pairs), text))
    halves: dict[str, list[tuple[float, float]]] = {}
    for rest in assembly.rests if found.sizes.recess else ():
        off = min((rest - way) % math.tau for way in ways)
        halves.setdefault(f"{number(math.degrees(off))}°", []).append((rest - off, rest))
    for text, pairs in halves.items():
        view.angular(pairs, begin, reach, times(len(pairs), text))


def _ways(found: Outlines, engagement: Engagement, direction: float) -> Iterator[float]:
    """The directions of the axes of a slot, or of a pair, in the wheel."""
    if engagement.slot.curved:
        yield direction
        return
    for (x, y), (u, v) in _ends(turned(found.slots[engagement], direction)):
        way = math.atan2(v - y, u - x)
        way += 0.0 if found.assembly.sign > 0.0 else math.pi
        yield direction + math.remainder(way - direction, math.tau)


def _by_radius(arcs: list[Arc]) -> dict[float, list[Arc]]:
    """Arcs that have the same radius together."""
    found: dict[float, list[Arc]] = {}
    for arc in arcs:
        same = next((r for r in found if abs(r - arc.radius) < SAME_ON_SHEET), arc.radius)
        found.setdefault(same, []).append(arc)
    return found
