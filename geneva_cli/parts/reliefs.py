"""The reliefs of the locking disc, and the sectors between them, as directions on the crank."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.assembly import Assembly

BORED = 1.0 / 18.0  # of the centre distance: what an arc must leave about the axis for a bore


class Relief(NamedTuple):
    """A relief of the disc: its directions on the crank, radians, counterclockwise."""

    start: float
    end: float
    motion: int  # which it is for

    @property
    def half(self) -> float:
        """Half of its width."""
        return 0.5 * (self.end - self.start)


def reliefs(assembly: Assembly) -> list[Relief]:
    """The reliefs around the crank: the directions of the line of centres while the wheel moves."""
    found = []
    for i, (engagement, behind) in enumerate(assembly.motions):
        ends = [behind + engagement.entry_deg, behind + engagement.exit_deg]
        start, end = sorted(_lock_directions(assembly, behind, ends))
        found.append(Relief(start, end, i))
    first = found[0].start
    out = []
    for one in found:
        start = first + (one.start - first + SAME_ANGLE) % math.tau - SAME_ANGLE
        out.append(one._replace(start=start, end=start + one.end - one.start))
    return sorted(out)


def _lock_directions(assembly: Assembly, middle: float, ends: list[float]) -> list[float]:
    """The directions at the input angles ``ends``, within half a turn of that at ``middle``."""
    centre = assembly.lock(middle)
    return [centre + math.remainder(assembly.lock(end) - centre, math.tau) for end in ends]


def arc_room(assembly: Assembly, lock: float) -> float:
    """How near an arc that meets a disc at right angles comes to the axis, where a relief is
    widest; 0 where there is no such arc, over half a turn and more.
    """
    half = max(one.half for one in reliefs(assembly))
    wide = half > 0.5 * math.pi - SAME_ANGLE
    return 0.0 if wide else lock * math.tan(0.25 * math.pi - 0.5 * half)


def has_arcs(assembly: Assembly, lock: float) -> bool:
    """Whether arcs relieve the disc: not where gears widen its reliefs until they leave no bore."""
    paired = any(engagement.apart for engagement in assembly.kinds)
    room = arc_room(assembly, lock)
    return room >= BORED * assembly.L if paired else room > 0.0


def without_lock(assembly: Assembly) -> bool:
    """Whether two motions follow each other without a dwell, and no disc is left between them."""
    return any(after - one.end <= SAME_ANGLE for one, after in followed(reliefs(assembly)))


def followed(around: list[Relief]) -> list[tuple[Relief, float]]:
    """Each relief, and where the next one starts; between the two the disc locks."""
    starts = [one.start for one in around[1:]] + [around[0].start + math.tau]
    return list(zip(around, starts, strict=True))


def merged(around: list[Relief]) -> list[Relief]:
    """The reliefs, with those that touch joined into one."""
    found = around[:1]
    for one in around[1:]:
        if one.start - found[-1].end > SAME_ANGLE:
            found.append(one)
        else:
            found[-1] = found[-1]._replace(end=max(one.end, found[-1].end))
    if len(found) > 1 and found[0].start + math.tau - found[-1].end <= SAME_ANGLE:
        found = [found[0]._replace(start=found[-1].start - math.tau), *found[1:-1]]
    return found


def sectors(assembly: Assembly) -> list[tuple[float, float]]:
    """The sectors in which the disc locks: directions on the crank, radians, from and to."""
    return [
        (one.end, after)
        for one, after in followed(reliefs(assembly))
        if after - one.end > SAME_ANGLE
    ]


def keyway_direction(assembly: Assembly) -> float:
    """The direction of the crank's keyway: the middle of a locking sector, away from reliefs."""
    return next((0.5 * (start + end) for start, end in sectors(assembly)), math.pi)
