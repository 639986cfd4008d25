"""The wheel's outline: slots, rim and recesses in one closed contour."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache
from typing import NoReturn

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import turned
from geneva_cli.geometry.shapes import Arc, Contour, Point, Segment, about, closed
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.walls.straight import straight_walls
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.roller_paths import least_mouth
from geneva_cli.parts.turn.pairs import CONTACT

CURVED = CONTACT  # of the centre distance: accuracy of curved walls for the full turn


@dataclass(frozen=True)
class _CurvedSlot:
    """A curved slot; two are equal if what their walls depend on is equal."""

    engagement: Engagement
    lengths: tuple[float, ...]
    form: tuple[float, str]
    assembly: Assembly = field(compare=False)
    sizes: Sizes = field(compare=False)


# drawings, sheet and solids of one machine have the same walls, and so do machines of other locks
@lru_cache(maxsize=16)
def _curved(slot: _CurvedSlot) -> Contour:
    from geneva_cli.parts.outlines.walls.chain import curved_walls

    return curved_walls(slot.assembly, slot.sizes, slot.engagement, *slot.form)


def slot_walls(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, tolerance: float, curves: str = "arcs"
) -> Contour:
    """Return the walls of a slot, straight or curved; ``curves`` is "arcs" or "cubics"."""
    if not engagement.slot.curved:
        return straight_walls(assembly, sizes, engagement)
    lengths = assembly.L, assembly.sign, sizes.roller, sizes.half_width, sizes.rim
    return _curved(_CurvedSlot(engagement, lengths, (tolerance, curves), assembly, sizes))


def turned_walls(assembly: Assembly, sizes: Sizes) -> dict[Engagement, Contour]:
    """Return the walls of each kind of slot, as accurate as the full turn needs them."""
    fine = 0.5 * CURVED * assembly.L
    return {one: slot_walls(assembly, sizes, one, fine) for one in assembly.kinds}


def wheel_contour(
    assembly: Assembly, sizes: Sizes, slots: dict[Engagement, Contour], convex: bool = False
) -> Contour:
    """Return the wheel's contour, counterclockwise; an internal wheel's is its opening.

    With ``convex`` the recess opposite the first slot is a convex face at the rim, which stops the
    crank at both ends. At input angle 0 the crank is as far from one stop as from the other, or
    half a turn nearer to one.

    ``slots`` has the walls of each kind of slot, from one corner of the mouth round the bottom to
    the other. They are in the wheel's frame, with that slot ahead. Raises GenevaError where a
    recess leaves no horn next to a slot.
    """
    segments: list[Segment] = []
    around = assembly.slots
    walls = [turned(slots[engagement], direction).segments for engagement, direction in around]
    for i, (_, direction) in enumerate(around):
        following = (i + 1) % len(around)
        segments += walls[i]
        between = _between(assembly, direction, around[following][1])
        ends = segments[-1].end, walls[following][0].start
        if convex and i == len(around) // 2:
            segments.append(_about((0.0, 0.0), *ends, 1.0))
        else:
            segments += _rim(assembly, sizes, *ends, between)
    return closed("WHEEL", segments)


def _between(assembly: Assembly, start: float, end: float) -> float:
    """Return the direction of the recess between two adjacent slots, after the first one's."""
    span = (end - start) % math.tau
    return next(
        start + off
        for at in assembly.rests
        if (off := (at - start) % math.tau) < span or span == 0.0
    )


def _rim(assembly: Assembly, sizes: Sizes, start: Point, end: Point, at: float) -> list[Segment]:
    """Return the rim from one slot's corner, through the recess, to the next slot's corner."""
    first, last = math.atan2(start[1], start[0]), math.atan2(end[1], end[0])
    if math.remainder(last - first, math.tau) <= 0.0:
        raise GenevaError(
            "the mouths of adjacent slots overlap; a roller_radius_mm below "
            f"{sizes.roller:g} leaves a rim between them",
            ("size", "roller_radius_mm"),
        )
    last = first + (last - first) % math.tau
    at = first + (at - first) % math.tau
    axis = assembly.L * math.cos(at), assembly.L * math.sin(at)
    distances = math.dist(start, axis), math.dist(end, axis)
    if sizes.lock and min(distances) <= sizes.recess:
        _refuse(sizes, min(distances))
    own = math.hypot(*start), math.hypot(*end)
    least = least_mouth(assembly.L, sizes.recess, sizes.rim) if sizes.lock else max(own)
    raised = [least > rim + SAME_LENGTH * assembly.L and assembly.sign > 0.0 for rim in own]
    rims = [least if up else rim for up, rim in zip(raised, own, strict=True)]
    before: list[Segment] = []
    after: list[Segment] = []
    if raised[0]:
        first = at - opening(assembly.L, rims[0], distances[0])
        before.append(_about(axis, start, _on(rims[0], first), 1.0))
    if raised[1]:
        last = at + opening(assembly.L, rims[1], distances[1])
        after.append(_about(axis, _on(rims[1], last), end, 1.0))
    if not sizes.lock:
        return [*before, about((0.0, 0.0), rims[0], first, last - first), *after]
    low, high = (
        at + side * opening(assembly.L, rim, sizes.recess)
        for side, rim in zip((-1.0, 1.0), rims, strict=True)
    )
    return [
        *before,
        about((0.0, 0.0), rims[0], first, low - first),
        _about(axis, _on(rims[0], low), _on(rims[1], high), -assembly.sign),
        about((0.0, 0.0), rims[1], high, last - high),
        *after,
    ]


def _on(radius: float, angle: float) -> Point:
    return radius * math.cos(angle), radius * math.sin(angle)


def _about(axis: Point, start: Point, end: Point, sense: float) -> Arc:
    """Return an arc about an axis, counterclockwise (+1) or clockwise (-1)."""
    a, b = (math.atan2(y - axis[1], x - axis[0]) for x, y in (start, end))
    sweep = sense * (sense * (b - a) % math.tau)
    return Arc(start, end, math.tan(0.25 * sweep))


def _refuse(sizes: Sizes, distance: float) -> NoReturn:
    """Raise GenevaError: no horn is left at a slot whose mouth is ``distance`` from the axis."""
    most = sizes.lock + distance - sizes.recess
    raise GenevaError(
        f"no horn is left between slot and recess: lock_radius_mm = {sizes.lock:.6g} must be below "
        f"{most:.6g}, or the roller smaller",
        ("size", "lock_radius_mm"),
    )


def opening(L: float, rim: float, radius: float) -> float:
    """Return half the angle over which a circle about the crank's axis opens the rim.

    Raises GenevaError where the two circles do not meet.
    """
    cosine = (L * L + rim * rim - radius * radius) / (2.0 * L * rim)
    if not abs(cosine) < 1.0:
        raise GenevaError(
            f"wheel_radius_mm: a rim of {rim:.6g} mm does not meet the recess's circle of "
            f"{radius:.6g} mm; it must be between {abs(L - radius):.6g} and {L + radius:.6g}",
            ("size", "wheel_radius_mm"),
        )
    return math.acos(cosine)
