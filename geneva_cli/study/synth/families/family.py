"""A family: machines of one kind that differ in free numbers, or a single machine."""

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.motion.compatible import refuse_conflicts
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Array

Keys: TypeAlias = Callable[[Array], dict[str, Array]]


class Family(NamedTuple):
    """Machines that differ in one number, or a single one.

    ``spec`` is one of them. ``keys`` returns the values (n,) of its keys at numbers (n,) between
    ``low`` and ``high``; NaN where there is no machine. At ``plain`` a machine moves as the plain
    crank does. At ``known`` it is a machine of another family. Those are NaN if there is none.
    """

    spec: Spec
    keys: Keys | None = None
    low: float = math.nan
    high: float = math.nan
    plain: float = math.nan
    known: float = math.nan

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
