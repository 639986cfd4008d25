"""A motion as a pure shape: the share s of the step over the share u of the motion's time.

The shape is cut into panels on each of which its derivatives are polynomials to the last digit,
by Legendre's series: that is all that integrals over it need.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.machine.engagement import Engagement
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Number
from geneva_cli.numerics.budget import check_time

if TYPE_CHECKING:
    from geneva_cli.machine.engagement import Motion
    from geneva_cli.machine.laws.law import Law
    from geneva_cli.numerics.jet import Array

    # places u, ascending, and the highest order -> derivatives 1, 2, ... by u, a row each
    Derivatives = Callable[[Array, int], Array]

NODES = 32  # of Gauss's rule on a panel
TERMS = 20  # of Legendre's series that are kept
TAIL = 6  # the last of them, which say whether the series has ended
ENDED = 1e-13  # share of a derivative's greatest value, some hundred roundings of it
JUMP = 1e-12  # share of a derivative's greatest value: less of a jump is rounding
HIGHEST, LOWEST = 5, 2  # derivatives that are asked for, and that are needed
PANELS = 20_000  # more are not made for the sake of a higher derivative
SAME = 1e-13  # share of a width by which two may differ and be taken for one
NARROW = 1e-12  # share of the motion: a panel is not halved further

X = np.polynomial.legendre.leggauss(NODES)[0]


def _series() -> Array:
    """Values at the nodes -> coefficients of Legendre's series, to the last digits.

    The inverse of the polynomials' values at the nodes as they are rounded; one step of Newton's
    method in longer numbers, where the processor has them.
    """
    values = np.polynomial.legendre.legvander(X.astype(np.longdouble), NODES - 1)
    inverse = np.linalg.inv(values.astype(float)).astype(np.longdouble)
    better: Array = (inverse + inverse @ (np.eye(NODES) - values @ inverse)).astype(float)
    return better


SERIES = _series()


class Panels(NamedTuple):
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

    panels: tuple[Panels, ...]
    smooth: int
    greatest: Array
    variation: Array  # how much each derivative goes up and down in all, jumps and ends included


@lru_cache(maxsize=64)
def shape(engagement: Engagement) -> Shape:
    """The shape of an engagement's motion."""
    motion = engagement.motion
    return law_shape(motion.law) if motion.law else _panelled(*_of_motion(motion))


@lru_cache(maxsize=64)
def law_shape(law: Law) -> Shape:
    """The shape of a motion law."""

    def derivatives(u: Array, order: int) -> Array:
        return _by_order(law(u, order).c, 1.0, u)

    return _panelled(derivatives, sorted({0.0, *law.knots, 0.5, 1.0}))


def _of_motion(motion: Motion) -> tuple[Derivatives, Sequence[float]]:
    whole, step = motion.exit_deg - motion.entry_deg, 2.0 * motion.half_step

    def derivatives(u: Array, order: int) -> Array:
        c = motion(motion.entry_deg + u * whole, order).c
        return _by_order([v / step for v in c], whole * DEGREE, u)

    return derivatives, [(x - motion.entry_deg) / whole for x in motion.breaks_deg]


def _by_order(c: Sequence[Number], rate: float, u: Array) -> Array:
    """Derivatives 1, 2, ... from Taylor coefficients, by ``rate`` times the variable."""
    return np.array(
        [np.broadcast_to(v * (math.factorial(k) * rate**k), u.shape) for k, v in enumerate(c) if k]
    )


def _panelled(derivatives: Derivatives, breaks: Sequence[float]) -> Shape:
    """Panels for as high a derivative as neither jumps nor asks for too many of them."""
    for order in range(HIGHEST, LOWEST - 1, -1):
        found = _refined(derivatives, breaks, order)
        if found is not None:
            break
    assert found is not None  # the lowest has as many panels as it needs
    edges, values = found
    series = values @ SERIES.T
    greatest = np.abs(values).max(axis=(1, 2))
    jumps, variation = _jumps(edges, values, series)
    smooth = 1  # the wheel starts and stops without a jump of velocity
    while smooth < order - 1 and jumps[smooth] <= JUMP * greatest[smooth]:
        smooth += 1
    width = edges[:, 1] - edges[:, 0]
    by_width = width.argsort()
    # halving leaves widths that differ by the rounding of their ends
    new = np.flatnonzero(np.diff(width[by_width]) > SAME * width[by_width][1:]) + 1
    panels = []
    for at in np.split(by_width, new):
        kept = series[: smooth + 1, at, :TERMS]
        panels.append(Panels(0.5 * float(width[at[0]]), edges[at, 0], edges[at, 1], kept))
    return Shape(tuple(panels), smooth, greatest[: smooth + 1], variation[: smooth + 1])


def _refined(
    derivatives: Derivatives, breaks: Sequence[float], order: int
) -> tuple[Array, Array] | None:
    """Panels' ends, and derivatives on their nodes; None where they would be too many.

    Panels are halved until the series of each derivative has ended.
    """
    open_ = np.array(list(zip(breaks, breaks[1:], strict=False)))
    edges, values = [], []
    greatest = np.zeros(order)
    count = 0
    while len(open_):
        check_time()
        count += len(open_)
        if order > LOWEST and count > PANELS:
            return None
        left, width = open_[:, :1], open_[:, 1:] - open_[:, :1]
        at = left + width * (0.5 * (1.0 + X))
        found = derivatives(at.ravel(), order).reshape(order, *at.shape)
        greatest = np.maximum(greatest, np.abs(found).max(axis=(1, 2)))
        tail = np.abs(found @ SERIES[TERMS - TAIL :].T).max(axis=2)
        ended = (tail <= ENDED * greatest[:, None]).all(axis=0) | (width[:, 0] < NARROW)
        edges.append(open_[ended])
        values.append(found[:, ended])
        rest = open_[~ended]
        middle = rest.mean(axis=1)
        open_ = np.concatenate(
            (np.stack((rest[:, 0], middle), 1), np.stack((middle, rest[:, 1]), 1))
        )
    edge = np.concatenate(edges)
    by_place = edge[:, 0].argsort()
    return edge[by_place], np.concatenate(values, axis=1)[:, by_place]


def _jumps(edges: Array, values: Array, series: Array) -> tuple[Array, Array]:
    """Of each derivative its greatest jump between panels or at the ends, and its variation."""
    first = (series * (-1.0) ** np.arange(NODES)).sum(axis=2)  # at a panel's left end
    last = series.sum(axis=2)
    still = np.zeros((len(values), 1))
    jump = np.abs(np.concatenate((first, still), 1) - np.concatenate((still, last), 1))
    through = np.concatenate((first[:, :, None], values, last[:, :, None]), axis=2)
    return jump.max(axis=1), jump.sum(axis=1) + np.abs(np.diff(through)).sum(axis=(1, 2))
