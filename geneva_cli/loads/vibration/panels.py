"""Motions as pure shapes, cut into panels on which their derivatives are polynomials.

A shape is the fraction s of the step by the fraction u of the motion's time. Panels are halved
until a Legendre series of each derivative has ended, which is all that integrals over it need. The
panels of a batch of motions are computed together; a single motion is a batch of one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Whole, matrix_product

if TYPE_CHECKING:
    # Places u (p, k) of the motions (p,), and the highest order -> derivatives 1, 2, ...: (n, p,
    # k).
    Derivatives = Callable[[Array, Whole, int], Array]

NODES = 32  # of Gauss's rule on a panel
TERMS = 20  # of Legendre's series that are kept
HIGHEST, LOWEST = 5, 2  # order of the derivatives that are used at most, and at least

X = np.polynomial.legendre.leggauss(NODES)[0]


def _series() -> Array:
    """Matrix from values at the nodes to coefficients of Legendre's series, to the last digits.

    It is the inverse of the polynomials' values at the rounded nodes. One step of Newton's method
    in longer numbers improves it, if the processor has them.
    """
    values = np.polynomial.legendre.legvander(X.astype(np.longdouble), NODES - 1)
    inverse = np.linalg.inv(values.astype(float)).astype(np.longdouble)
    better: Array = (inverse + inverse @ (np.eye(NODES) - values @ inverse)).astype(float)
    return better


SERIES = _series()


class Panels(NamedTuple):
    """The panels of m motions, in the order of motions and of places: p in all.

    ``smooth`` is the highest derivative of a motion that jumps neither inside nor at the ends.
    ``greatest`` and ``variation``, (n, m), are valid up to the next derivative.
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

    @property
    def ends(self) -> Whole:
        """First panel of each motion, and the end of the last: (m + 1,)."""
        return np.searchsorted(self.motion, np.arange(len(self.smooth) + 1))

    def paired(self, motion: Whole) -> tuple[Whole, Whole, Whole]:
        """Pairs of an oscillator and a panel of its ``motion`` (n,), in order.

        The result has the numbers of both, and the first pair of each oscillator.
        """
        ends = self.ends
        count = (ends[1:] - ends[:-1])[motion]
        first = np.cumsum(count) - count
        of = np.repeat(np.arange(len(motion)), count)
        return of, np.arange(len(of)) + np.repeat(ends[motion] - first, count), first


class _Refined(NamedTuple):
    """Panels' motions and ends, and the derivatives at their nodes (order, p, NODES)."""

    motion: Whole
    edges: Array
    values: Array


def panels_of(derivatives: Derivatives, breaks: Array) -> Panels:
    """Panels of m motions, whose derivatives may jump at the ``breaks`` (m, k) of each.

    They hold up to the highest derivative that neither jumps nor needs too many panels.
    """
    m, parts, top = len(breaks), [], np.full(len(breaks), HIGHEST)
    rest = np.arange(m)
    for order in range(HIGHEST, LOWEST - 1, -1):
        part, rest = _refined(derivatives, breaks, rest, order)
        gap = np.zeros((HIGHEST - order, *part.values.shape[1:]))
        parts.append(part._replace(values=np.concatenate((part.values, gap))))
        top[rest] = order - 1
        if not len(rest):
            break
    motion, edges, values = _joined(parts)
    order_ = np.lexsort((edges[:, 0], motion))
    motion, (left, right), values = motion[order_], edges[order_].T, values[:, order_]
    series = matrix_product(values, SERIES.T)
    greatest = np.zeros((HIGHEST, m))
    for row, size in zip(greatest, np.abs(values).max(axis=2), strict=True):
        np.maximum.at(row, motion, size)
    jumps, variation = _jumps(motion, values, series, m)
    # the wheel starts and stops without a jump of velocity
    number = np.arange(1, HIGHEST)[:, None]
    # a jump of 1e-12 of a derivative's greatest value is rounding
    goes_on = (number < top - 1) & (jumps[1:] <= 1e-12 * greatest[1:])
    smooth = 1 + np.cumprod(goes_on, axis=0).sum(axis=0)
    return Panels(motion, left, right, series[..., :TERMS], smooth, greatest, variation)


def _refined(
    derivatives: Derivatives, breaks: Array, which: Whole, order: int
) -> tuple[_Refined, Whole]:
    """Panels of some motions for derivatives up to an order; and the motions that need too many.

    Panels are halved until the series of each derivative has ended, or holds only rounding.
    """
    m = len(breaks)
    open_ = np.stack((breaks[which, :-1].ravel(), breaks[which, 1:].ravel()), 1)
    motion = np.repeat(which, breaks.shape[1] - 1)
    wide = open_[:, 1] > open_[:, 0]
    open_, motion = open_[wide], motion[wide]
    before = np.full((order, len(open_)), np.inf)  # last terms of the panels that were halved
    closed: list[_Refined] = []
    greatest, count, many = np.zeros((order, m)), np.zeros(m, dtype=int), np.zeros(m, dtype=bool)
    most = 20_000  # panels: with more, a higher derivative does not pay
    while len(open_):
        np.add.at(count, motion, 1)
        left, width = open_[:, :1], open_[:, 1:] - open_[:, :1]
        rates = derivatives(left + width * (0.5 * (1.0 + X)), motion, order)
        for row, values in zip(greatest, np.abs(rates).max(axis=2), strict=True):
            np.maximum.at(row, motion, values)
        # the last six terms show whether the series has ended
        tail = np.abs(matrix_product(rates, SERIES[TERMS - 6 :].T)).max(axis=2)
        size = greatest[:, motion]
        rounding = (tail < 1e-6 * size) & _stays(tail, before)  # larger terms are of the motion
        # 1e-13 is some hundred roundings; panels narrower than 1e-12 of the motion are not halved
        ended = ((tail <= 1e-13 * size) | rounding).all(axis=0) | (width[:, 0] < 1e-12)
        if order > LOWEST:
            # rounding above 1e-11 spoils this derivative: a lower one has less
            many[motion[(rounding & (tail > 1e-11 * size)).any(axis=0)]] = True
            many |= count > most
        else:
            ended |= (count > most)[motion]
        closed.append(_Refined(motion[ended], open_[ended], rates[:, ended]))
        halved = ~(ended | many[motion])
        rest, of, before = open_[halved], motion[halved], np.tile(tail[:, halved], 2)
        middle = rest.mean(axis=1)
        halves = (np.stack((rest[:, 0], middle), 1), np.stack((middle, rest[:, 1]), 1))
        open_, motion = np.concatenate(halves), np.concatenate((of, of))
    motion, edges, values = _joined(closed)
    kept = ~many[motion]
    return _Refined(motion[kept], edges[kept], values[:, kept]), np.flatnonzero(many)


def _joined(parts: Sequence[_Refined]) -> _Refined:
    motion, edges, values = zip(*parts, strict=True)
    return _Refined(np.concatenate(motion), np.concatenate(edges), np.concatenate(values, axis=1))


def _stays(tail: Array, before: Array) -> Mask:
    """True for panels whose last terms did not shrink in either half when a panel was halved.

    Such terms are rounding. Terms of a smooth motion shrink to 2^-14 in both halves. Near a jump or
    a pole they shrink in one half. All left halves come before all right halves.
    """
    stays = tail > 0.25 * before  # random terms vary
    both: Mask = stays & np.roll(stays, stays.shape[1] // 2, axis=1)
    return both


def _jumps(motion: Whole, values: Array, series: Array, m: int) -> tuple[Array, Array]:
    """Greatest jump of each derivative between panels or at the ends, and the variation.

    (order, m) each.
    """
    first = (series * (-1.0) ** np.arange(NODES)).sum(axis=2)  # at a panel's left end
    last = series.sum(axis=2)
    begins = np.append(True, motion[1:] != motion[:-1])
    ends = np.append(begins[1:], True)
    before = np.where(begins, 0.0, np.roll(last, 1, axis=1))
    jump, stop = np.abs(first - before), np.where(ends, np.abs(last), 0.0)
    through = np.concatenate((first[:, :, None], values, last[:, :, None]), axis=2)
    rises = jump + stop + np.abs(np.diff(through)).sum(axis=2)
    greatest, variation = np.zeros((2, len(values), m))
    for k in range(len(values)):
        np.maximum.at(greatest[k], motion, np.maximum(jump[k], stop[k]))
        np.add.at(variation[k], motion, rises[k])
    return greatest, variation
