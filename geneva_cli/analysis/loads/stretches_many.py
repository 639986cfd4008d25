"""The motions of many designs, cut into stretches in which their loads are smooth."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.loads.contact import NEAR
from geneva_cli.analysis.loads.loaded_many import Loaded
from geneva_cli.machine.engagement import Engagement
from geneva_cli.numerics.cells import Cuts

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


def stretches_of(load: Loaded, spans: Sequence[tuple[Array, Array]], cuts: Cuts) -> Cuts:
    """The spans between cuts: ``x`` their two ends, ``positive`` their signs."""
    at = [(np.flatnonzero((b > a)[:, 0]), a[:, 0], b[:, 0]) for a, b in spans]
    firsts, lasts = [], []
    with np.errstate(all="ignore"):
        for number, (which, a, b) in enumerate(at):
            span = np.full(len(which), number)
            middle = 0.5 * (a + b)[which, None]
            signs = load.look(load.at(middle, which, 0))[0][..., 0]
            firsts.append((which, span, a[which], signs))
            lasts.append((which, span, b[which], signs))
    firsts.append((cuts.design, cuts.span, cuts.x, cuts.positive[1]))
    lasts.append((cuts.design, cuts.span, cuts.x, cuts.positive[0]))
    starts, stops = (
        [np.concatenate(part, axis=-1) for part in zip(*ends, strict=True)]
        for ends in (firsts, lasts)
    )
    by = [np.lexsort((x, span, design)) for design, span, x, _ in (starts, stops)]
    (design, span, a, positive), (_, _, b, before) = (
        [part[..., order] for part in parts]
        for parts, order in zip((starts, stops), by, strict=True)
    )
    # of a span's first stretch the signs are known at its end, of the others at their start too
    first = np.ones(len(design), dtype=bool)
    first[1:] = (design[1:] != design[:-1]) | (span[1:] != span[:-1])
    signs = np.where(first, before, positive)
    there = b > a
    return Cuts(design[there], span[there], np.stack((a, b))[:, there], signs[:, there])


def mirror_images(pieces: Cuts) -> Whole:
    """Of each stretch of symmetric motions the number of its mirror image, or else its own."""
    design, (a, b), every = pieces.design, pieces.x, np.arange(len(pieces.design))
    count = np.bincount(design, minlength=1)
    start = np.cumsum(count) - count
    other = 2 * start[design] + count[design] - 1 - every
    close = ALIKE * (b - a)
    alike = (np.abs(a + b[other]) <= close) & (np.abs(b + a[other]) <= close)
    images: Whole = np.where(alike & alike[other], other, every)
    return images


def to_mid_motion(engagement: Engagement, stretches: Cuts, n: int) -> Cuts:
    """Stretches of n designs up to the mid-motion of a curved slot; searches stop short of it."""
    if not engagement.slot.curved:
        return stretches
    x = stretches.x
    for end in (engagement.entry_deg, engagement.exit_deg):
        near = np.broadcast_to(np.ravel(NEAR * end), n)[stretches.design]
        x = np.where(x == near, 0.0, x)
    return stretches._replace(x=x)
