"""A family: machines of one kind that differ in free numbers, or a single machine."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.motion import registry
from geneva_cli.motion.compatible import refuse_conflicts
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Array
from geneva_cli.study.target import AllowedSpan, Target

# fraction of a turn over m that an open end of a range leaves to motion and to dwell
OPEN_END = 0.01
BARE = Spec(registry.gearing("external")(3))  # the tables of a machine without a frame


Keys: TypeAlias = Callable[[Array], dict[str, Array]]


class Family(NamedTuple):
    """Machines that differ in one number, or a single one.

    ``spec`` is one of them. ``keys`` returns the values (n,) of its keys at numbers (n,) between
    ``low`` and ``high``; NaN where there is no machine. At ``plain`` a machine moves as the plain
    crank does. At ``known`` it is a machine of another family. At ``best`` it is the best, which is
    ``spec``. Those are NaN if there is none. All can be passed to another process.
    """

    spec: Spec
    keys: Keys | None = None
    low: float = math.nan
    high: float = math.nan
    plain: float = math.nan
    known: float = math.nan
    best: float = math.nan

    @property
    def is_free(self) -> bool:
        """Return True if the family has more than one machine."""
        return self.low < self.high


def pieces(families: Sequence[Family], most: int) -> list[Family]:
    """The families, with those of one free number divided into equal pieces, about ``most`` in all.

    No family has more than 8 pieces.
    """
    count = max(1, min(8, most // max(sum(f.is_free for f in families), 1)))
    out: list[Family] = []
    for f in families:
        ends = [*(f.low + (f.high - f.low) * k / count for k in range(count)), f.high]
        out += [f._replace(low=a, high=b) for a, b in pairwise(ends) if a < b] or [f]
    return out


def speeds(target: Target, m: float, motion_deg: Sequence[float]) -> dict[str, Array]:
    """The key of the input speeds for m motions of these angles in a turn; none without times."""
    if not target.timed:
        return {}
    return {"drive.n_rpm": np.array([target.n_rpm(m, x) for x in motion_deg])}


def machine(
    target: Target, wheel: Gearing, drive: Drive, motion_deg: float, motion: Motion | None = None
) -> Spec:
    """A machine with the sizes, loads and limits of the requirement's frame, at its speed."""
    own = target.frame or BARE
    size = own.size
    made = drive.replace(n_rpm=target.n_rpm(drive.rollers / drive.turns, motion_deg))
    L = size.center_distance_mm
    if L is None and not made.ONE_ARM:  # it has no crank of one radius: the frame's distance
        L = size.derived_distance_mm
    as_built = L is not None and size.crank_radius_mm is not None  # a candidate has its own R/L
    if size.center_distance_mm != L or as_built:
        size = size.replace(center_distance_mm=L, crank_radius_mm=None)
    return own.replace(
        wheel=wheel, drive=made, motion=motion, size=size, title="", path="", files=()
    )


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


def free_motions(target: Target, m: int, natural: float) -> AllowedSpan | None:
    """The allowed motion angles, with open ends near their limits; None if there are none."""
    motion, whole = allowed_motions(target, m, natural), 360.0 / m
    if motion.low >= whole or motion.high <= 0.0 or motion.empty:
        return None
    low = motion.low if motion.low > 0.0 else OPEN_END * whole
    high = motion.high if motion.high < whole else (1.0 - OPEN_END) * whole
    return motion if motion.exact else AllowedSpan(min(low, high), high)
