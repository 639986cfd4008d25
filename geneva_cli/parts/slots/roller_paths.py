"""The paths of the rollers' centres, and the ends of slots: mouths, and horns beside recesses.

With ``horn_tip_mm`` a horn's thin tip is cut off, square to its slot. Along the wall, with the
recess's centre at the depth d below it, k its radius and t the tip, the flat is at
s = sqrt(k² - (d - t)²) before the centre. With ``mouth_radius_mm`` an arc rounds the corner.
"""

import math
from functools import lru_cache

import numpy as np

from geneva_cli.errors import refuse_size
from geneva_cli.geometry import shapes
from geneva_cli.geometry.shapes import Arc, Line, Point, Segment
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import larger, library
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.stops import Lengths

TURN_SAMPLES = 720  # input angles at which a path is sampled


def roller_paths(assembly: Assembly) -> tuple[list[float], float, list[float]]:
    """Return how near the rollers' centres come to the axes, mm, whatever the rollers' radius.

    Of each kind of slot it is the least distance from the wheel's axis, of an internal wheel the
    greatest. Then the least distance of rollers and adjacent slots from the crank's axis, and that
    of each kind of roller at its mid-motion.
    """
    L, assembly, ends, near = assembly.L, assembly._replace(L=1.0), [], []
    for slot in assembly.kinds:
        kind = slot.through
        x, y = kind.slot(np.linspace(kind.entry_deg, kind.exit_deg, TURN_SAMPLES + 1), 0)
        points = np.column_stack((x.c[0], y.c[0] + 0.0 * x.c[0]))
        reach = np.hypot(*points.T)
        ends.append(L * float(reach.min() if assembly.sign > 0.0 else reach.max()))
        for end in (-1.0, 1.0):  # adjacent slots while the wheel rests
            axis = rest(assembly, kind, end)
            near.append(float(np.hypot(*(points - axis).T).min()))
            if kind.built is not None:  # their mouths may be nearer
                near.append(math.dist(_mouth(assembly, kind, end), axis))
    reaches: dict[Engagement, float] = {}
    turn = np.linspace(0.0, assembly.turn_deg, TURN_SAMPLES, endpoint=False)
    for i, (engagement, mid) in enumerate(assembly.rollers):
        if engagement not in reaches:  # others follow their leaders
            near.append(float(np.hypot(*(assembly.pin(i, turn) - (1.0, 0.0)).T).min()))
        x, y = assembly.pin(i, np.array([mid]))[0]
        reaches[engagement] = L * math.hypot(x - 1.0, y)
    return ends, L * min(near), list(reaches.values())


def mouth(assembly: Assembly, engagement: Engagement, r: float) -> float:
    """Return the rim's radius, where a roller of radius r enters and leaves a slot.

    There the roller touches the wall that faces the crank's axis, at the foot of the perpendicular
    from that axis. If it enters and leaves at two radii, no wall may stand in its way at either.
    """
    if not engagement.slot.offset:
        nearest = min if assembly.sign > 0.0 else max
        ends = engagement.reach(engagement.entry_deg), engagement.reach(engagement.exit_deg)
        away = assembly.L * float(nearest(*ends))
        if engagement.built is not None:
            away = math.hypot(*_mouth(assembly, engagement, 1.0))
        return library(away, r).hypot(away, r)
    entry, exit_ = (corner(assembly, engagement, end, r) for end in (-1.0, 1.0))
    m = library(*entry)
    return larger(m.hypot(*entry), m.hypot(*exit_))


def corner(assembly: Assembly, engagement: Engagement, end: float, r: float) -> tuple[float, float]:
    """Return the mouth's corner on the crank axis' side at entry (-1) or exit (1), mm."""
    px, py = _mouth(assembly, engagement, end)
    cx, cy = rest(assembly, engagement, end)
    ratio = r / library(px, py).hypot(px - cx, py - cy)
    return px + ratio * (cx - px), py + ratio * (cy - py)


def _mouth(assembly: Assembly, engagement: Engagement, end: float) -> Point:
    """Return the roller's centre at entry (-1) or exit (1), in the wheel's frame, mm.

    For a crank as built it is where a crank of the right R/L would have it: at the foot of the
    perpendicular from the crank's axis to the slot's.
    """
    x, y = engagement.slot(engagement.end_deg(end), 0)
    px, py = assembly.L * float(x.c[0]), assembly.L * float(y.c[0])
    if engagement.built is None:
        return px, py
    x, y = engagement.slot(0.0, 0)
    ux, uy = px - assembly.L * float(x.c[0]), py - assembly.L * float(y.c[0])
    cx, cy = rest(assembly, engagement, end)
    further = ((cx - px) * ux + (cy - py) * uy) / (ux * ux + uy * uy)
    return px + further * ux, py + further * uy


def least_mouth(assembly: Assembly, sizes: Lengths) -> float:
    """Return the radius to which lower mouths are extended, mm."""
    reach = assembly.L - sizes.recess
    return reach + 0.2 * (sizes.rim - reach)


def rest(assembly: Assembly, engagement: Engagement, end: float) -> tuple[float, float]:
    """Return the crank's axis in the wheel's frame before (-1) and after (1) a motion."""
    b = -end * engagement.half_step
    return assembly.L * math.cos(b), assembly.L * math.sin(b)


@lru_cache(maxsize=16)  # the sizes under a load try many bores of one machine
def roller_centres(assembly: Assembly) -> tuple[Point, ...]:
    """Return the centres of the rollers on the first crank, each at its mid-motion."""
    centres = []
    on_first = slice(1) if len(assembly.full.crank_places) > 1 else slice(None)
    for number, (_, behind) in enumerate(assembly.rollers[on_first]):
        at = np.array([behind])
        x, y = (assembly.pin(number, at) - (assembly.L, 0.0))[0]
        angle = math.atan2(y, x) - float(assembly.crank(at)[0])
        reach = math.hypot(x, y)
        centres.append((reach * math.cos(angle), reach * math.sin(angle)))
    return tuple(centres)


def tip(wall: Line, centre: Point, recess: float, width: float) -> Line | None:
    """Return the flat of a horn, from a wall that runs outwards to the recess; None without one.

    A horn that is thick enough has none.
    ``centre`` and ``recess`` are centre and radius of the recess, and ``width`` is the flat's.
    """
    (x, y), long = wall.start, math.dist(wall.start, wall.end)
    u, v = (wall.end[0] - x) / long, (wall.end[1] - y) / long
    foot = (centre[0] - x) * u + (centre[1] - y) * v
    side = (centre[1] - y) * u - (centre[0] - x) * v
    depth = abs(side) - width
    if not width or depth >= recess:
        return None
    at = foot - math.sqrt(max(recess**2 - depth * depth, 0.0))
    if at >= long:
        return None
    text = "the horns would lose more than half of the slots: reduce it, or lock_radius_mm"
    refuse_size(depth <= 0.0 or at <= 0.5 * long, "horn_tip_mm", text, width)
    across = math.copysign(width, side)
    on_wall = x + at * u, y + at * v
    return Line(on_wall, (on_wall[0] - across * v, on_wall[1] + across * u))


def rounded(before: Segment, after: Segment, radius: float, sign: float) -> list[Segment]:
    """Return two pieces with an arc between them; ``sign`` is 1 with the material on the left."""
    from geneva_cli.geometry import offsets

    assert isinstance(before, Line | Arc) and isinstance(after, Line | Arc)  # slots are straight
    centre = offsets.corner(before, after, sign * radius)
    ends, parts = [], []
    for piece in (before, after):
        distance, (x, y) = offsets.away(piece, centre)
        ends.append((centre[0] - distance * x, centre[1] - distance * y))
        parts.append(shapes.fraction_at(piece, ends[-1]))
    text = "a mouth's corner has no space for this rounding; use a smaller one"
    fits = 0.0 < parts[0] <= 1.0 and 0.0 <= parts[1] < 1.0
    refuse_size(not fits, "mouth_radius_mm", text, radius)
    first, last = ends
    begin = offsets.between(before, before.start, first)
    finish = offsets.between(after, last, after.end)
    return [begin, arc_about(centre, first, last, sign), finish]


def arc_about(axis: Point, start: Point, end: Point, sense: float) -> Arc:
    """Return an arc about an axis, counterclockwise (+1) or clockwise (-1)."""
    a = math.atan2(start[1] - axis[1], start[0] - axis[0])
    b = math.atan2(end[1] - axis[1], end[0] - axis[0])
    return Arc(start, end, math.tan(0.25 * (sense * (sense * (b - a) % math.tau))))
