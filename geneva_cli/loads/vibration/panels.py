"""Motions as pure shapes, cut into panels on which their derivatives are polynomials.

A shape is the fraction s of the step by the fraction u of the motion's time. Panels are halved
until a Legendre series of each derivative has ended, which is all that integrals over it need.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.motion.batch import selection
from geneva_cli.motion.engagement import WheelMotion
from geneva_cli.motion.laws.law import Law
from geneva_cli.motion.peak_search import breaks
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Number, Whole, matrix_product, read_only

if TYPE_CHECKING:
    # Places u (p, k) of the motions (p,), and the highest order -> Taylor coefficients of s by a
    # variable, and du over that variable.
    Taylor = Callable[[Array, Whole, int], tuple[Sequence[Number], Number]]

NODES = 32  # of Gauss's rule on a panel
TERMS = 20  # of Legendre's series that are kept
HIGHEST, LOWEST = 5, 2  # order of the derivatives that are used at most, and at least
MOST = 20_000  # panels of a motion: with more, a higher derivative does not pay

X = np.polynomial.legendre.leggauss(NODES)[0]
# Values at the nodes -> coefficients of Legendre's series, to the last digits: the inverse of the
# polynomials' values at the rounded nodes, and a step of Newton's method in longer numbers.
_values = np.polynomial.legendre.legvander(X.astype(np.longdouble), NODES - 1)
_inverse = np.linalg.inv(_values.astype(float)).astype(np.longdouble)
SERIES: Array = (_inverse + _inverse @ (np.eye(NODES) - _values @ _inverse)).astype(float)


class Panels(NamedTuple):
    """The panels of m motions, in the order of motions and of places: p in all.

    ``greatest`` and ``variation``, (n, m), are valid up to the derivative after ``smooth``.
    """

    motion: Whole  # (p,) motion of each panel
    left: Array  # (p,) ends of each panel
    right: Array
    series: Array  # (n, p, term): derivatives 1, 2, ... by u as Legendre series
    smooth: Whole  # (m,)
    greatest: Array  # greatest size of each derivative
    variation: Array  # total variation of each derivative, with jumps and ends

    @property
    def half(self) -> Array:
        """Half the width of each panel."""
        return 0.5 * (self.right - self.left)

    def paired(self, motion: Whole) -> tuple[Whole, Whole, Whole]:
        """Pairs of an oscillator and a panel of its ``motion`` (n,), in order.

        The result has the numbers of both, and the first pair of each oscillator.
        """
        ends = np.searchsorted(self.motion, np.arange(len(self.smooth) + 1))
        count = (ends[1:] - ends[:-1])[motion]
        first = np.cumsum(count) - count
        of = np.repeat(np.arange(len(motion)), count)
        return of, np.arange(len(of)) + np.repeat(ends[motion] - first, count), first


@lru_cache(maxsize=64)
def law_shape(law: Law) -> Panels:
    """The panels of a motion law."""
    cuts = np.array([sorted({0.0, *law.knots, 0.5, 1.0})])
    return read_only(_panels(lambda u, _, order: (law(u, order).c, 1.0), cuts))


def motion_shapes(motion: WheelMotion, m: int = 1) -> Panels:
    """The panels of the motions of m designs."""
    of_designs = selection(motion)

    def taylor(u: Array, which: Whole, order: int) -> tuple[Sequence[Number], Number]:
        some: WheelMotion = of_designs(which)
        whole, step = some.exit_deg - some.entry_deg, 2.0 * some.half_step
        angle = some(some.entry_deg + u * whole, order)
        return [v / step for v in angle.c], whole * DEGREE

    every = np.hstack(breaks(motion, m))
    return _panels(taylor, (every - every[:, :1]) / (every[:, -1:] - every[:, :1]))


def _panels(taylor: Taylor, breaks: Array) -> Panels:
    """Panels of m motions, whose derivatives may jump at the ``breaks`` (m, k) of each.

    They hold up to the highest derivative that neither jumps nor needs too many panels.
    """
    m, parts, rest = len(breaks), [], np.arange(len(breaks))
    top = np.full(m, HIGHEST)
    for order in range(HIGHEST, LOWEST - 1, -1):
        motion, edges, values, rest = _refined(taylor, breaks, rest, order)
        parts.append((motion, edges, np.pad(values, ((0, HIGHEST - order), (0, 0), (0, 0)))))
        top[rest] = order - 1
        if not len(rest):
            break
    motion, edges, values = _joined(parts)
    in_order = np.lexsort((edges[:, 0], motion))
    motion, (left, right), values = motion[in_order], edges[in_order].T, values[:, in_order]
    series = matrix_product(values, SERIES.T)
    # values at the ends of panels, and jumps between them
    first, last = (series * (-1.0) ** np.arange(NODES)).sum(axis=2), series.sum(axis=2)
    begins = np.append(True, motion[1:] != motion[:-1])
    jump = np.abs(first - np.where(begins, 0.0, np.roll(last, 1, axis=1)))
    stop = np.where(np.append(begins[1:], True), np.abs(last), 0.0)
    through = np.concatenate((first[:, :, None], values, last[:, :, None]), axis=2)
    rises = jump + stop + np.abs(np.diff(through)).sum(axis=2)
    greatest, jumps, variation = np.zeros((3, HIGHEST, m))
    for k in range(HIGHEST):
        np.maximum.at(greatest[k], motion, np.abs(values[k]).max(axis=1))
        np.maximum.at(jumps[k], motion, np.maximum(jump[k], stop[k]))
        np.add.at(variation[k], motion, rises[k])
    # A jump of 1e-12 of a derivative's greatest value is rounding. Only a crank as built starts and
    # stops the wheel with a jump of velocity.
    goes_on = (np.arange(HIGHEST)[:, None] < top - 1) & (jumps <= 1e-12 * greatest)
    smooth = np.cumprod(goes_on, axis=0).sum(axis=0)
    return Panels(motion, left, right, series[..., :TERMS], smooth, greatest, variation)


def _refined(
    taylor: Taylor, breaks: Array, which: Whole, order: int
) -> tuple[Whole, Array, Array, Whole]:
    """Panels of some motions for derivatives up to an order; and the motions that need too many.

    They are the panels' motions and ends, and the derivatives at their nodes (order, p, NODES).
    """
    m, closed = len(breaks), []
    open_ = np.stack((breaks[which, :-1].ravel(), breaks[which, 1:].ravel()), 1)
    motion = np.repeat(which, breaks.shape[1] - 1)
    wide = open_[:, 1] > open_[:, 0]
    open_, motion = open_[wide], motion[wide]
    before = np.full((order, len(open_)), np.inf)  # last terms of the panels that were halved
    greatest, count, many = np.zeros((order, m)), np.zeros(m, dtype=int), np.zeros(m, dtype=bool)
    while len(open_):
        np.add.at(count, motion, 1)
        left, width = open_[:, :1], open_[:, 1:] - open_[:, :1]
        u = left + width * (0.5 * (1.0 + X))
        c, rate = taylor(u, motion, order)
        rates = np.empty((order, *u.shape))
        for k in range(1, order + 1):
            rates[k - 1] = c[k] * (math.factorial(k) * rate**k)
        for row, values in zip(greatest, np.abs(rates).max(axis=2), strict=True):
            np.maximum.at(row, motion, values)
        # the last six terms show whether the series has ended
        tail = np.abs(matrix_product(rates, SERIES[TERMS - 6 :].T)).max(axis=2)
        size = greatest[:, motion]
        # Terms that shrank in neither half when a panel was halved are rounding; random ones vary.
        # Those of a smooth motion shrink to 2^-14 in both halves, near a jump or a pole in one. All
        # left halves come before all right halves.
        stays = tail > 0.25 * before
        stays &= np.roll(stays, stays.shape[1] // 2, axis=1)
        rounding = (tail < 1e-6 * size) & stays  # larger terms are of the motion
        # 1e-13 is some hundred roundings; panels narrower than 1e-12 of the motion are not halved
        ended = ((tail <= 1e-13 * size) | rounding).all(axis=0) | (width[:, 0] < 1e-12)
        if order > LOWEST:
            # rounding above 1e-11 spoils this derivative: a lower one has less
            many[motion[(rounding & (tail > 1e-11 * size)).any(axis=0)]] = True
            many |= count > MOST
        else:
            ended |= (count > MOST)[motion]
        closed.append((motion[ended], open_[ended], rates[:, ended]))
        halved = ~(ended | many[motion])
        rest, of, before = open_[halved], motion[halved], np.tile(tail[:, halved], 2)
        middle = rest.mean(axis=1)
        halves = (np.stack((rest[:, 0], middle), 1), np.stack((middle, rest[:, 1]), 1))
        open_, motion = np.concatenate(halves), np.concatenate((of, of))
    motion, edges, values = _joined(closed)
    kept = ~many[motion]
    return motion[kept], edges[kept], values[:, kept], np.flatnonzero(many)


def _joined(parts: Sequence[tuple[Whole, Array, Array]]) -> tuple[Whole, Array, Array]:
    motion, edges, values = zip(*parts, strict=True)
    return np.concatenate(motion), np.concatenate(edges), np.concatenate(values, axis=1)
