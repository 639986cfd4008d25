"""Means over a period, all at once: of quantities and their squares, and of what a motor feels."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.quantities import QUANTITIES, SQUARED, ends_of, known_quantities

if TYPE_CHECKING:
    from collections.abc import Mapping

    from geneva_cli.analysis.loads.cycle import Cycle, Extremes, Integrand
    from geneva_cli.analysis.loads.instant import Instant
    from geneva_cli.numerics.jet import Array

TORQUE = "input_torque_Nm"
DRIVEN = "driven_Nm"  # the input's torque while the wheel drives it, else 0
NOUGHT = 1e-30  # a mean whose square is so small a share of the mean square is rounding


class Means(NamedTuple):
    """The means of a quantity and of its square over a period, dwells included."""

    mean: float
    square: float


@lru_cache(maxsize=16)
def means_of(cycle: Cycle) -> Mapping[str, Means]:
    """The means of each known quantity that has a bound, and of ``DRIVEN``, by name.

    What has no bound has no mean either: nearly always, and never one to rely on.
    """
    names = known_quantities(cycle)
    found = ends_of(cycle, *names)
    names = [name for name, ends in zip(names, found, strict=True) if _is_bounded(ends)]

    def mean(name: str) -> Integrand:
        return lambda i: plain_of(i, name)

    def square(name: str) -> Integrand:
        return lambda i: square_of(QUANTITIES[name](i).value, name)

    def driven(power: int) -> Integrand:
        return lambda i: (0.5 * (1.0 - i.feeds) * i.input_torque_Nm) ** power

    back = [driven(1), driven(2)] if TORQUE in names else []
    sums = cycle.integrals(*map(mean, names), *map(square, names), *back)
    every = [total / cycle.period for total in sums]
    out = {
        name: Means(0.0 if one * one <= NOUGHT * two else one, two)
        for name, one, two in zip(names, every, every[len(names) :], strict=False)
    }
    return out | {DRIVEN: Means(*every[-2:])} if back else out


def plain_of(i: Instant[Array], name: str) -> Array:
    """A quantity at an instant of values, itself where its square is looked for."""
    value = QUANTITIES[name](i).value
    return np.sqrt(np.abs(value)) if name in SQUARED else value


def square_of(values: Array, name: str) -> Array:
    """The square of a quantity's values, or what is one already."""
    return values if name in SQUARED else values * values


def _is_bounded(ends: Extremes) -> bool:
    return math.isfinite(ends.max) and math.isfinite(ends.min)
