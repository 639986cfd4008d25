"""A test for reliefs that go all round the locking disc, before any wall is drawn.

The wheel's horns turn past the edges of a relief, which must be wider by that. A larger roller and
a deeper recess make it wider still. The corners of the recesses, which no slot moves, decide most
cases.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.layout.assembly import Assembly
from geneva_cli.layout.plain_sizes import Sizes
from geneva_cli.layout.reliefs import Relief, followed, reliefs
from geneva_cli.outlines.crank import is_whole
from geneva_cli.outlines.locking_rings import polar_points
from geneva_cli.outlines.wheel import opening

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

SAMPLING_MARGIN = 0.01  # radians, and of the disc's radius: more than the sampling can miss


def leave_no_disc(assembly: Assembly, sizes: Sizes) -> bool:
    """Return True if reliefs that clear the recesses' corners overlap all round the disc.

    It is computed for machines with a law. Whatever else a relief clears makes it no narrower.
    """
    # the corners are at the rim if that is equal at every mouth and there is a horn
    lawful = assembly.mechanism.law is not None and sizes.lock and sizes.horn > 0.0
    relief = assembly.mechanism.spec.size.relief
    if not lawful or relief == "arc" or not is_whole(assembly, sizes):
        return False
    wide = [_widened(assembly, sizes, one) for one in reliefs(assembly)]
    return all(one.end - after > SAMPLING_MARGIN for one, after in followed(wide))


def _widened(assembly: Assembly, sizes: Sizes, relief: Relief) -> Relief:
    """Return a relief as wide as those corners need that come well inside the disc."""
    middle = 0.5 * (relief.start + relief.end)
    engagement, behind = assembly.motions[relief.motion]
    at = behind + np.linspace(engagement.entry_deg, engagement.exit_deg, 91)
    radius, off = polar_points(*corners(assembly, sizes, at), middle)
    off = off[radius < (1.0 - SAMPLING_MARGIN) * sizes.lock]
    low, high = float(off.min(initial=0.0)), float(off.max(initial=0.0))
    return relief._replace(
        start=min(relief.start, middle + low), end=max(relief.end, middle + high)
    )


def corners(assembly: Assembly, sizes: Sizes, at: Array) -> tuple[Array, Array]:
    """Return the recesses' corners that are inside the locking disc at input angles, x and y, mm.

    They are in the crank's frame. Raises GenevaError where the rim does not meet the recesses.
    """
    half = opening(assembly.L, sizes.rim, sizes.recess)
    corner: Array = np.array([rest + side * half for rest in assembly.rests for side in (-1, 1)])
    turn = corner + assembly.wheel(at)[:, None]
    # only in directions near that of the crank's axis can a corner be inside the disc
    off = np.abs(np.remainder(turn + math.pi, math.tau) - math.pi)
    place, which = np.nonzero(off <= assembly.plane_motion.half_span(sizes.lock, assembly.L))
    turn, pose = turn[place, which], assembly.crank(at)[place]
    x, y = sizes.rim * np.cos(turn) - assembly.L, sizes.rim * np.sin(turn)
    c, s = np.cos(pose), np.sin(pose)
    within = x * x + y * y < sizes.lock * sizes.lock
    return (x * c + y * s)[within], (y * c - x * s)[within]
