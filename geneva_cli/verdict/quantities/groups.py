"""The registry of quantities, and the designs whose quantities are computed.

A new quantity is a name in one row of ``quantity_rows``, and a value of the row's function.
"""

from __future__ import annotations

import copy
import math
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from itertools import product
from operator import attrgetter
from typing import NamedTuple, Self, TypeAlias, TypeVar

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.kept import Known, cached_property, load_named
from geneva_cli.motion.batch import taken
from geneva_cli.motion.compatible import concerns
from geneva_cli.motion.kind import Kind
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.registry import KINDS
from geneva_cli.numerics.arrays import Array, Number
from geneva_cli.parts.parts import Parts
from geneva_cli.spec.tables import LIMITED
from geneva_cli.table import Table
from geneva_cli.verdict.quantities.quantity_rows import REPORT_ROWS, STUDY_ROWS

T = TypeVar("T")
# Values by the names of quantities, (m,) each, or one number for all designs. A design has none
# where its number is NaN or infinite; no design has those that are None, or left out.
Columns: TypeAlias = Mapping[str, "Number | None"]
Numbers: TypeAlias = dict[str, float | None]
# Values of a single design; None is one that does not apply. All machines have the same names.
Values: TypeAlias = "dict[str, float | str | tuple[str | float, ...] | Table | None]"
# Tables whose quantities need the machine's parts, or their turn, which may take seconds.
MAKE_PARTS = ("parts", "parts_list", "tolerance", "checks")


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
        self.machine, self._batch = machine, batch
        self.spec = machine.spec
        if names is None:
            limits, names = vars(machine.spec.limits), list[str]()
            for key, name in LIMITED.items():
                if limits[key] is not None:
                    names += [name, name.replace(".max", ".at_deg")]
        self.names = names
        self.single = isinstance(machine.design, int)  # its numbers are floats: m = 1
        self.are_built = self.single or bool(each)  # the machines of the single designs are
        if self.are_built:
            vars(self)["each"] = each or [machine]
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
        return [build(taken(self.spec, i)) for i in range(self.machine.designs)]

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


class QuantityGroup(NamedTuple):
    """Quantities that are computed together, by their whole names.

    ``alone`` computes them for the machine of a Parts and ``batch`` for Designs, each as
    module:function, imported at its first use. Both return values by their ``own`` names, without
    the table, and no design has those that they leave out. Without ``alone`` a single design is a
    batch of one. Groups may have one function for batches. ``alone`` may also return lists and
    tables.
    """

    table: str  # beginning of the whole names, with its dot
    names: tuple[str, ...]
    own: tuple[str, ...]
    alone: str
    batch: str
    batched: tuple[str, ...]  # the names that ``batch`` computes
    kind: Kind | None  # that to whose machines they belong; None for all
    makes_parts: bool

    def values(self, parts: Parts) -> Values:
        """The values of a single design; None for those that it lacks."""
        if not self.alone:
            columns = self.columns(single(parts.mechanism).requesting(self.names))
            return {name: only(column) for name, column in columns.items()}
        is_of = self.kind is None or concerns(self.kind, parts.mechanism.spec)
        own: Values = load_named(self.alone)(parts) if is_of else {}
        computed: Values = {f"{self.table}{name}": value for name, value in own.items()}
        return {**dict.fromkeys(self.names), **computed}

    def columns(self, of: Designs) -> Columns:
        """The values of a batch; None where no design has one."""
        is_of = self.kind is None or concerns(self.kind, of.spec)
        own = of.columns(load_named(self.batch)) if is_of else {}
        return dict(zip(self.names, map(own.get, self.own), strict=True))


def _group(row: str, kind: Kind | None = None) -> QuantityGroup:
    """The group of a row, whose paths are whole if it is a kind's."""
    table, alone, batch, *names = row.split(maxsplit=3)
    start, words = "" if table == "-" else f"{table}.", list[str]()
    for prefixes, ends, word in re.findall(r"(\S+)\.{([^}]*)}|(\S+)", "".join(names)):
        words += [word] if word else map(".".join, product(prefixes.split(","), ends.split()))
    own = " ".join(words).replace("!", "").split()
    batched = [*filter(own.__contains__, words)] if batch != "-" else []  # those without a mark
    rooms = ("", "") if kind else ("verdict.", "verdict.quantities.")
    return QuantityGroup(
        start,
        tuple(map(start.__add__, own)),
        tuple(own),
        "" if alone == "-" else rooms[0] + alone,
        "" if batch == "-" else rooms[1] + batch,
        tuple(map(start.__add__, batched)),
        kind,
        table in MAKE_PARTS or bool(kind and batch == "-"),
    )


_JOINED = ("\n  ", " ")  # a row may have several lines
REPORT = [*map(_group, REPORT_ROWS.replace(*_JOINED).strip().splitlines())]
MACHINE, *STUDY = map(_group, STUDY_ROWS.replace(*_JOINED).strip().splitlines())
for _kind in reversed(KINDS):
    for _table, _row in _kind.quantities.items():  # behind the table that it names
        _tables = [*map(attrgetter("table"), REPORT)]
        REPORT.insert(len(_tables) - _tables[::-1].index(f"{_table}."), _group(_row, _kind))
# All quantities; those that make parts come last.
GROUPS = sorted((MACHINE, *REPORT, *STUDY), key=attrgetter("makes_parts"))
GROUP_OF = dict[str, QuantityGroup]()  # the group of each quantity, by its whole name
for _one in GROUPS:
    GROUP_OF |= dict.fromkeys(_one.names, _one)


def value_of(mechanism: Mechanism, name: str) -> float:
    """A quantity of a single design by its whole name: NaN if it has none, infinite if unbounded.

    >>> value_of(Design(External(6)).mechanism, "timing.motion_deg")
    120.0
    """
    of, group = single(mechanism), GROUP_OF[name]
    of = of if name in of.names else of.requesting(group.names)
    value = group.columns(of)[name]
    return math.nan if value is None else np.ravel(value).item()
