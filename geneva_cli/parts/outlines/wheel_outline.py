"""The wheel's outline: slots, rim and recesses in one closed contour; the walls of straight slots.

Where gears drive between two rollers, a motion has two slots, half of the angle between them on
either side of its middle. A roller leaves the first on an epicycloid, which sweeps away the side
towards the other slot. So each keeps the wall on its recess's side, with an arc between the two.
"""

from __future__ import annotations

import math
from itertools import chain

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import (
    ORIGIN,
    Arc,
    Contour,
    Line,
    Point,
    Segment,
    about,
    closed,
    joined,
    polar,
    turned,
    turned_pieces,
)
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.tolerances import SAME_ANGLE, SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.roller_paths import corner, least_mouth, mouth, rest, rounded, tip
from geneva_cli.parts.turn.turned_parts import CONTACT

CURVED = CONTACT  # of the centre distance: accuracy of curved walls for the full turn


def turned_walls(assembly: Assembly, sizes: Sizes) -> dict[Engagement, Contour]:
    """Return the walls of each kind of slot, as accurate as the full turn needs them."""
    walls = {}
    for kind in assembly.kinds:
        walls[kind] = slot_walls(assembly, sizes, kind, 0.5 * CURVED * assembly.L)
    return walls


def slot_walls(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, tolerance: float, curves: str = "arcs"
) -> Contour:
    """Return a slot's walls, counterclockwise from one corner of its mouth to the other.

    Those of a curved slot are "arcs" or "cubics" within a tolerance, mm. A pair of slots has the
    arc between them too. The wall that faces the crank's axis at entry ends where the roller
    enters, the other where it leaves: at different radii if slots are offset.
    """
    if engagement.slot.curved:
        from geneva_cli.parts.outlines.curved_walls import curved_walls

        return curved_walls(assembly, sizes, engagement, tolerance, curves)
    apart, engagement = engagement.apart, engagement.through
    L, w, out = assembly.L, sizes.half_width, assembly.sign
    # direction of the slot's axis, and its distance from the wheel's centre
    x, y = engagement.slot(engagement.entry_deg, 0)
    u, v = engagement.slot(0.0, 0)
    angle = math.atan2(out * (y.c[0] - v.c[0]), out * (x.c[0] - u.c[0]))
    c, s = math.cos(angle), math.sin(angle)
    level = float(L * y.c[0] * c - L * x.c[0] * s)
    level = level if abs(level) > 1e-12 * L else 0.0
    # the deepest position of the roller's centre along it
    x, y = engagement.slot(np.linspace(engagement.entry_deg, engagement.exit_deg, 721), 0)
    along = array(L * (x.c[0] * c + y.c[0] * s))
    bottom = float(along.min() if out > 0.0 else along.max()) - out * sizes.slot_bottom
    # if the spec sets the rim, it moves all mouths by as much as the widest one
    widest, starts = 0.0, list[float]()
    for one in assembly.kinds:
        widest = max(widest, mouth(assembly, one, sizes.roller))
    for side in (-1.0, 1.0):
        rim, across = mouth(assembly, engagement, sizes.roller), level + side * w
        if level:
            x0, y0 = rest(assembly, engagement, -1.0)
            end = -1.0 if (y0 * c - x0 * s > level) == (side > 0.0) else 1.0
            rim = math.hypot(*corner(assembly, engagement, end, sizes.roller))
        start = math.sqrt(max((rim + (sizes.rim - widest)) ** 2 - across * across, 0.0))
        if not out * (start - bottom) > 0.0:
            raise GenevaError(
                f"wheel_radius_mm = {sizes.rim:g}: the rim does not reach the slots' ends, which "
                f"lie at {bottom:.6g} mm",
                ("size", "wheel_radius_mm"),
            )
        starts.append(start)
    first = Line((starts[0], level - w), (bottom, level - w))
    last = Line((bottom, level + w), (starts[1], level + w))
    if abs(apart) < SAME_ANGLE:
        pieces: tuple[Segment, ...] = (first, Arc(first.end, last.start, -out), last)
    else:
        middle = (bottom - w, 0.0)
        quarter = math.tan(math.pi / 8.0)  # the bulge of a quarter of a circle
        begin = turned_pieces([first, Arc(first.end, middle, -quarter)], -apart)
        between = about(ORIGIN, middle[0], -apart, 2.0 * apart)
        finish = turned_pieces([Arc(middle, last.start, -quarter), last], apart)
        pieces = (*begin, between, *finish)
    return turned(Contour("WHEEL", joined(pieces), closed=False), angle)


def wheel_contour(
    assembly: Assembly, sizes: Sizes, slots: dict[Engagement, Contour], convex: bool = False
) -> Contour:
    """Return the wheel's contour, counterclockwise; an internal wheel's is its opening.

    With ``convex`` the recess opposite the first slot is a convex face at the rim, which stops the
    crank at both ends. ``slots`` has the walls of each kind of slot, in the wheel's frame, with
    that slot ahead.
    """
    around, walls, rims = assembly.slots, list[list[Segment]](), list[list[Segment]]()
    for engagement, direction in around:
        walls.append([*turned(slots[engagement], direction).segments])
    for i, (_, start) in enumerate(around):
        following = (i + 1) % len(around)
        before, after = walls[i], walls[following]
        if convex and i == len(around) // 2:
            rims.append([_about(ORIGIN, before[-1].end, after[0].start, 1.0)])
            continue
        span = (around[following][1] - start) % math.tau
        for at in assembly.rests:  # the first between the two is the recess
            off = (at - start) % math.tau
            if off < span or span == 0.0:
                break
        rims.append(_rim(assembly, sizes, before, after, start + off))
    if sizes.mouth_radius:
        for i, rim in enumerate(rims):
            _round_mouths(assembly, sizes, walls[i], rim, walls[(i + 1) % len(walls)])
    return closed("WHEEL", chain.from_iterable(chain(*zip(walls, rims, strict=True))))


def _round_mouths(
    assembly: Assembly,
    sizes: Sizes,
    before: list[Segment],
    rim: list[Segment],
    after: list[Segment],
) -> None:
    """Round the corners at both ends of a rim, and of the walls of the slots beside it.

    A mouth that is extended along the roller's circle has its corner at the rim.
    """

    def is_extension(piece: Segment) -> bool:
        return isinstance(piece, Arc) and math.hypot(*piece.centre) > 0.1 * piece.radius

    def corner(one: Segment, two: Segment) -> list[Segment]:
        assert isinstance(one, Line | Arc) and isinstance(two, Line | Arc)  # slots are straight
        return rounded(one, two, sizes.mouth_radius, assembly.sign)

    if is_extension(rim[0]):
        rim[:2] = corner(*rim[:2])
    else:
        before[-1], *rim[:1] = corner(before[-1], rim[0])
    if is_extension(rim[-1]):
        rim[-2:] = corner(*rim[-2:])
    else:
        *rim[-1:], after[0] = corner(rim[-1], after[0])


def _rim(
    assembly: Assembly, sizes: Sizes, before: list[Segment], after: list[Segment], at: float
) -> list[Segment]:
    """Return the rim from one slot's corner, through the recess, to the next slot's corner.

    A mouth that the recess does not reach is extended along the roller's circle about the crank's
    axis. Horns thinner than ``horn_tip_mm`` are cut back to flats, at which the walls then end.
    """
    L = assembly.L
    flats: tuple[Line | None, Line | None] = None, None
    if sizes.lock and sizes.horn_tip:
        flats = _cut_back(sizes, before, after, polar(ORIGIN, L, at))
    start, end = before[-1].end, after[0].start
    first, last = math.atan2(start[1], start[0]), math.atan2(end[1], end[0])
    if math.remainder(last - first, math.tau) <= 0.0:
        raise GenevaError(
            "the mouths of adjacent slots overlap; a roller_radius_mm below "
            f"{sizes.roller:g} leaves a rim between them",
            ("size", "roller_radius_mm"),
        )
    last = first + (last - first) % math.tau
    at = first + (at - first) % math.tau
    axis = polar(ORIGIN, L, at)
    distances = math.dist(start, axis), math.dist(end, axis)
    near = math.inf if flats[0] else distances[0]
    near = min(near, math.inf if flats[1] else distances[1])
    if sizes.lock and near <= sizes.recess:
        raise GenevaError(
            f"no horn is left between slot and recess: lock_radius_mm = {sizes.lock:.6g} must be "
            f"below {sizes.lock + min(distances) - sizes.recess:.6g}, or the roller smaller",
            ("size", "lock_radius_mm"),
        )
    rims = [math.hypot(*start), math.hypot(*end)]
    least = least_mouth(L, sizes.recess, sizes.rim) if sizes.lock else max(rims)
    rising: list[Segment] = []
    falling: list[Segment] = []
    outside = assembly.sign > 0.0
    if outside and not flats[0] and least > rims[0] + SAME_LENGTH * L:
        rims[0], first = least, at - _opening(L, least, distances[0])
        rising.append(_about(axis, start, polar(ORIGIN, least, first), 1.0))
    if outside and not flats[1] and least > rims[1] + SAME_LENGTH * L:
        rims[1], last = least, at + _opening(L, least, distances[1])
        falling.append(_about(axis, polar(ORIGIN, least, last), end, 1.0))
    if not sizes.lock:
        return [*rising, about(ORIGIN, rims[0], first, last - first), *falling]
    if flats[0]:
        rising, first_edge = [flats[0]], flats[0].end
    else:
        low = at - _opening(L, rims[0], sizes.recess)
        rising.append(about(ORIGIN, rims[0], first, low - first))
        first_edge = polar(ORIGIN, rims[0], low)
    if flats[1]:
        falling, last_edge = [Line(flats[1].end, end)], flats[1].end
    else:
        high = at + _opening(L, rims[1], sizes.recess)
        falling.insert(0, about(ORIGIN, rims[1], high, last - high))
        last_edge = polar(ORIGIN, rims[1], high)
    return [*rising, _about(axis, first_edge, last_edge, -assembly.sign), *falling]


def _cut_back(
    sizes: Sizes, before: list[Segment], after: list[Segment], axis: Point
) -> tuple[Line | None, Line | None]:
    """Cut thin horns beside a recess about an axis, and the walls there; return their flats."""
    one, other, k, flat = before[-1], after[0], sizes.recess, sizes.horn_tip
    assert isinstance(one, Line) and isinstance(other, Line)
    first, last = tip(one, axis, k, flat), tip(Line(other.end, other.start), axis, k, flat)
    before[-1] = one._replace(end=first.start) if first else one
    after[0] = other._replace(start=last.start) if last else other
    return first, last


def _about(axis: Point, start: Point, end: Point, sense: float) -> Arc:
    """Return an arc about an axis, counterclockwise (+1) or clockwise (-1)."""
    a = math.atan2(start[1] - axis[1], start[0] - axis[0])
    b = math.atan2(end[1] - axis[1], end[0] - axis[0])
    sweep = sense * (sense * (b - a) % math.tau)
    return Arc(start, end, math.tan(0.25 * sweep))


def _opening(L: float, rim: float, radius: float) -> float:
    """Return half the angle over which a circle about the crank's axis opens the rim."""
    cosine = (L * L + rim * rim - radius * radius) / (2.0 * L * rim)
    if not abs(cosine) < 1.0:
        raise GenevaError(
            f"wheel_radius_mm: a rim of {rim:.6g} mm does not meet the recess's circle of "
            f"{radius:.6g} mm; it must be between {abs(L - radius):.6g} and {L + radius:.6g}",
            ("size", "wheel_radius_mm"),
        )
    return math.acos(cosine)
