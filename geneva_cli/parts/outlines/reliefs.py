"""The reliefs of the locking disc, and the sectors between them, as directions on the crank."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.loads.tolerance.locking import Lock, loosest
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.tolerances import SAME_ANGLE, SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.roller_paths import mouth_corners

# radii of the corners of each kind of slot's mouth at entry and exit, mm
Mouths: TypeAlias = Mapping[Engagement, tuple[float, float]]


class Relief(NamedTuple):
    """A relief of the disc: its directions on the crank, radians, counterclockwise."""

    start: float
    end: float
    motion: int  # number of the motion that needs it

    @property
    def half(self) -> float:
        """Half of its width."""
        return 0.5 * (self.end - self.start)


def is_whole(assembly: Assembly, sizes: Sizes) -> bool:
    """Return True if some of the disc is left at the crank's axis."""
    return assembly.sign > 0.0 and assembly.L - sizes.rim > sizes.relief


def reliefs(assembly: Assembly) -> list[Relief]:
    """Return the reliefs around the crank: directions of the line of centres in motions."""
    unordered = []
    for i, (engagement, behind) in enumerate(assembly.motions):
        middle = assembly.lock(behind)
        ends = (assembly.lock(behind + at) for at in (engagement.entry_deg, engagement.exit_deg))
        start, end = sorted(middle + math.remainder(x - middle, math.tau) for x in ends)
        unordered.append(Relief(start, end, i))
    first = unordered[0].start
    out = []
    for one in unordered:
        start = first + (one.start - first + SAME_ANGLE) % math.tau - SAME_ANGLE
        out.append(one._replace(start=start, end=start + one.end - one.start))
    return sorted(out)


def arc_floor(assembly: Assembly, lock: float) -> float:
    """Return the least distance from the axis of an arc that meets the disc at right angles."""
    half = max(one.half for one in reliefs(assembly))
    wide = half > 0.5 * math.pi - SAME_ANGLE
    return 0.0 if wide else lock * math.tan(0.25 * math.pi - 0.5 * half)


def has_arcs(assembly: Assembly, lock: float) -> bool:
    """Return True if arcs relieve the disc; if gears widen the reliefs, they must leave a bore."""
    paired = any(engagement.apart for engagement in assembly.kinds)
    floor = arc_floor(assembly, lock)
    # L/18 about the axis is enough for a bore
    return floor >= (1.0 / 18.0) * assembly.L if paired else floor > 0.0


def without_lock(assembly: Assembly) -> bool:
    """Return True if two motions follow without a dwell, so that no disc is left between them."""
    return any(after - one.end <= SAME_ANGLE for one, after in followed(reliefs(assembly)))


def followed(around: list[Relief]) -> list[tuple[Relief, float]]:
    """Return each relief, and where the next one starts; between the two the disc locks."""
    starts = [one.start for one in around[1:]] + [around[0].start + math.tau]
    return list(zip(around, starts, strict=True))


def widened(assembly: Assembly, sizes: Sizes, mouths: Mouths) -> list[Relief]:
    """Return the reliefs as wide as the wheel's horns need, with those that touch joined."""
    joined: list[Relief] = []
    for one in (_widened(assembly, sizes, relief, mouths) for relief in reliefs(assembly)):
        if not joined or one.start - joined[-1].end > SAME_ANGLE:
            joined.append(one)
        else:
            joined[-1] = joined[-1]._replace(end=max(one.end, joined[-1].end))
    if len(joined) > 1 and joined[0].start + math.tau - joined[-1].end <= SAME_ANGLE:
        joined = [joined[0]._replace(start=joined[-1].start - math.tau), *joined[1:-1]]
    return joined


def _widened(assembly: Assembly, sizes: Sizes, one: Relief, mouths: Mouths) -> Relief:
    """Return a relief that clears both horns beside the slot of its motion.

    A horn's corner, p from the wheel's axis, is on the circle of the disc or of the recess where it
    is chi from the line of centres: p² + L² - 2 p L cos chi = k². In the motion it comes from the
    recess, passes the line and leaves the disc. It reaches farthest round the crank by then.
    """
    engagement, behind = assembly.motions[one.motion]
    L, half_step, middle = assembly.L, engagement.half_step, 0.5 * (one.start + one.end)
    # samples 1/2000 of the motion apart bring a greatest value to 1e-5 degrees
    at = np.linspace(engagement.entry_deg, engagement.exit_deg, 2001)
    turned = engagement.motion(at, 0).c[0]
    start, end, spare = one.start, one.end, sizes.relief / sizes.lock
    corners = mouths.get(engagement) or next(iter(mouths.values()))  # slots are equal
    for side, p in zip((1.0, -1.0), corners, strict=True):
        cosines = [(L * L + p * p - k * k) / (2.0 * L * p) for k in (sizes.lock, sizes.recess)]
        if max(cosines) >= 1.0:  # the corner never comes into the disc
            continue
        leaves, rests = (math.acos(max(cosine, -1.0)) for cosine in cosines)
        last = side * (leaves - half_step + rests)
        corner = side * (half_step - rests) + np.append(turned, last)
        x, y = p * np.cos(corner) - L, p * np.sin(corner)
        crank = assembly.crank(behind + np.append(at, np.interp(last, turned, at)))
        off = np.remainder(np.arctan2(y, x) - crank - middle + math.pi, math.tau) - math.pi
        off = off[np.hypot(x, y) < sizes.lock * (1.0 + SAME_LENGTH)]
        if off.min(initial=0.0) < -one.half - SAME_ANGLE:
            start = min(start, middle + off.min() - spare)
        if off.max(initial=0.0) > one.half + SAME_ANGLE:
            end = max(end, middle + off.max() + spare)
    return one._replace(start=float(start), end=float(end))


def sectors(around: list[Relief]) -> list[tuple[float, float]]:
    """Return the sectors in which the disc locks: directions on the crank, radians, from and to."""
    return [(one.end, after) for one, after in followed(around) if after - one.end > SAME_ANGLE]


def keyway_direction(assembly: Assembly) -> float:
    """Return the keyway's direction: the middle of a locking sector, away from reliefs."""
    return next((0.5 * (start + end) for start, end in sectors(reliefs(assembly))), math.pi)


def lock_of(where: Assembly, size: Sizes, cut: Sequence[float] = ()) -> Lock:
    """Return the lock of parts of these sizes, in its narrowest sector between two reliefs."""
    mouths = mouth_corners(where, size.roller, size.recess, size.rim)
    # arcs end where the motions do
    arcs = not is_whole(where, size) or where.mechanism.spec.size.relief == "arc"
    locking = sectors(reliefs(where) if arcs else widened(where, size, mouths))
    half = min((*(0.5 * (end - start) for start, end in locking), *cut), default=math.nan)
    edge = where.full.spec.size.lock_edge_mm or 0.0
    lock = Lock(where.L, where.sign, size.lock, size.recess, size.rim, half, edge)
    corners = [radius for mouth in mouths.values() for radius in mouth]
    if max(corners) - min(corners) < SAME_LENGTH * where.L:
        return lock
    near, far = abs(where.L - size.recess), where.L + size.recess
    tried = [lock._replace(corner=r) for r in sorted(corners) if near < r < far]
    return loosest(tried) if tried else lock
