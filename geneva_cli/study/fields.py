"""The quantities of a design by their names, as ``acceleration.max``: those of its report.

A group of quantities is computed only where one of them is requested.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.study.rows import Cell
from geneva_cli.table import Table
from geneva_cli.verdict.quantities.groups import MACHINE, REPORT, QuantityGroup
from geneva_cli.verdict.quantities.groups import values as values_of
from geneva_cli.verdict.quantities.quantity_names import group_of, in_batch, whole_name


def values(parts: Parts, groups: Iterable[QuantityGroup] | None = None) -> dict[str, Cell]:
    """The quantities of some groups, without tables and multi-line texts.

    Without ``groups`` they are all that need no parts. An unbounded quantity is None, as in the
    report's json.
    """
    if groups is None:
        groups = (MACHINE, *(group for group in REPORT if not group.makes_parts))
    out: dict[str, Cell] = {}
    for name, value in values_of(groups, parts).items():
        if not isinstance(value, (tuple, Table)):
            is_unbounded = isinstance(value, float) and math.isinf(value)
            out[name] = None if is_unbounded else value
    return out


class Pick(NamedTuple):
    """Quantities to show, by their whole names."""

    names: tuple[str, ...] = ()

    @property
    def groups(self) -> tuple[QuantityGroup, ...]:
        """The groups that contain them, those that make parts last."""
        groups = dict.fromkeys(group_of()[name] for name in self.names)
        # another group may compute all names of a short one as well
        own = [one for one in groups if not any(set(one.names) < set(x.names) for x in groups)]
        return tuple(sorted(own, key=lambda group: group.makes_parts))

    @property
    def batched(self) -> tuple[str, ...]:
        """The names of the quantities that a batch of designs can compute."""
        return tuple(name for name in self.names if in_batch([name]))

    @property
    def rest(self) -> Pick:
        """The quantities that are computed for each design alone."""
        return Pick(tuple(name for name in self.names if not in_batch([name])))

    def of(self, mechanism: Mechanism) -> list[Cell]:
        """The values of the quantities for a machine; None if one does not apply."""
        return self.of_parts(parts_of(mechanism))

    def of_parts(
        self,
        parts: Parts,
        known: Sequence[Cell] | None = None,
        keeps: Callable[[Mapping[str, Cell]], bool] = lambda cells: True,
    ) -> list[Cell]:
        """The values of the quantities for a machine's parts; None if one does not apply.

        ``known`` are those of ``batched``, if a batch has computed them. The parts are not made if
        the other values do not keep ``keeps``: what needs parts is then None.
        """
        groups = self.groups if known is None else self.rest.groups
        cells = values(parts, [group for group in groups if not group.makes_parts])
        cells |= zip(self.batched, known or (), strict=False)
        slow = [group for group in groups if group.makes_parts]
        if slow and keeps(cells):
            cells |= values(parts, slow)
        return [cells.get(name) for name in self.names]


def pick(requested: Sequence[str]) -> Pick:
    """The quantities of these names, as ``whole_name`` resolves them; each once."""
    return Pick(tuple(dict.fromkeys(map(whole_name, requested))))
