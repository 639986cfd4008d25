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
SAME = 1e-11  # radians of the wheel: a smaller move is rounding
END = 1e-8  # radians of the crank: the end of a push, where the wheel hardly moves, is not closer
PAUSE = 1e-5  # radians of the crank: a push that pauses for less goes on
NEXT = 1e-6  # radians of the crank: positions that are kept are this far apart

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
    """The angles of crank and wheel, radians, at which the wheel is stuck."""

    crank: float
    wheel: float


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
        # 1e-13 radians with a slack of 1e-6 mm: events of facets are not known so closely
        finest = max(1e-7 * self.free.slack, 1e-14) if exact else math.inf
        path, jam = _Path(self.free, finest), None
        try:
            path.begin(self.start, self.rest(wheel), wheel)
            for k in range(1, self.steps + 1):
                crank = self.start + way * math.tau * k / self.steps
                path.to(crank, partial(self.ranges.around, way * k % self.steps))
        except _Stuck as stuck:
            (jam,) = stuck.args
        rows = np.array(path.rows).reshape(-1, 4)
        kept = np.diff(np.round(rows[:, 0] / NEXT), prepend=math.inf) != 0.0
        kept[-1:] = True
        crank_at, wheel_at, low, high = rows[kept].T
        return LazyTurn(crank_at, wheel_at, low, high, tuple(path.pushes), jam)


class _Path:
    """The path of a wheel, as it comes about: crank, wheel, and the free range there.

    ``finest`` is the shortest step, radians of the crank, in which a push may begin or end.
    """

    def __init__(self, free: FreeRanges, finest: float) -> None:
        self.free, self.finest, self.is_pushed = free, finest, False
        self.rows: list[tuple[float, float, float, float]] = []
        self.pushes: list[Push] = []  # which end where they have moved the wheel farthest

    def begin(self, crank: float, rest: Range, wheel: float) -> None:
        """Start from a position, pushed out of an overlap of rounding."""
        near = pushed(rest, wheel)
        if abs(near - wheel) > 1e-3:  # radians: more is no rounding
            raise _Stuck(Jam(crank, wheel))
        low, high = rest[1:] if rest.is_free else (near, near)
        self.rows.append((crank, near, low, high))

    def to(self, crank: float, around: Around) -> None:
        """Go on to a crank angle. A step is divided if a push begins or ends, or the wheel runs."""
        before, wheel = self.rows[-1][:2]
        step, there = abs(crank - before), around(wheel)
        new, changes = pushed(there, wheel), there.is_free is self.is_pushed
        steepest = STEEPEST if step < 1e-4 else SLOW
        runs = abs(new - wheel) > steepest * step + SAME
        if runs and step < SHORTEST:
            raise _Stuck(Jam(before, wheel))
        # a push that has hardly paused goes on
        goes_on = bool(self.pushes) and abs(before - self.pushes[-1].end) <= PAUSE
        finest = max(self.finest, END) if self.is_pushed or goes_on else self.finest
        if runs or (changes and step > finest):
            last_step = abs(before - self.rows[-2][0]) if len(self.rows) > 1 else math.inf
            if there.is_free and last_step < 2.0 * step:
                del self.rows[-1]  # it may have been pushed farthest in the step before
            places = np.linspace(self.rows[-1][0], crank, PARTS + 1)[1:]
            ranges = self.free.at(places)
            for i in range(PARTS):
                self.to(float(places[i]), partial(ranges.around, i))
            return
        if changes and not (self.is_pushed or goes_on):
            self.pushes.append(Push(before, wheel, before, wheel))
        self.is_pushed = not there.is_free
        if self.is_pushed and abs(new - self.pushes[-1].end_wheel) > SAME:
            self.pushes[-1] = self.pushes[-1]._replace(end=crank, end_wheel=new)
        # with the free range on the other side of a touching part
        places_free = (around(at) for at in (new, new - SAME, new + SAME))
        free = next((one for one in places_free if one.is_free), Range(True, new, new))
        self.rows.append((crank, new, free.low, free.high))


def pushed(there: Range, wheel: float) -> float:
    """The angle of a wheel that a blocked range pushes to its nearer end."""
    if there.is_free:
        return wheel
    return min((there.low, there.high), key=lambda end: abs(end - wheel))
