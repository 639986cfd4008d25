"""The motions of many designs, cut into stretches in which their loads are smooth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.loads.contact import NEAR
from geneva_cli.machine.engagement import Engagement
from geneva_cli.numerics.search import Stretches

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array

ALIKE = 1e-9  # share of a stretch by which the ends of its mirror image may be off


def spans_of(engagement: Engagement, n: int) -> list[tuple[Array, Array]]:
    """Ends of the smooth parts of a motion, one after the other: (n, 1) each."""
    places = [
        np.broadcast_to(np.asarray(x, dtype=float), (n, 1)) for x in engagement.motion.breaks_deg
    ]
    out = []
    for i, (a, b) in enumerate(zip(places, places[1:], strict=False)):
        start = np.nextafter(a, np.inf) if i else a
        end = np.nextafter(b, -np.inf) if i + 2 < len(places) else b
        if engagement.slot.curved:
            start = np.where(a == 0.0, NEAR * engagement.exit_deg, start)
            end = np.where(b == 0.0, NEAR * engagement.entry_deg, end)
        out.append((start, end))
    return out


def mirror_images(pieces: Stretches) -> Whole:
    """Of each stretch of symmetric motions the number of its mirror image, or else its own."""
    design, (a, b), every = pieces.design, pieces.x, np.arange(len(pieces.design))
    count = np.bincount(design, minlength=1)
    start = np.cumsum(count) - count
    other = 2 * start[design] + count[design] - 1 - every
    close = ALIKE * (b - a)
    alike = (np.abs(a + b[other]) <= close) & (np.abs(b + a[other]) <= close)
    images: Whole = np.where(alike & alike[other], other, every)
    return images


def to_mid_motion(engagement: Engagement, stretches: Stretches, n: int) -> Stretches:
    """Stretches of n designs up to the mid-motion of a curved slot; searches stop short of it."""
    if not engagement.slot.curved:
        return stretches
    x = stretches.x
    for end in (engagement.entry_deg, engagement.exit_deg):
        near = np.broadcast_to(np.ravel(NEAR * end), n)[stretches.design]
        x = np.where(x == near, 0.0, x)
    return stretches._replace(x=x)
