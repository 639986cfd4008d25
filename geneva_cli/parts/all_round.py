"""Reliefs that go all the way round the locking disc, told before any wall is drawn.

The wheel's horns turn past the edges of a relief, which is widened by that; the more so the larger
the roller, and the deeper the recess. The corners of the recesses, which no slot moves, tell most
of it.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.crank import is_whole
from geneva_cli.parts.locking_rings import seen
from geneva_cli.parts.reliefs import Relief, followed, reliefs
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.turn.around import half_seen
from geneva_cli.parts.wheel import opening

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

PLACES = 91  # of a motion
CLEARLY = 0.01  # radians, and of the disc's radius: what is beyond by more is so by any places


def leave_no_disc(assembly: Assembly, sizes: Sizes) -> bool:
    """Whether reliefs that clear the recesses' corners overlap all round the disc.

    Told of machines with a law. What else a relief clears makes it no narrower.
    """
    # the corners are where the rim is the same at every mouth, and where there is a horn
    lawful = assembly.mechanism.law is not None and sizes.lock and sizes.horn > 0.0
    given = assembly.mechanism.spec.size.relief
    if not lawful or given == "arc" or not is_whole(assembly, sizes):
        return False
    wide = [_widened(assembly, sizes, one) for one in reliefs(assembly)]
    return all(one.end - after > CLEARLY for one, after in followed(wide))


def _widened(assembly: Assembly, sizes: Sizes, relief: Relief) -> Relief:
    """A relief as wide as the corners need it, of those that come well within the disc."""
    middle = 0.5 * (relief.start + relief.end)
    engagement, behind = assembly.motions[relief.motion]
    at = behind + np.linspace(engagement.entry_deg, engagement.exit_deg, PLACES)
    radius, off = seen(*corners(assembly, sizes, at), middle)
    off = off[radius < (1.0 - CLEARLY) * sizes.lock]
    low, high = float(off.min(initial=0.0)), float(off.max(initial=0.0))
    return relief._replace(
        start=min(relief.start, middle + low), end=max(relief.end, middle + high)
    )


def corners(assembly: Assembly, sizes: Sizes, at: Array) -> tuple[Array, Array]:
    """Where on the crank the recesses' corners come within the locking disc at input angles, in
    degrees: x and y, mm.

    Raises GenevaError where the rim does not meet the recesses.
    """
    half = opening(assembly.L, sizes.rim, sizes.recess)
    corner: Array = np.array([rest + side * half for rest in assembly.rests for side in (-1, 1)])
    turn = corner + assembly.wheel(at)[:, None]
    # only in directions near to that of the crank's axis is anything within the disc
    beside = np.abs(np.remainder(turn + math.pi, math.tau) - math.pi)
    place, which = np.nonzero(beside <= half_seen(sizes.lock, assembly.L))
    turn, pose = turn[place, which], assembly.crank(at)[place]
    x, y = sizes.rim * np.cos(turn) - assembly.L, sizes.rim * np.sin(turn)
    c, s = np.cos(pose), np.sin(pose)
    within = x * x + y * y < sizes.lock * sizes.lock
    return (x * c + y * s)[within], (y * c - x * s)[within]
