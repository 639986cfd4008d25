"""The quantities of a design by their names, as ``acceleration.max``: those of its report.

A group of quantities is computed only where one of them is requested.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple, TypeAlias

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.model import PartsModel
from geneva_cli.study.quantities import group_of, whole_name
from geneva_cli.table import Table
from geneva_cli.verdict.quantities.groups import MACHINE, REPORT, QuantityGroup
from geneva_cli.verdict.quantities.groups import values as values_of

Cell: TypeAlias = float | int | str | bool | None

# the groups that are shown without --pick
SHOWN = (MACHINE, *(group for group in REPORT if not group.makes_parts))


def values(model: PartsModel, groups: Iterable[QuantityGroup] = SHOWN) -> dict[str, Cell]:
    """The quantities of some groups, without tables and multi-line texts.

    What nothing bounds is None, as in the report's json.
    """
    out: dict[str, Cell] = {}
    for name, value in values_of(groups, model).items():
        if not isinstance(value, (tuple, Table)):
            endless = isinstance(value, float) and math.isinf(value)
            out[name] = None if endless else value
    return out


class Pick(NamedTuple):
    """Quantities to show, and the groups that contain them."""

    names: tuple[str, ...]
    groups: tuple[QuantityGroup, ...]
    # the whole names in the order of the request, in which one may stand twice
    asked: tuple[str, ...] = ()

    def of(self, mechanism: Mechanism) -> list[Cell]:
        """The values of the quantities for a machine; None if one does not apply."""
        found = values(PartsModel(mechanism), self.groups)
        return [found.get(name) for name in self.names]


def pick(
    asked: Sequence[str], option: str = "--pick", options: Mapping[str, str] | None = None
) -> Pick:
    """The quantities of these names, as ``whole_name`` resolves them.

    ``options`` says which option asked for a name, where it was not ``option``. Raises GenevaError,
    naming the option, for a name that is no quantity, or may be several.
    """
    by = dict.fromkeys(asked, option) | dict(options or {})
    names = {a: whole_name(a, by[a]) for a in asked}
    of = dict.fromkeys(group_of()[name] for name in names.values())
    return Pick(tuple(dict.fromkeys(names.values())), tuple(of), tuple(names[a] for a in asked))
