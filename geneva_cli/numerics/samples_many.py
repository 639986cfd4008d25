"""Samples of many designs' spans: which of the cells between them are as good as cubics."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeVar

import numpy as np

from geneva_cli.numerics.between_samples import MISSES
from geneva_cli.numerics.cells import Beside, Cells, Range, Turns, may_turn, turns_of
from geneva_cli.numerics.cubics import between, cubic, touches
from geneva_cli.numerics.extrema_many import ROUNDING, goes_back
from geneva_cli.numerics.quintics import CELL, NEARLY, misses_of_cells

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.extrema_many import Sample
    from geneva_cli.numerics.jet import Array

T = TypeVar("T", "Array", "Mask")
# Of the range, by which a cubic may miss a sample: of loads beside a pole, which one of three times
# this share predicts, an extreme of one in 100,000 is passed over, by 1e-5 to 1e-4.
SHARE = 3e-3


class Matters(Protocol):
    """Of functions that three samples do not predict, those for which it matters."""

    def __call__(
        self, missed: Mask, design: Whole, left: Sample, middle: Sample, right: Sample
    ) -> Mask:
        """``missed`` (functions, m, ...) without the others; the designs are (m,)."""


class Samples(NamedTuple):
    """Samples of a span of m designs, whose places lie side by side in memory: (..., m, k)."""

    design: Whole  # (m,)
    span: int
    x: Array
    positive: Mask  # (signs, m, k)
    value: Array  # (functions, m, k)
    slope: Array  # by degrees

    @property
    def differ(self) -> Mask:
        """The cells, between each sample and the next, in which a sign changes: (m, k - 1)."""
        changes: Mask = self.positive[..., :-1] != self.positive[..., 1:]
        return np.asarray(changes.any(axis=0))

    def numbers(self, where: Mask) -> tuple[Whole, Whole]:
        """Of some of the cells the number of the design among these, and of the sample before."""
        column, row = np.divmod(_numbers(where), len(self.design))
        return row, column

    def cells(self, where: Mask) -> Cells:
        """Some of the cells."""
        index = _numbers(where)
        numbers = self._designs(index), np.full(len(index), self.span)
        ends = [(self._at(index, i, self.positive), *self._three(index, i)) for i in (0, 1)]
        positive, x, value, slope = (np.stack(pair) for pair in zip(*ends, strict=True))
        return Cells(*numbers, x, positive, value, slope)

    def beside(self, where: Mask) -> Beside:
        """What is on both sides of some of the cells."""
        index = _numbers(where)
        alike = np.zeros((where.shape[1] + 2, len(where)), dtype=bool)
        alike[1:-1] = ~self.differ.T
        known = np.stack([alike.ravel()[index + shift * len(where)] for shift in (0, 2)])
        ends = zip(*[self._three(index, shift) for shift in (-1, 2)], strict=True)
        return Beside(known, *map(np.stack, ends))

    def open(self, range_: Range, bounded: Mask, differ: Mask, matters: Matters) -> Mask:
        """Which of the cells in which no sign changes must be looked at again.

        Pairs of cells are judged by the sample where they meet: the 1st with the 2nd, and so on,
        and a cell whose partner has a change of sign with its other neighbour. Of a function that
        is not ``bounded`` none that is near its pole is, nor of any one that does not matter.
        """
        signs, x, value, slope = len(self.positive), self.x, self.value, self.slope
        left, middle, right = (
            (x[:, part], value[:, :, part], slope[:, :, part])
            for part in (slice(0, -1, 2), slice(1, None, 2), slice(2, None, 2))
        )
        low, high = range_.low[:, self.design], range_.high[:, self.design]
        of_pairs = low[..., None], high[..., None]
        missed = unpredicted_at(left, middle, right, of_pairs, signs)
        crossed = differ[:, ::2] | differ[:, 1::2]
        held = None if bounded.all() else range_.holds(self.design, value)
        if held is not None:
            both = held[..., :-1:2] & held[..., 1::2] & held[..., 2::2]
            missed &= bounded[..., None] | both
        missed = matters(missed & ~crossed, self.design, left, middle, right)
        lost = missed.any(axis=0)
        v, d, width = value[:signs], slope[:signs], x[:, 1:] - x[:, :-1]
        found = touches(width, v[..., :-1], d[..., :-1], v[..., 1:], d[..., 1:]).any(axis=0)
        found |= np.repeat(lost, 2, axis=1)
        index = _numbers(np.repeat(crossed, 2, axis=1) & ~differ & ~found)
        column, row = np.divmod(index, len(differ))
        odd = column % 2
        other = column - 1 + 2 * odd  # of the next pair
        last = differ.shape[1] - 1
        alone = (other < 0) | (other > last) | differ[row, np.clip(other, 0, last)]
        one, two, three = (self._three(index, odd + i) for i in (-1, 0, 1))
        missed = unpredicted_at(one, two, three, (low[:, row], high[:, row]), signs)
        if held is not None:
            within = [self._at(index, odd + i, held) for i in (-1, 0, 1)]
            missed &= bounded[:, row] | np.logical_and.reduce(within)
        alone |= matters(missed, self.design[row], one, two, three).any(axis=0)
        found[row[alone], column[alone]] = True
        return found & ~differ

    def turns(self, row: int, k: int, range_: Range, where: Mask) -> Turns:
        """Of some of the cells those in which the function ``row`` may turn, the k-th wanted."""
        level = range_.level(row, self.design)[:, None] / (self.x[:, 1:] - self.x[:, :-1])
        slope = self.slope[row]
        index = _numbers(may_turn(slope[:, :-1], slope[:, 1:], level) & where)
        rows = self.x, self.value[row], slope
        left, right = (np.stack([self._at(index, end, one) for one in rows]) for end in (0, 1))
        positive = self._at(index, 0, self.positive)
        of = self._designs(index), np.full(len(index), self.span)
        return turns_of(k, of, _flat(level)[index], positive, left, right)

    def _designs(self, index: Whole) -> Whole:
        """The designs of some cells or samples."""
        return self.design[index % len(self.design)]

    def _three(self, index: Whole, shift: int | Whole) -> tuple[Array, Array, Array]:
        """Places, values and slopes of samples so many places after some others."""
        x, value, slope = (self._at(index, shift, one) for one in (self.x, self.value, self.slope))
        return x, value, slope

    def _at(self, index: Whole, shift: int | Whole, one: T) -> T:
        """Something of them; those beyond the ends of a span are any."""
        return np.take(_flat(one), index + shift * len(self.design), axis=-1, mode="clip")


def _flat(samples: T) -> T:
    """Samples (..., m, k) as (..., k m), as they lie in memory."""
    *rows, m, k = samples.shape  # of no rows NumPy could not tell k m
    return samples.swapaxes(-1, -2).reshape(*rows, k * m)


def _numbers(where: Mask) -> Whole:
    """The numbers, in memory, of some of the samples or cells (m, k)."""
    return np.flatnonzero(_flat(where))


def unpredicted_at(
    left: Sample,
    middle: Sample,
    right: Sample,
    range_: tuple[Array, Array],
    signs: int,
    changes: Mask | None = None,
) -> Mask:
    """As of ``unpredicted``, of a sample that is anywhere between its neighbours.

    Of the first functions, whose signs count, it is enough that the cubics of both cells are good;
    but not where they come near 0, for they may have been beyond it, if they do not change there.
    """
    low, high = range_
    rounding = ROUNDING * np.maximum(np.abs(low), np.abs(high))
    off, room = middle[1] - between(left, right, middle[0]), SHARE * (high - low) + rounding
    off = np.abs(off)
    missed: Mask = off > room
    where = np.nonzero(missed[:signs] & (off[:signs] < NEARLY * room[:signs]))
    if len(where[0]):
        three = some_of(left, where), some_of(middle, where), some_of(right, where)
        nearest = np.minimum.reduce([np.abs(v) for _, v, _ in three])
        apart = nearest > MISSES * off[where]
        if changes is not None:
            apart |= changes[where]
        good = misses_of_cells(*three) <= CELL * np.broadcast_to(room, off.shape)[where]
        missed[where] = ~(apart & good)
    missed |= goes_back(left, middle, rounding)
    return missed | goes_back(middle, right, rounding)


def some_of(sample: Sample, where: tuple[Whole, ...]) -> Sample:
    """Some functions of a sample, each at some of the places, which all functions share."""
    x, v, d = sample
    return np.broadcast_to(x, v.shape)[where], v[where], d[where]


def unpredicted_beside(outer: Sample, near: Sample, far: Sample, low: Array, high: Array) -> Mask:
    """Whether the cubic through two places misses a sample between them that is nearer to ``far``.

    As of ``unpredicted``, of which this is the case of a cell from ``near`` to ``far`` that is no
    wider than the one before it.
    """
    rounding = ROUNDING * np.maximum(np.abs(low), np.abs(high))
    missed: Mask = np.abs(near[1] - cubic(outer, far, near[0])) > SHARE * (high - low) + rounding
    return missed | goes_back(near, far, rounding)
