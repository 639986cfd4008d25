"""The designs whose quantities are computed: the m designs of a batch, or a single one."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, TypeAlias, TypeVar

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.analysis.forces import LoadCase
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.numerics.jet import Array

T = TypeVar("T")
# Values by the names of quantities, (m,) each, or one number for all designs.
Columns: TypeAlias = "Mapping[str, Number | None]"


class Designs:
    """The m designs of a machine, and shared values of their quantities, (m,), computed once.

    A value is infinite if a design has none, and NaN if it must be computed for the design alone.
    """

    def __init__(self, machine: Mechanism, names: Collection[str] = ()) -> None:
        self.machine = machine
        self.spec = machine.spec
        self.names = names  # the names of all requested quantities
        self.single = isinstance(machine.design, int)  # its numbers are floats: m = 1
        self._kept: dict[object, object] = {}

    def requested(self, table: str) -> set[str]:
        """The names of requested quantities of a table, without its name."""
        start = f"{table}."
        return {name.removeprefix(start) for name in self.names if name.startswith(start)}

    def once(self, compute: Callable[[Designs], T]) -> T:
        """The result of a function of these designs, computed once."""
        if compute not in self._kept:
            self._kept[compute] = compute(self)
        result: T = self._kept[compute]  # type: ignore[assignment]
        return result

    @cached_property
    def load_case(self) -> LoadCase:
        """The loads' parameters besides the motion."""
        from geneva_cli.analysis.forces import load_case  # quantities without loads need none

        return load_case(self.machine)

    @cached_property
    def loaded(self) -> Array:
        """1 if something resists the wheel, else NaN."""
        loaded = self.load_case.inertia_Nm + self.load_case.resists_Nm > 0.0
        return np.ravel(np.where(loaded, 1.0, np.nan))


@lru_cache(maxsize=16)
def single(mechanism: Mechanism) -> Designs:
    """A machine as a batch of one, cached for its checks, advice and report."""
    return Designs(mechanism)
