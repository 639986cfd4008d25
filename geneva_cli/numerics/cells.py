"""Parts of many designs' spans between neighbouring samples, and the turns that may be in them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from geneva_cli.numerics.cubics import cubic
from geneva_cli.numerics.extrema_many import turn_of_cubic
from geneva_cli.numerics.roots import PREDICTED
from geneva_cli.numerics.ties import NOUGHT, bar, usual

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Which, Whole
    from geneva_cli.numerics.extrema_many import Sample
    from geneva_cli.numerics.jet import Array

FAR = 1e3  # times what a function is in a cell: more of a range is that of a pole elsewhere
FLAT = 0.1  # degrees: what is no further from a top may be its equal by the top being flat
LEVEL = 1e-9  # share of a function's range: a rise over a cell that a slope of 0 may feign


class Cells(NamedTuple):
    """Of k cells the numbers of design and span, and at both ends place, signs and functions."""

    design: Whole  # (k,)
    span: Whole
    x: Array  # (2, k)
    positive: Mask  # (2, signs, k)
    value: Array  # (2, functions, k)
    slope: Array  # by degrees

    def at(self, end: int) -> tuple[Array, Array, Array]:
        """Place, values and slopes at one end."""
        return self.x[end], self.value[end], self.slope[end]

    def parted(self, x: Array, looks: Sequence[Look]) -> tuple[Cells, Cells]:
        """In two at a place in each, with what is known on both sides of it."""
        olds = (self.x, self.positive, self.value, self.slope)
        news = [(x, *look) for look in looks]
        first = [np.stack((old[0], new)) for old, new in zip(olds, news[0], strict=True)]
        last = [np.stack((new, old[1])) for old, new in zip(olds, news[1], strict=True)]
        return Cells(self.design, self.span, *first), Cells(self.design, self.span, *last)


class Look(NamedTuple):
    """What is known at a place of each design."""

    positive: Mask  # (signs, k)
    value: Array  # (functions, k)
    slope: Array


class Turns(NamedTuple):
    """Cells in which a wanted function may be stationary at an extreme."""

    row: Whole  # the function's number
    rises: Array  # 1.0 before a maximum, -1.0 before a minimum
    design: Whole
    span: Whole
    positive: Mask  # (signs, k)
    left: Array  # place, value, slope: (3, k)
    right: Array


class Cuts(NamedTuple):
    """Where signs change: numbers of design and span, the place, and the signs on both sides."""

    design: Whole
    span: Whole
    x: Array
    positive: Mask  # (2, signs, k)


class Beside(NamedTuple):
    """The samples on both sides of cells, and whether no sign changes between the two."""

    known: Mask  # (2, k)
    x: Array
    value: Array  # (2, functions, k)
    slope: Array

    def at(self, end: int) -> tuple[Array, Array, Array]:
        """Place, values and slopes on one side."""
        return self.x[end], self.value[end], self.slope[end]


class Across(NamedTuple):
    """Three neighbouring samples about cells in which signs change, with two choices of the signs.

    The functions are smooth there with either; ``cell`` are the numbers of the cells, of which
    those in which two signs change are here twice.
    """

    cell: Whole  # (k,)
    changes: Mask  # which signs do: (signs, k)
    known: Mask  # whether the others are the same with either choice: (k,)
    first: Mask  # whether the cell is the first of the two between the samples: (2, k)
    x: Array  # (2, 3, k)
    value: Array  # (2, functions, 3, k)
    slope: Array

    def samples(self, choice: int) -> tuple[Sample, Sample, Sample]:
        """The three, with one choice of the signs."""
        left, middle, right = (
            (self.x[choice, i], self.value[choice, :, i], self.slope[choice, :, i])
            for i in range(3)
        )
        return left, middle, right


Parts = TypeVar("Parts", Cells, Turns, Cuts, Beside, Across)


def taken(parts: Parts, where: Any) -> Parts:
    """Some of the cells or turns, by a mask or their numbers."""
    index = np.flatnonzero(where) if where.dtype == bool else where
    # a third of the time of one[..., where]
    return type(parts)._make([np.take(one, index, axis=-1) for one in parts])


def joined(parts: Sequence[Parts]) -> Parts:
    """Several groups of cells or turns as one."""
    columns = zip(*parts, strict=True)
    return type(parts[0])._make([np.concatenate(one, axis=-1) for one in columns])


class Range(NamedTuple):
    """The least and the greatest finite sample of each function of each design: (functions, n).

    Of a span in which a function has no bound those of the middle of its samples.
    """

    low: Array
    high: Array

    def widen(self, design: Whole, value: Array) -> None:
        """Take in samples (functions, m, k) of some designs."""
        low, high = usual(value)
        self.low[:, design] = np.fmin(self.low[:, design], low)
        self.high[:, design] = np.fmax(self.high[:, design], high)

    def holds(self, design: Whole, value: Array) -> Mask:
        """Whether values (functions, m, ...) of some designs are within it, or no further out of it
        than it is wide: an extreme between samples is.
        """
        shape = *self.low.shape[:1], -1, *(1,) * (value.ndim - 2)
        low, high = (side[:, design].reshape(shape) for side in self)
        width = high - low
        return np.asarray((low - width <= value) & (value <= high + width))

    def width(self, row: int | Whole, design: Whole) -> Array:
        """The range of one function of some designs."""
        width: Array = self.high[row, design] - self.low[row, design]
        return width

    def size(self, design: Which) -> Array:
        """The greatest size of each function of some designs; 0 where none is known."""
        return np.maximum(np.maximum(-self.low[:, design], self.high[:, design]), 0.0)

    def level(self, row: int, design: Whole) -> Array:
        """The rise over a cell that is rounding, of one function of some designs."""
        return LEVEL * self.width(row, design)


class Tops:
    """The greatest values of so many functions of n designs as they come to light.

    Where ``sized`` their greatest sizes; else the greatest value of the first, the greatest of
    minus the first, of the second, and so on.
    """

    def __init__(self, count: int, n: int, sized: bool) -> None:
        self.sized = sized
        self.most = np.full((count if sized else 2 * count, n), -np.inf)
        self.known: list[tuple[Any, Whole, Array, Array]] = []

    def number(self, k: Any, sign: Any) -> Any:
        """Which of those looked for a function's maximum is (1.0), or its minimum (-1.0)."""
        return k if self.sized else 2 * k + (sign < 0.0)

    def sides(self, value: Array) -> list[tuple[float, Array]]:
        """A function as each of what is looked for of it."""
        return [(1.0, np.abs(value))] if self.sized else [(1.0, value), (-1.0, -value)]

    def add(self, number: Any, design: Whole, x: Array, value: Array) -> None:
        """Some values, and where: (k,) each, ``number`` one or (k,)."""
        np.maximum.at(self.most, (number, design), value)
        self.known.append((number, design, x, value))

    def add_all(self, design: Whole, x: Array, value: Array) -> None:
        """All functions (functions, k) at one place of each of some designs."""
        for k, one in enumerate(value):
            for sign, side in self.sides(one):
                self.add(self.number(k, sign), design, x, side)

    def add_samples(self, design: Whole, x: Array, value: Array) -> None:
        """The first greatest of samples (functions, m, k) at places (m, k)."""
        for sign, side in self.sides(value):
            most = side.max(axis=2)
            size = np.where(np.isfinite(side), np.abs(side), 0.0).max(axis=2)
            least, first = bar(most, size), np.broadcast_to(x[:, -1], most.shape)
            for i in range(x.shape[1] - 2, -1, -1):
                first = np.where(side[..., i] >= least, x[:, i], first)
            for k in range(len(value)):
                number = self.number(k, sign)
                self.most[number, design] = np.maximum(self.most[number, design], most[k])
                self.known.append((number, design, first[k], most[k]))

    def may_pass(self, k: Whole, design: Whole, low: Array, high: Array) -> Mask:
        """Whether functions that come to ``low`` and ``high`` at most may pass what is known.

        Nothing passes what has no bound; what has limits that are not known may.
        """
        both = [(2 * k, high), (2 * k + 1, -low)]
        sides = [(k, np.maximum(-low, high))] if self.sized else both
        passes = [
            (self.most[number, design] < np.inf) & ~(reach <= self.most[number, design])
            for number, reach in sides
        ]
        return np.asarray(np.logical_or.reduce(passes))

    def bounded(self) -> Mask:
        """Whether each function of each design is bounded, as far as is known."""
        finite: Mask = self.most < np.inf
        return finite if self.sized else finite[::2] & finite[1::2]

    def places(self, size: Array) -> Array:
        """The first places of the greatest values of functions of these sizes, (functions, n)."""
        own = size if self.sized else np.repeat(size, 2, axis=0)
        first = self._first(bar(self.most, own))
        # a sample beside a top is its equal: the top is told
        high = np.full(self.most.shape, -np.inf)
        for number, design, x, value in self.known:
            index = number, design
            np.fmax.at(high, index, np.where(np.abs(x - first[index]) <= FLAT, value, -np.inf))
        return np.where(np.abs(high) > NOUGHT * own, self._first(high, first), first)

    def _first(self, least: Array, after: Array | float = -np.inf) -> Array:
        """The first places, not before others, of values that are no less than these."""
        first, after = np.full(self.most.shape, np.nan), np.broadcast_to(after, self.most.shape)
        for number, design, x, value in self.known:
            index = number, design
            near = (value >= least[index]) & (x >= after[index])
            which = number if isinstance(number, int) else number[near]
            np.fmin.at(first, (which, design[near]), x[near])
        return first

    def hopeful(self, turns: Turns) -> Turns:
        """Those that may pass what is known; of a slope of 0 the other one tells the side."""
        _, v, d = turns.left
        _, w, e = turns.right
        rises = np.where(d == 0.0, -np.sign(e), np.sign(d))
        # a cubic rises above its ends by 4/27 of this at most; and a cubic may miss
        rise = (turns.right[0] - turns.left[0]) * np.abs(d - e) * (4.0 / 27.0)
        reach = np.maximum(rises * v, rises * w) + rise * (1.0 + 4.0 * PREDICTED)
        # before a pole no cubic tells how far
        reach = np.where(np.isfinite(v) & np.isfinite(w), reach, np.inf)
        most = self.most[self.number(turns.row, rises), turns.design]
        hopes = (d * e <= 0.0) & (reach >= most) & (most < np.inf)
        return taken(turns._replace(rises=rises), hopes)

    def first(self, turns: Turns) -> Mask:
        """Whether each is the one of its design and function whose cubic rises highest."""
        left, right = turns.left, turns.right
        top = turns.rises * cubic(left, right, turn_of_cubic(left, right))
        number = self.number(turns.row, turns.rises), turns.design
        most = np.full(self.most.shape, -np.inf)
        np.fmax.at(most, number, top)
        highest: Mask = ~(top < most[number])
        return highest


def may_turn(before: Array, after: Array, level: Array) -> Mask:
    """Whether a function may be stationary between two slopes: they differ in sign, or one is 0.

    A motion starts, ends and passes its middle with slopes that are 0 but for rounding: there only
    the bend tells what is beside them.
    """
    one, two = np.abs(before), np.abs(after)
    flat = (np.minimum(one, two) <= level) & (np.maximum(one, two) > level)
    turns: Mask = (before * after < 0.0) | flat
    return turns


def turns_in(row: int, k: int, cells: Cells, range_: Range, where: Mask) -> Turns:
    """The cells, of those ``where``, in which the function ``row`` may turn, the k-th wanted."""
    (a, b), (v, w), (d, e) = cells.x, cells.value[:, row], cells.slope[:, row]
    level = range_.level(row, cells.design) / (b - a)
    here = np.flatnonzero(may_turn(d, e, level) & where)
    left, right = (np.stack([one[here] for one in end]) for end in ((a, v, d), (b, w, e)))
    of = cells.design[here], cells.span[here]
    return turns_of(k, of, level[here], cells.positive[0][:, here], left, right)


def turns_of(
    k: int, of: tuple[Whole, Whole], level: Array, positive: Mask, left: Array, right: Array
) -> Turns:
    """Turns of the k-th wanted function ``of`` designs and spans.

    A slope that beside the other one is rounding is 0.
    """
    # beside a pole the range says nothing of cells that are far from it
    values, slopes = (np.abs(left[i]) + np.abs(right[i]) for i in (1, 2))
    own = values / (right[0] - left[0]) + slopes
    small = np.abs(np.stack((left[2], right[2]))) <= np.minimum(level, FAR * LEVEL * own)
    for end, flat, steep in ((left, small[0], ~small[1]), (right, small[1], ~small[0])):
        end[2, flat & steep] = 0.0
    return Turns(np.full(len(of[0]), k), left[0], *of, positive, left, right)
