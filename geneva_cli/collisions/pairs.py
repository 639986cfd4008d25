"""Pairs of parts, whose gaps are bounded on intervals of the input angle."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Whole


class Window(NamedTuple):
    """A motion, or the dwell after it: the input angles at its ends, and the motion's number."""

    start: float
    end: float
    motion: int
    rests: bool


class Intervals(NamedTuple):
    """Intervals of the input angle, and how far crank and wheel are at most from their middles.

    The angles are greatest at the ends, because neither crank nor wheel turns back.
    """

    start: Array  # degrees of the input, (n,)
    end: Array
    crank: Array  # radians
    wheel: Array

    @property
    def middle(self) -> Array:
        """Input angles in the middle, degrees."""
        return 0.5 * (self.start + self.end)

    def at(self, which: Whole) -> Intervals:
        """Return some of the intervals."""
        return Intervals(*(each[which] for each in self))


class Bounds(NamedTuple):
    """The gap in the middle of each interval, mm, and a proved lower bound of it throughout."""

    middle: Array
    least: Array


class Pair(Protocol):
    """Two parts, whose gap is bounded on intervals."""

    def __call__(self, on: Intervals) -> Bounds:
        """Return the bounds of the gap on intervals."""


class Pairs(Protocol):
    """The pairs of parts that may meet."""

    def lock(self, window: Window) -> Pair:
        """Return the crank's locking surfaces and the wheel, in a motion or dwell."""

    def free(self, roller: int, window: Window) -> Pair:
        """Return a roller and the wheel, outside the slot that the roller drives."""

    def driving(self, roller: int, span: tuple[float, float]) -> Pair:
        """Return a roller and the wheel, while it is in its slot between two input angles."""


def raised(least: Array, doubtful: Mask, closer: Callable[[Whole], Array]) -> Array:
    """Return bounds (n,), where ``doubtful`` the better of them and of those of ``closer``.

    ``closer`` gets the indices of the doubtful intervals.
    """
    which, out = np.flatnonzero(doubtful), least.copy()
    if len(which):
        out[which] = np.maximum(least[which], closer(which))
    return out
