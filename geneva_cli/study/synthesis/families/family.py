"""A family: machines of one kind that differ in one free number, or a single machine."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine import registry
from geneva_cli.machine.compatible import refuse_conflicts
from geneva_cli.machine.drives.drive import Drive
from geneva_cli.machine.motion import Motion
from geneva_cli.machine.spec import Spec
from geneva_cli.machine.wheels.classic import rollers_max
from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.study.synthesis.spans import Interval
from geneva_cli.study.synthesis.wish import Wish

EXACT = 1e-6  # share of the motion angle by which the plain crank may miss the wish
SHORTEST = 0.01  # share of a turn over m that an open end of a wish leaves to motion and to dwell
PIECES = 8  # of a family, each with a best machine of its own
BARE = Spec(registry.gearing("external")(3))  # the tables of a machine that has no frame


class Family(NamedTuple):
    """Machines that differ in one number x from ``low`` to ``high``: ``make(x)`` is one's spec. Or
    ``several`` machines, x being their numbers from 0 on.

    At ``plain`` it moves as the plain crank does; at ``known`` it is a machine of another family
    that grants the wish; at ``best`` it is the best, where that is plain. All may be none. Of more
    than one machine ``make`` can be handed to another process.
    """

    make: Callable[[float], Spec | None]
    low: float = 0.0
    high: float = 0.0
    known: float = math.nan
    plain: float = math.nan
    best: float = math.nan
    several: int = 0
    ends: tuple[float, float] | None = None  # of the whole family, of which it is a piece

    @property
    def is_free(self) -> bool:
        """Whether it has more than one machine."""
        return self.low < self.high

    def at(self, x: float) -> Spec | None:
        """The machine at a place, if there is one."""
        try:
            return self.make(x)
        except GenevaError:
            return None

    def places(self, parts: int) -> list[float]:
        """Places in order, evenly so many parts apart, the plain crank's too; all of a number."""
        if self.several:
            return [float(i) for i in range(self.several)]
        places = [self.low + (self.high - self.low) * k / parts for k in range(parts)]
        plain = [self.plain] if self.low < self.plain < self.high else []
        return sorted({*places, self.high, *plain})

    @property
    def whole(self) -> Family:
        """The family that it is a piece of, or itself."""
        low, high = self.ends or (self.low, self.high)
        return self._replace(low=low, high=high, ends=None)


def pieces(families: Sequence[Family], most: int) -> list[Family]:
    """The families, each with a free number cut into so many of even spans that there are about
    ``most``, and no more than ``PIECES`` each.
    """
    free = sum(f.is_free for f in families)
    count = max(1, min(PIECES, most // max(free, 1)))
    return [part for f in families for part in (_cut(f, count) if f.is_free else [f])]


def _cut(family: Family, count: int) -> list[Family]:
    ends = [family.low + (family.high - family.low) * k / count for k in range(count)]
    return [
        family._replace(low=low, high=high, ends=(family.low, family.high))
        for low, high in pairwise([*ends, family.high])
        if low < high
    ]


def only(spec: Spec) -> Family:
    """A family of one machine."""
    return Family(lambda x: spec)


def machine(
    wish: Wish,
    wheel: Gearing,
    drive: Callable[[float], Drive],
    m: float,
    motion_deg: float,
    motion: Motion | None = None,
) -> Spec:
    """A machine with the sizes, loads and limits of the wish's frame.

    ``drive`` makes its drive for an input speed, which is the one that m motions of so many degrees
    leave of the wish.
    """
    own = wish.frame or BARE
    found = drive(wish.n_rpm(m, motion_deg))
    return own.replace(wheel=wheel, drive=found, motion=motion, title="", path="", files=())


def can_be(spec: Spec) -> bool:
    """Whether a drive goes with its wheel."""
    try:
        refuse_conflicts(spec)
    except GenevaError:
        return False
    return True


def natural_deg(wheel: Gearing) -> float:
    """The plain crank's motion angle."""
    return 2.0 * wheel.half_motion_deg(wheel.step)


def wanted(wish: Wish, m: float, natural: float) -> Interval:
    """The motion angles for m motions in a turn; without a wish any, or the plain crank's own."""
    found = wish.motion_for(m)
    if found is None:
        return Interval(0.0, 360.0 / m) if wish.any_motion else Interval(natural, natural)
    return found


def holds(motion: Interval, natural: float) -> bool:
    """Whether a motion angle is wished for, but for what the plain crank may miss it by."""
    slack = EXACT * natural
    return motion.low - slack <= natural <= motion.high + slack


def closed_span(motion: Interval, m: int) -> Interval | None:
    """A wished span of which an open end is taken near its limit; None where nothing is in it."""
    whole = 360.0 / m
    low = motion.low if motion.low > 0.0 else SHORTEST * whole
    high = motion.high if motion.high < whole else (1.0 - SHORTEST) * whole
    if motion.low >= whole or motion.high <= 0.0 or motion.empty:
        return None
    return Interval(min(low, high), high) if not motion.exact else motion


def rollers(wish: Wish, natural: float) -> range:
    """The numbers of rollers to look at: as many as the straight slots take, or those asked for."""
    if wish.rollers is not None:
        return range(wish.rollers, wish.rollers + 1)
    return range(1, rollers_max(natural) + 1)
