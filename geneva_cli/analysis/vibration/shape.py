"""A motion as a pure shape: the share s of the step over the share u of the motion's time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.vibration.panels import Panels, panelled
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.many import taken
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Number, read_only

if TYPE_CHECKING:
    from geneva_cli.machine.engagement import Motion
    from geneva_cli.machine.laws.law import Law
    from geneva_cli.numerics.arrays import Array, Whole

SAME = 1e-13  # share of a width by which two may differ and be taken for one


class Alike(NamedTuple):
    """Equally wide panels: half their width, their ends, and what is on them."""

    half: float
    left: Array
    right: Array
    series: Array  # order - 1, panel, term: derivatives by u as Legendre series


class Shape(NamedTuple):
    """A motion's derivatives on panels, by their width.

    ``smooth`` is the highest derivative that neither jumps inside nor at the ends; derivatives to
    the next one are on the panels, and ``greatest`` holds the size of each.
    """

    panels: tuple[Alike, ...]
    smooth: int
    greatest: Array
    variation: Array  # how much each derivative goes up and down in all, jumps and ends included
    flat: Panels  # the same in the order of places


@lru_cache(maxsize=64)
def shape(engagement: Engagement) -> Shape:
    """The shape of an engagement's motion."""
    motion = engagement.motion
    return law_shape(motion.law) if motion.law else _by_width(motion_panels(motion, 1))


@lru_cache(maxsize=64)
def law_shape(law: Law) -> Shape:
    """The shape of a motion law."""

    def derivatives(u: Array, _: Whole, order: int) -> Array:
        return _by_order(law(u, order).c, 1.0, u)

    return _by_width(panelled(derivatives, np.array([sorted({0.0, *law.knots, 0.5, 1.0})])))


def motion_panels(motion: Motion, m: int) -> Panels:
    """The panels of the motions of m designs."""

    def derivatives(u: Array, which: Whole, order: int) -> Array:
        some: Motion = taken(motion, which)
        whole, step = some.exit_deg - some.entry_deg, 2.0 * some.half_step
        c = some(some.entry_deg + u * whole, order).c
        return _by_order([v / step for v in c], whole * DEGREE, u)

    ends = [np.broadcast_to(np.asarray(x, dtype=float), (m, 1)) for x in motion.breaks_deg]
    every = np.hstack(ends)
    return panelled(derivatives, (every - every[:, :1]) / (every[:, -1:] - every[:, :1]))


def _by_order(c: Sequence[Number], rate: float, u: Array) -> Array:
    """Derivatives 1, 2, ... from Taylor coefficients, by ``rate`` times the variable."""
    rows = [v * (math.factorial(k) * rate**k) for k, v in enumerate(c) if k]
    return np.array([np.broadcast_to(v, u.shape) for v in rows])


def _by_width(flat: Panels) -> Shape:
    smooth = int(flat.smooth[0])
    width = flat.right - flat.left
    by_width = width.argsort()
    # halving leaves widths that differ by the rounding of their ends
    new = np.flatnonzero(np.diff(width[by_width]) > SAME * width[by_width][1:]) + 1
    panels = []
    for at in np.split(by_width, new):
        kept = flat.series[: smooth + 1, at]
        panels.append(Alike(0.5 * float(width[at[0]]), flat.left[at], flat.right[at], kept))
    greatest, variation = (row[: smooth + 1, 0] for row in (flat.greatest, flat.variation))
    return read_only(Shape(tuple(panels), smooth, greatest, variation, flat))
