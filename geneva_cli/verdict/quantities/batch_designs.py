"""The designs whose quantities are computed: the m designs of a batch, or a single one."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Self, TypeAlias, TypeVar

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.kept import Known, cached_property
from geneva_cli.motion.batch import taken
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.numerics.arrays import Array, Number
from geneva_cli.spec.tables import LIMITED
from geneva_cli.table import Table

T = TypeVar("T")
# Values by the names of quantities, (m,) each, or one number for all designs. A design has none
# where its number is NaN or infinite; no design has those that are None, or left out.
Columns: TypeAlias = Mapping[str, "Number | None"]
Numbers: TypeAlias = dict[str, float | None]
# Values of a single design; None is one that does not apply. All machines have the same names.
Values: TypeAlias = "dict[str, float | str | tuple[str | float, ...] | Table | None]"


class Designs:
    """The m designs of a machine, and shared values of their quantities, (m,), computed once.

    ``each`` are the machines of a batch's single designs, if they are built already. ``names`` are
    those of all requested quantities: by default those that the spec limits, which its checks
    compare. ``batch`` are the designs, and the number in them, of a single one that takes its
    values from a batch.
    """

    def __init__(
        self,
        machine: Mechanism,
        names: Collection[str] | None = None,
        each: Sequence[Mechanism] = (),
        batch: tuple[Designs, int] | None = None,
    ) -> None:
        self.machine, self._each, self._batch = machine, each, batch
        self.spec = machine.spec
        if names is None:
            limits, names = vars(machine.spec.limits), list[str]()
            for key, name in LIMITED.items():
                names += [name] if limits[key] is not None else []
        self.names = names
        self.single = isinstance(machine.design, int)  # its numbers are floats: m = 1
        self.are_built = self.single or bool(each)  # the machines of the single designs are
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

    def requesting(self, names: Collection[str]) -> Self:
        """These designs, with their known values, when other names are requested."""
        other = copy.copy(self)
        other.names = names
        return other

    def columns(self, compute: Callable[[Designs], Columns]) -> Columns:
        """The values of the requested quantities that a function computes."""
        key = compute, tuple(self.names)
        if key not in self._kept:
            self._kept[key] = self._of_batch(compute) if self._batch else compute(self)
        result: Columns = self._kept[key]  # type: ignore[assignment]
        return result

    def _of_batch(self, compute: Callable[[Designs], Columns]) -> Columns:
        """The values of a design of a batch."""
        assert self._batch
        batch, number = self._batch
        try:
            every = batch.requesting(self.names).columns(compute)
        except GenevaError:  # of another design, or of this one, which then raises it again
            return compute(self)
        own = Numbers()
        for name, column in every.items():
            values = np.ravel(np.nan if column is None else column)  # one number for all, or (m,)
            own[name] = values[number if len(values) > 1 else 0].item()
        return own

    @cached_property
    def each(self) -> Sequence[Mechanism]:
        """The machines of the single designs."""
        if self.single:
            return [self.machine]
        return self._each or [build(taken(self.spec, i)) for i in range(self.machine.designs)]

    @cached_property
    def loaded(self) -> Array:
        """1 if something resists the wheel, else NaN."""
        from geneva_cli.loads.load_case import load_case  # quantities without loads need none

        case = load_case(self.machine)
        return np.where(np.ravel(case.inertia_Nm + case.resists_Nm > 0.0), 1.0, np.nan)


def only(column: Number | None) -> float | None:
    """The value of the one design of a batch; None if there is none."""
    value = column if column is None or isinstance(column, int | float) else column.item()
    return value if value is not None and math.isfinite(value) else None


# a machine as a batch of one, cached for its checks, advice and report
single: Known[Mechanism, Designs] = Known(Designs)
