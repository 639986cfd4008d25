"""Quantities of a batch of designs as arrays, by their whole names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.verdict.quantities.designs import Designs
from geneva_cli.verdict.quantities.names import group_of, in_batch

if TYPE_CHECKING:
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.arrays import Array, Number


def columns(machine: Mechanism, names: Sequence[str], count: int) -> list[Array] | None:
    """Quantities of ``count`` designs in one batch machine, (count,) each.

    A value is infinite where it is undefined, and NaN where the design must be computed alone.
    Returns None if one of the quantities cannot be computed for a batch.
    """
    values = known_columns(machine, names)
    if not values.keys() >= set(names):
        return None
    return [np.broadcast_to(np.reshape(values[name], -1), (count,)) for name in names]


def known_columns(machine: Mechanism, names: Sequence[str]) -> dict[str, Number]:
    """The quantities among ``names`` that a batch computes: (m,), or one number."""
    designs, out = Designs(machine, names), {}
    for name in filter(_is_batched, names):
        group = group_of()[name]
        own_columns, own = group.columns(designs), name.removeprefix(f"{group.table}.")
        if own in own_columns:
            value = own_columns[own]
            out[name] = np.inf if value is None else value
    return out


def _is_batched(name: str) -> bool:
    return in_batch([name])
