"""The motion of a wheel that moves only when it is pushed, without inertia and friction.

It keeps its angle until a part overlaps it, and then goes with the nearer end of what is blocked.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask
from geneva_cli.parts.turn.free_ranges import FreeRanges, Range

STEPS = 1440  # positions of a turn of the crank: a quarter of a degree apart
MANY = 30000  # pairs of pieces above which positions are half a degree apart
PARTS = 16  # parts into which a step is divided where the wheel begins or ends to move, or runs
SLOW = 4.0  # velocity of the wheel, of the crank's, up to which a step is not divided
# Velocity above which a corner blocks. The wheel's corner then moves within 2 degrees of the common
# normal's right angle: friction stops such a push.
STEEPEST = 30.0
SHORTEST = 1e-10  # radians of the crank: a step that is not divided any more
FACETED = 1e-4  # mm: outlines of short lines have a larger slack
SAME = 1e-11  # radians of the wheel: a smaller move is rounding

Around: TypeAlias = Callable[[float], Range]  # the range about an angle of the wheel


class Push(NamedTuple):
    """A stretch in which a part pushes the wheel: crank and wheel angles, radians."""

    begin: float
    begin_wheel: float
    end: float
    end_wheel: float

    @property
    def moved(self) -> float:
        """How far it moves the wheel, radians."""
        return abs(self.end_wheel - self.begin_wheel)


class Jam(NamedTuple):
    """The angles of crank and wheel at which the wheel is stuck, and what is blocked then."""

    crank: float
    wheel: float
    low: float
    high: float


class LazyTurn(NamedTuple):
    """The wheel at crank angles (n,), radians, and its free range there."""

    crank: Array
    wheel: Array
    low: Array
    high: Array
    pushes: tuple[Push, ...]
    jam: Jam | None

    @property
    def gained(self) -> float:
        """How far the wheel has turned, radians."""
        return float(self.wheel[-1] - self.wheel[0]) if len(self.wheel) else 0.0

    @property
    def is_moving(self) -> Mask:
        """Mask (n,) of the positions at which the wheel is pushed, or just was."""
        mask = np.zeros(len(self.crank), dtype=bool)
        for push in self.pushes:
            low, high = sorted((push.begin, push.end))
            mask |= (self.crank >= low) & (self.crank <= high)
        return mask


class _Stuck(Exception):
    """The wheel cannot follow, because of the jam in it; not an error of a spec."""


class Turner:
    """Turns a wheel by its crank, whose free ranges are computed once, at ``steps`` positions."""

    def __init__(self, free: FreeRanges, start: float, steps: int = STEPS) -> None:
        self.free, self.start = free, start
        many = len(free.crank) * len(free.stops.outline) > MANY
        self.steps = min(steps, STEPS // 2) if many else steps
        self.ranges = free.at(start + math.tau * np.arange(self.steps) / self.steps)

    def rest(self, wheel: float) -> Range:
        """Return the range about an angle of the wheel where the crank's turn starts."""
        return self.ranges.around(0, wheel)

    def turn(self, wheel: float, way: int = 1, exact: bool = True) -> LazyTurn:
        """Return the motion over a turn of the crank, forwards or (``way`` = -1) backwards.

        Without ``exact`` pushes begin and end on the grid.
        """
        path, jam = _Path(self.free, way, exact), None
        try:
            path.begin(self.start, self.rest(wheel), wheel)
            for k in range(1, self.steps + 1):
                crank = self.start + way * math.tau * k / self.steps
                path.to(crank, partial(self.ranges.around, way * k % self.steps))
        except _Stuck as stuck:
            (jam,) = stuck.args
        if path.begun is not None:
            path.pushes.append(Push(*path.begun, *path.rows[-1][:2]))
        crank_at, wheel_at, low, high = np.array(path.rows).reshape(-1, 4).T
        return LazyTurn(crank_at, wheel_at, low, high, tuple(path.pushes), jam)


class _Path:
    """The path of a wheel, as it comes about: crank, wheel, and the free range there."""

    def __init__(self, free: FreeRanges, way: int, exact: bool) -> None:
        self.free, self.way, self.exact = free, way, exact
        self.rows: list[tuple[float, float, float, float]] = []
        self.pushes: list[Push] = []
        self.begun: tuple[float, float] | None = None  # of the push that goes on

    def begin(self, crank: float, rest: Range, wheel: float) -> None:
        """Start from a position, pushed out of an overlap of rounding."""
        if not rest.is_free:
            near = _pushed(rest, wheel)
            if abs(near - wheel) > 1e-3:  # radians: more is no rounding
                raise _Stuck(Jam(crank, wheel, rest.low, rest.high))
            wheel, rest = near, Range(True, near, near)
        self.rows.append((crank, wheel, rest.low, rest.high))

    def to(self, crank: float, around: Around) -> None:
        """Go on to the next position of the crank."""
        good, wheel = self.rows[-1][:2]
        there = around(wheel)
        if there.is_free:
            if self.begun is None:
                self.rows.append((crank, wheel, there.low, there.high))
            else:
                self._release(crank, around)
            return
        if self.begun is None:
            if self.exact:
                # the crank angle from which on the wheel is not free, just before it
                first, bad = good, crank
                # 1e-13 radians with a slack of 1e-6 mm: events of facets are not known so closely
                while abs(bad - good) > 1e-7 * self.free.slack:
                    places = np.linspace(good, bad, PARTS + 1)
                    ranges, i = self.free.at(places[1:-1]), 0
                    while i < PARTS - 1 and ranges.around(i, wheel).is_free:
                        i += 1
                    if places[i] == good and places[i + 1] == bad:
                        break
                    good, bad = float(places[i]), float(places[i + 1])
                if good != first:
                    there = self.free.at(np.array([good])).around(0, wheel)
                    self.rows.append((good, wheel, there.low, there.high))
            self.begun = good, wheel
        self._follow(crank, around)

    def _follow(self, crank: float, around: Around) -> None:
        """Go on to a crank angle to which the wheel is pushed."""
        before, wheel = self.rows[-1][:2]
        step, there = abs(crank - before), around(wheel)
        pushed = _pushed(there, wheel)
        steepest = STEEPEST if step < 1e-4 else SLOW
        if abs(pushed - wheel) <= steepest * step + SAME:
            self._add(crank, pushed, around)
            return
        if step < SHORTEST:
            raise _Stuck(Jam(before, wheel, there.low, there.high))
        places = np.linspace(before, crank, PARTS + 1)[1:]
        ranges = self.free.at(places)
        for i in range(PARTS):
            self._follow(float(places[i]), partial(ranges.around, i))

    def _add(self, crank: float, wheel: float, around: Around) -> None:
        """Add a position that touches, with the free range on the other side."""
        low, high = wheel, wheel
        for at in (wheel, wheel - SAME, wheel + SAME):
            there = around(at)
            if there.is_free:
                low, high = there.low, there.high
                break
        self.rows.append((crank, wheel, low, high))

    def _release(self, crank: float, around: Around) -> None:
        """End a push: where the wheel is moved farthest, before or after the last position."""
        assert self.begun is not None
        before, wheel = self.rows[-1][:2]
        end, farthest, there = before, wheel, around
        if self.exact:
            low, high = self.rows[max(len(self.rows) - 2, 0)][0], crank
            for _ in range(7 if self.free.slack < FACETED else 4):
                places = np.linspace(low, high, PARTS + 1)
                ranges = self.free.at(places)
                moved = [_pushed(ranges.around(i, wheel), wheel) for i in range(PARTS + 1)]
                k = max(range(PARTS + 1), key=lambda i: abs(moved[i] - wheel))
                if abs(moved[k] - wheel) > abs(farthest - wheel) + SAME:
                    end, farthest, there = float(places[k]), moved[k], partial(ranges.around, k)
                k = int(np.argmin(np.abs(places - end)))
                low, high = float(places[max(k - 1, 0)]), float(places[min(k + 1, PARTS)])
        if end != before:
            if (end - before) * self.way < 0.0:
                del self.rows[-1]
            self._add(end, farthest, there)
        self.pushes.append(Push(*self.begun, end, farthest))
        self.begun = None
        self._add(crank, farthest, around)


def _pushed(there: Range, wheel: float) -> float:
    """The angle to which the wheel is pushed out of a range."""
    if there.is_free:
        return wheel
    return min((there.low, there.high), key=lambda end: abs(end - wheel))
