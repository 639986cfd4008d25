"""The wheel's view on the drawing sheet."""

from __future__ import annotations

import math

from geneva_cli.drawings.part_drawings import pitch_lines
from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.standing import bolted, bored, circle_of, draw_hub, holes_of
from geneva_cli.drawings.sheet.view import View, grouped, times
from geneva_cli.geometry.plates import plates
from geneva_cli.geometry.shapes import ORIGIN, Arc, Contour, Point, turned
from geneva_cli.geometry.sheet import CENTRE, HIDDEN, OUTLINE
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.projection import outlines_of
from geneva_cli.parts.slots.roller_paths import cut_walls
from geneva_cli.spec.written import degrees, length


def draw_wheel(view: View, parts: FlatParts) -> View:
    """Draw the wheel with all its dimensions but the flanks of curved slots."""
    outlines = parts.outlines
    assembly, sizes = outlines.assembly, outlines.sizes
    wheel, *hubs = plates(parts.wheel.part)
    for shape in outlines_of(parts.wheel.part):
        view.draw(shape, HIDDEN if shape.layer == "HUB" else OUTLINE)
    edges = [s for s in (wheel.outline, *wheel.holes) if isinstance(s, Contour)]
    contour = next(s for s in edges if s.layer == wheel.layer)
    reach = sizes.outer or max(math.hypot(*s.start) for s in contour.segments)
    view.cross(ORIGIN, reach)
    for i, (engagement, direction) in enumerate(assembly.slots):
        if not engagement.slot.curved:
            walls = turned(outlines.slots[engagement], direction)
            for end, mouth in _ends(cut_walls(walls, outlines.wheel)):
                view.centre_line(*((end, mouth) if assembly.sign > 0.0 else (mouth, end)))
        elif i == 0:
            for line in pitch_lines(parts, engagement):
                view.draw(line, CENTRE)
    L = assembly.L
    # a recess's centre, the leftmost one
    centres = ((L * math.cos(a), L * math.sin(a)) for a in assembly.rests)
    at_rest = min(centres, key=lambda p: p[0], default=ORIGIN)
    if sizes.recess:
        view.cross(at_rest, 0.0)
    arcs = [s for s in contour.segments if isinstance(s, Arc)]
    bores, screwed = holes_of([wheel])
    circle_of(view, screwed)
    if sizes.recess:
        about = [arc for arc in arcs if abs(math.hypot(*arc.centre) - L) < SAME_ON_SHEET]
        own = [arc for arc in about if abs(arc.radius - sizes.recess) < SAME_ON_SHEET]
        deviation = assembly.mechanism.spec.tolerance.center_distance_mm
        view.radial(at_rest, sized.plain(L, off=deviation))
        recess = sized.made(view.fits, assembly.mechanism, "recess", sizes.recess)
        view.of_arcs(own, times(len(own), recess), whole=True)
        view.radii(arc for arc in about if arc not in own)
    for engagement in assembly.kinds:
        count = sum(1 for one, _ in assembly.slots if one is engagement)
        if not engagement.slot.curved:
            _slot(view, outlines, engagement, count)
            continue
        width = sized.made(view.fits, assembly.mechanism, "slot", sizes.half_width)
        view.notes.append(f"{times(count, 'slot')}, {width} wide: flanks as in the wheel's dxf")
    up = 0.5 * math.pi
    view.linear((0.0, -reach), (0.0, reach), up, sized.plain(2.0 * reach, "Ø "))
    _steps(view, outlines, reach)
    own = [arc for arc in arcs if math.hypot(*arc.centre) < SAME_ON_SHEET]
    view.radii(own, besides=reach)
    clear = assembly.mechanism.spec.size.allowances
    if clear.source and clear.slot_clearance_mm:  # of a process, whose fits do not say it
        text = f"clearance a side: {length(clear.slot_clearance_mm)} from roller to slot"
        lock = f", {length(clear.lock_clearance_mm)} from locking disc to recess"
        view.notes.append(text + (lock if sizes.lock else ""))
    if sizes.mouth_radius:
        view.notes.append(f"mouths of the slots rounded with R {length(sizes.mouth_radius)}")
    if sizes.arm - sizes.half_width - sizes.recess < sizes.horn_tip:
        view.notes.append(
            f"horns cut square to the slots where they are {length(sizes.horn_tip)} wide"
        )
    for hub in hubs:
        draw_hub(view, hub)
    bored(view, bores, assembly.mechanism.spec.size, "wheel")
    bolted(view, screwed)
    return view


def _ends(walls: Contour) -> list[tuple[Point, Point]]:
    """Return inner end and mouth of the axis of a straight slot, or of each slot of a pair."""
    first, *_, last = walls.segments
    arcs = [piece for piece in walls.segments[1:-1] if isinstance(piece, Arc)]
    if len(arcs) == 1:
        return [_axis(first.start, first.end, arcs[0], last.end)]
    return [_axis(first.start, first.end, arcs[0]), _axis(last.end, last.start, arcs[-1])]


def _axis(corner: Point, inner: Point, arc: Arc, *corners: Point) -> tuple[Point, Point]:
    """Return the axis of a slot: a wall from a corner inwards, a round end, other corners."""
    x, y = arc.centre
    turn = math.atan2(inner[1] - corner[1], inner[0] - corner[0])
    c, s = math.cos(turn), math.sin(turn)
    farther = min((p[0] - x) * c + (p[1] - y) * s for p in (corner, *corners))
    return (x + arc.radius * c, y + arc.radius * s), (x + farther * c, y + farther * s)


def _slot(view: View, parts: Outlines, engagement: Engagement, count: int) -> None:
    directions = [d for one, d in parts.assembly.slots if one is engagement]
    walls = cut_walls(turned(parts.slots[engagement], directions[0]), parts.wheel)
    ends = _ends(walls)
    end, mouth = ends[0]
    turn = math.atan2(mouth[1] - end[1], mouth[0] - end[0])
    across = turn + 0.5 * math.pi
    corner = walls.segments[0].start
    count *= len(ends)
    if len(ends) == 1:
        width = sized.made(view.fits, parts.assembly.mechanism, "slot", parts.sizes.half_width)
        far = walls.segments[-1].end
        view.linear(corner, far, across, times(count, width), "slot's width")
    else:  # one wall each
        half = sized.plain(parts.sizes.half_width)
        view.linear(corner, mouth, across, times(count, half), "from a slot's wall to its axis")
    along = end[0] * math.cos(turn) + end[1] * math.sin(turn)
    foot = end[0] - along * math.cos(turn), end[1] - along * math.sin(turn)
    inwards, deep = sized.plain(math.dist(foot, end)), sized.plain(math.dist(end, mouth))
    view.linear(foot, end, turn, inwards, "from the wheel's middle to a slot's end", near=True)
    view.linear(end, mouth, turn, times(count, deep), "from a slot's end to its mouth", near=True)
    if math.hypot(*foot) > SAME_ON_SHEET:
        normal, off = math.atan2(foot[1], foot[0]), sized.plain(math.hypot(*foot))
        view.linear(ORIGIN, foot, normal, off, "from the wheel's axis to a slot's axis")
    pieces = [s for d in directions for s in turned(parts.slots[engagement], d).segments]
    arcs = [s for s in pieces if isinstance(s, Arc)]
    rounds = [s for s in arcs if math.hypot(*s.centre) > SAME_ON_SHEET]
    view.of_arcs(rounds, times(count, sized.plain(rounds[0].radius, "R ")))


def _steps(view: View, parts: Outlines, reach: float) -> None:
    """Draw the angles from slot to slot, and from a slot to a recess."""
    assembly = parts.assembly
    angles = []
    for engagement, direction in assembly.slots:
        if engagement.slot.curved:
            angles.append(direction)
            continue
        for (x, y), (u, v) in _ends(turned(parts.slots[engagement], direction)):
            angle = math.atan2(v - y, u - x)
            angle += 0.0 if assembly.sign > 0.0 else math.pi
            angles.append(direction + math.remainder(angle - direction, math.tau))
    angles.sort()
    deviation = assembly.mechanism.spec.tolerance.slot_angle_deg
    view.steps(angles, reach, f" ±{deviation:g}°" if deviation else "")
    rests = assembly.rests if parts.sizes.recess else ()
    halves = ((min((rest - angle) % math.tau for angle in angles), rest) for rest in rests)
    for text, pairs in grouped((degrees(half), (rest - half, rest)) for half, rest in halves):
        view.angular(pairs, reach, reach, text)
