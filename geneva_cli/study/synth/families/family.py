"""A family: machines of one kind that differ in one free number, or a single machine."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.motion import registry
from geneva_cli.motion.compatible import refuse_conflicts
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.motion import Motion
from geneva_cli.motion.wheels.classic import rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.study.spans import AllowedSpan
from geneva_cli.study.target import Target

# fraction of a turn over m that an open end of a range leaves to motion and to dwell
OPEN_END = 0.01
BARE = Spec(registry.gearing("external")(3))  # the tables of a machine without a frame


class Family(NamedTuple):
    """Machines that differ in one number x from ``low`` to ``high``, or a list of machines.

    ``make(x)`` is the spec of one; it can be passed to another process. With ``several`` machines,
    x is their number from 0 on. At ``plain`` the machine moves as the plain crank does. At
    ``known`` it is a machine of another family that meets the requirement. At ``best`` it is the
    best, if that is known. Each may be NaN.
    """

    make: Callable[[float], Spec | None]
    low: float = 0.0
    high: float = 0.0
    known: float = math.nan
    plain: float = math.nan
    best: float = math.nan
    several: int = 0
    ends: tuple[float, float] | None = None  # of the whole family, if this is a piece of it

    @property
    def is_free(self) -> bool:
        """Return True if the family has more than one machine."""
        return self.low < self.high

    def at(self, x: float) -> Spec | None:
        """The machine at a place; None if it cannot be built."""
        try:
            return self.make(x)
        except GenevaError:
            return None

    def places(self, parts: int) -> list[float]:
        """Places in order, in equal steps and the plain crank's; or all numbers of a list."""
        if self.several:
            return [float(i) for i in range(self.several)]
        places = [self.low + (self.high - self.low) * k / parts for k in range(parts)]
        plain = [self.plain] if self.low < self.plain < self.high else []
        return sorted({*places, self.high, *plain})

    @property
    def whole(self) -> Family:
        """The family that this is a piece of, or itself."""
        low, high = self.ends or (self.low, self.high)
        return self._replace(low=low, high=high, ends=None)


def pieces(families: Sequence[Family], most: int) -> list[Family]:
    """The families, with free ones divided into equal pieces, about ``most`` in all.

    No family has more than 8 pieces.
    """
    free = sum(f.is_free for f in families)
    count = max(1, min(8, most // max(free, 1)))
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
    target: Target,
    wheel: Gearing,
    drive: Callable[[float], Drive],
    m: float,
    motion_deg: float,
    motion: Motion | None = None,
) -> Spec:
    """A machine with the sizes, loads and limits of the requirement's frame.

    ``drive`` makes the drive for an input speed, which follows from the requirement for m motions
    of ``motion_deg`` in a turn.
    """
    own = target.frame or BARE
    own_drive = drive(target.n_rpm(m, motion_deg))
    return own.replace(
        wheel=wheel,
        drive=own_drive,
        motion=motion,
        size=own.size.replace(center_distance_mm=center_distance_mm(target)),
        title="",
        path="",
        files=(),
    )


def center_distance_mm(target: Target) -> float | None:
    """The centre distance of the requirement or its frame; None for the default."""
    return target.center_distance_mm((target.frame or BARE).size.center_distance_mm)


def is_compatible(spec: Spec) -> bool:
    """Return True if a drive is compatible with its wheel."""
    try:
        refuse_conflicts(spec)
    except GenevaError:
        return False
    return True


def natural_deg(wheel: Gearing) -> float:
    """The motion angle of the plain crank."""
    return 2.0 * wheel.half_motion_deg(wheel.step)


def allowed_motions(target: Target, m: float, natural: float) -> AllowedSpan:
    """The allowed motion angles for m motions in a turn: required, any, or the plain one."""
    allowed = target.motion_for(m)
    if allowed is None:
        return AllowedSpan(0.0, 360.0 / m) if target.any_motion else AllowedSpan(natural, natural)
    return allowed


def allows(motion: AllowedSpan, natural: float) -> bool:
    """Return True if a motion angle is allowed, within the tolerance of the plain crank."""
    # fraction of the motion angle by which the plain crank may miss the required one
    slack = 1e-6 * natural
    return motion.low - slack <= natural <= motion.high + slack


def longest_deg(m: float) -> float:
    """The motion that leaves ``OPEN_END`` of a turn over m to the dwell."""
    return (1.0 - OPEN_END) * (360.0 / m)


def closed_span(motion: AllowedSpan, m: int) -> AllowedSpan | None:
    """The range with open ends replaced by values near their limits; None if it is empty."""
    whole = 360.0 / m
    low = motion.low if motion.low > 0.0 else OPEN_END * whole
    high = motion.high if motion.high < whole else longest_deg(m)
    if motion.low >= whole or motion.high <= 0.0 or motion.empty:
        return None
    return AllowedSpan(min(low, high), high) if not motion.exact else motion


def rollers(target: Target, natural: float) -> range:
    """The numbers of rollers to try: those that straight slots allow, or the required one."""
    if target.rollers is not None:
        return range(target.rollers, target.rollers + 1)
    return range(1, rollers_max(natural) + 1)
