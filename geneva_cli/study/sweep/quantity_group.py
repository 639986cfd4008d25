"""What groups of quantities are asked of: the designs of a machine."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.analysis.loads.forces import setting
from geneva_cli.analysis.loads.many import greatest_of_many
from geneva_cli.analysis.tolerance.many import MotionPlays, motion_plays
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.lock_sizes import LockSizes, lock_sizes_of_many

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.numerics.jet import Array

Columns: TypeAlias = "Mapping[str, Number | None]"  # (m,) each, or one number for all


class Designs:
    """The m designs of a machine, and what several groups go by: each, (m,), is worked out once."""

    def __init__(self, machine: Mechanism) -> None:
        self.machine = machine

    @cached_property
    def loaded(self) -> Array:
        """1 where something resists the wheel, NaN where a design is asked why nothing does."""
        given = setting(self.machine)
        return np.ravel(np.where(given.inertia_Nm + given.resists_Nm > 0.0, 1.0, np.nan))

    @cached_property
    def force_N(self) -> Array:
        """The greatest force of a roller."""
        return greatest_of_many(self.machine, ["pin_force_N"])["pin_force_N"].max * self.loaded

    @cached_property
    def plays(self) -> MotionPlays | None:
        """What tolerances do to the motion at the worst."""
        return motion_plays(self.machine)

    @cached_property
    def lock_sizes(self) -> LockSizes | None:
        """The sizes that horn and lock go by, (m, 1)."""
        return lock_sizes_of_many(self.machine)


class QuantityGroup(NamedTuple):
    """Quantities of one table that are had together, and what gives those that are asked for."""

    names: tuple[str, ...]
    of: Callable[[Designs, Collection[str]], Columns]
