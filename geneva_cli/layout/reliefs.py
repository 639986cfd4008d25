"""The reliefs of the locking disc, and the sectors between them, as directions on the crank."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.layout.assembly import Assembly
from geneva_cli.layout.plain_sizes import Sizes
from geneva_cli.numerics.tolerances import SAME_ANGLE


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
    """Return the least distance from the axis of an arc that meets the disc at right angles.

    It is that of the widest relief; 0 for half a turn or more, where there is no such arc.
    """
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


def merged(around: list[Relief]) -> list[Relief]:
    """Return the reliefs, with those that touch joined into one."""
    joined = around[:1]
    for one in around[1:]:
        if one.start - joined[-1].end > SAME_ANGLE:
            joined.append(one)
        else:
            joined[-1] = joined[-1]._replace(end=max(one.end, joined[-1].end))
    if len(joined) > 1 and joined[0].start + math.tau - joined[-1].end <= SAME_ANGLE:
        joined = [joined[0]._replace(start=joined[-1].start - math.tau), *joined[1:-1]]
    return joined


def sectors(assembly: Assembly) -> list[tuple[float, float]]:
    """Return the sectors in which the disc locks: directions on the crank, radians, from and to."""
    return [
        (one.end, after)
        for one, after in followed(reliefs(assembly))
        if after - one.end > SAME_ANGLE
    ]


def keyway_direction(assembly: Assembly) -> float:
    """Return the keyway's direction: the middle of a locking sector, away from reliefs."""
    return next((0.5 * (start + end) for start, end in sectors(assembly)), math.pi)
