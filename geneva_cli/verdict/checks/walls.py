"""Walls of wheel, crank, dial and a curved slot's branches; gaps between cranks, and wheels.

All cranks turn at one rate. So seen from one of them, another one does not turn: it moves on a
circle, whose radius is the distance of their axes. Both are taken as their convex hulls, seen along
the shafts. Their gap is the greatest over all directions of what separates them there.
"""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.measure import turned
from geneva_cli.geometry.plates import apart, beyond
from geneva_cli.geometry.shapes import Arc, Circle, Line, Segment, backwards, closed
from geneva_cli.loads.carried import farthest_mm
from geneva_cli.motion.pitch_curve import opposites
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.outlines.crank_outline import is_whole, rollers_gap
from geneva_cli.parts.outlines.outlines import Outlines, wheel_holes, wheel_hub
from geneva_cli.parts.shafts.bores import has_shape
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.roller_paths import roller_centres
from geneva_cli.verdict.checks.check import Check, compared


def between_slots(name: str, parts: FlatParts) -> Check:
    """The wall between adjacent slots at its thinnest place; negative where they cut each other."""
    outlines, L = parts.outlines, parts.outlines.assembly.L
    around, near = outlines.assembly.slots, math.inf
    for i, (engagement, direction) in enumerate(around):
        following, ahead = around[(i + 1) % len(around)]
        walls = turned(outlines.slots[engagement], direction)
        (u, v), (x, y) = walls.segments[-1].end, walls.segments[0].start
        mouth: Segment = Line((u, v), (x, y))
        if engagement.apart > 0.0:  # along the rim for a pair, which a chord might cut
            back = (math.atan2(v, u) - math.atan2(y, x)) % math.tau
            mouth = Arc((u, v), (x, y), -math.tan(0.25 * back))
        slot = closed(walls.layer, [*walls.segments, mouth])
        inside = Polyarc([backwards(slot) if outlines.assembly.sign > 0.0 else slot])
        points = Polyarc([turned(outlines.slots[following], ahead)]).samples(1e-6 * L, 0.01 * L)
        near = min(near, float(inside.signed(points).min()))
        if all(s is engagement for s, _ in around):
            break
    return _wall(name, near, outlines.sizes)


def rollers_apart(name: str, parts: FlatParts) -> Check | None:
    """The gap between the roller that starts the wheel and the one that stops it, on one crank."""
    gap = rollers_gap(parts.outlines.assembly, parts.outlines.sizes)
    return None if gap is None else compared(name, gap, "at least", 0.0)


def horn(name: str, parts: FlatParts) -> Check | None:
    """The wall between a slot and the recess of the locking disc or sectors."""
    outlines = parts.outlines
    return _wall(name, outlines.sizes.horn, outlines.sizes) if outlines.crank else None


def wheel_bore(name: str, parts: FlatParts) -> Check | None:
    """The wall between the wheel's bore and its slots' ends, and around the bore in a drawn hub."""
    size = parts.outlines.sizes
    if not size.wheel_bore:
        return None
    hub = wheel_hub(parts.outlines.assembly, size)
    wall = size.slot_end - size.wheel_bore - parts.mechanism.spec.size.allowances.around_shaft_mm
    return _wall(name, min(wall, size.wheel_hub - size.wheel_reach) if hub else wall, size)


def outside(name: str, parts: FlatParts) -> Check | None:
    """The wall between the slots or recesses of an internal wheel and its outside."""
    size = parts.outlines.sizes
    if not size.outer:
        return None
    deepest = max(size.slot_end, parts.outlines.assembly.L + size.recess if size.lock else 0.0)
    return _wall(name, size.outer - deepest, size)


def crank_bore(name: str, parts: FlatParts) -> Check | None:
    """The wall between the crank's bore and the bottom of the locking disc's relief.

    In a drawn hub it is also the wall around the bore.
    """
    outlines = parts.outlines
    size = outlines.sizes
    if not (size.crank_bore and outlines.crank and is_whole(outlines.assembly, size)):
        return None
    wall = (
        outlines.relief_depth
        - size.crank_bore
        - parts.mechanism.spec.size.allowances.around_shaft_mm
    )
    in_hub = size.crank_hub - size.crank_reach
    return _wall(name, min(wall, in_hub) if parts.crank_hub else wall, size)


def _wall(name: str, value: float, sizes: Sizes) -> Check:
    return compared(name, value, "at least", sizes.wall_min)


def dial(name: str, parts: FlatParts) -> Check | None:
    """The least wall around the bore with its keyway and around the dial's bolts."""
    size = parts.mechanism.spec.size
    if not (has_shape(size, "wheel") or size.dial_bolts):
        return None
    outlines = parts.outlines
    inside = outlines.assembly.sign < 0.0  # the contour is that of the opening
    edge = Polyarc([backwards(outlines.wheel) if inside else outlines.wheel])
    holes = wheel_holes(outlines.assembly, outlines.sizes)
    walls = [-beyond(edge, hole) for hole in holes]
    walls += [apart(one, two) for one, two in combinations(holes, 2)]
    for hole in holes if inside else ():
        assert isinstance(hole, Circle)  # an internal wheel has no bore
        x, y = hole.centre
        walls.append(outlines.sizes.outer - (x * x + y * y) ** 0.5 - hole.radius)
    return compared(name, min(walls), "at least", outlines.sizes.wall_min)


def branches(name: str, parts: FlatParts) -> Check | None:
    """The greatest distance of entry and exit branch of a curved slot, apart or where they crossed.

    If it exceeds the slot's width where both are on their own sides, an island falls out.
    """
    outlines = parts.outlines
    engagement, L = outlines.assembly.slots[0][0], outlines.assembly.L
    if not engagement.slot.curved:
        return None
    side, samples = 1.0 if name == "branches_apart_mm" else -1.0, 400
    t = engagement.entry_deg * (1.0 - np.arange(samples) / samples)
    (x, y), (u, v) = (engagement.slot(at, 0) for at in (t, opposites(engagement, t)))
    turn = np.remainder(
        np.arctan2(y.c[0], x.c[0]) - np.arctan2(v.c[0], u.c[0]) + np.pi, 2.0 * np.pi
    )
    gap = 2.0 * L * np.hypot(x.c[0], y.c[0]) * np.sin(0.5 * (turn - np.pi)) * side
    i = int(np.nanargmax(gap))  # NaN where the longer branch has no opposite
    at_deg = outlines.assembly.shown_deg(engagement.mid_deg + float(t[i]))
    most = 2.0 * outlines.sizes.half_width
    return compared(name, max(0.0, float(gap[i])), "at most", most, at_deg)


def cranks_apart(name: str, parts: FlatParts) -> Check | None:
    """The least gap between two cranks, and where it is."""
    if len(parts.mechanism.crank_places) < 2:
        return None
    outlines = parts.outlines
    # points of a crank in its own frame, and how far it reaches about each, mm
    near = 1e-5 * outlines.assembly.L  # chords of arcs miss the outline by less
    contours = [*outlines.crank, *([parts.arm.outline] if parts.arm else [])]
    edge = Polyarc(contours).samples(near, outlines.assembly.L) if contours else np.empty((0, 2))
    centres = [(0.0, 0.0), *roller_centres(outlines.assembly)]
    points = np.concatenate((edge, centres))
    rollers = [outlines.sizes.roller] * (len(centres) - 1)
    about = np.array([*[near] * len(edge), parts.axle_radius("crank"), *rollers])
    # directions: the bound is less than a thousandth of the axes' distance below the gap
    count = 3600
    step = math.tau / count
    around = step * np.arange(count, dtype=np.float64)

    def reach(directions: Array) -> Array:
        """How far a crank reaches from its axis in directions of its own frame, mm."""
        some = np.split(np.stack((np.cos(directions), np.sin(directions)), axis=1), count // 100)
        return np.concatenate([(way @ points.T + about).max(axis=1) for way in some])

    found = []
    ahead = reach(around)
    for one, other in combinations(parts.cranks, 2):
        between = complex(*other.at) - complex(*one.at)
        taken = ahead + reach(around - (other.turn - one.turn) + math.pi)
        # in each interval of the direction of the other's axis, from its middle to both ends
        gap = np.full(count, -math.inf)
        for off in range(-(count // 4), count // 4 + 1):
            least = abs(between) * math.cos((abs(off) + 0.5) * step)
            gap = np.maximum(gap, least - np.roll(taken, -off))
        i = int(np.argmin(gap))
        seen = math.atan2(between.imag, between.real) - one.turn  # at input angle 0
        # rounded far below the step of the directions
        at_deg = round(math.degrees(math.remainder(around[i] - seen, math.tau)), 6)
        found.append((float(gap[i]), at_deg))
    least_mm, at_deg = min(found)
    return compared(name, least_mm, "at least", 0.0, parts.mechanism.shown_deg(at_deg))


def wheels_apart(name: str, parts: FlatParts) -> Check | None:
    """The gap between the circles of adjacent wheels, each with all that it carries."""
    wheels = parts.mechanism.spec.drive.wheels_on_carrier
    if wheels < 2:
        return None
    between = 2.0 * parts.mechanism.center_distance_mm * math.sin(math.pi / wheels)
    return compared(name, between - 2.0 * reach_mm(parts.outlines), "at least", 0.0)


def reach_mm(outlines: Outlines) -> float:
    """Radius of the circle about a wheel's axis that contains it and its masses."""
    sizes = outlines.sizes
    return max(sizes.rim, sizes.outer, farthest_mm(outlines.assembly.mechanism.spec))
