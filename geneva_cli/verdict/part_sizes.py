"""The dimensions of stressed parts, for one machine or a batch.

Parts are sized one design after the other, as their defaults depend on rollers' whole paths.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.drawings.kinds.kind import kind_of
from geneva_cli.errors import GenevaError
from geneva_cli.layout.sizes import Layout
from geneva_cli.layout.stressed import Stressed, stressed
from geneva_cli.loads.strength.arm import ArmDimensions
from geneva_cli.loads.strength.keys import KeyDimensions
from geneva_cli.named_tuple import NamedTuple

if TYPE_CHECKING:
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.jet import Array


class PartSizes(NamedTuple):
    """The fields of ``Stressed`` for m designs, (m,) each, NaN for those without a part."""

    contact: Array
    pin: Array
    wheel_shaft: tuple[Array, Array]  # diameter and overhang
    crank_shaft: tuple[Array, Array]
    arm: ArmDimensions
    wheel_key: KeyDimensions
    crank_key: KeyDimensions


def part_sizes(parts: Sequence[Stressed | None]) -> PartSizes | None:
    """The dimensions of the parts of m designs; None if no design has parts."""
    rows = [_numbers(one) if one else [] for one in parts]
    every = [row for row in rows if row]
    if not every:
        return None
    none = [math.nan] * len(every[0])
    columns = np.array([row or none for row in rows]).T
    contact, pin, *rest = columns
    arm, key = len(ArmDimensions._fields), len(KeyDimensions._fields)
    starts = np.cumsum([0, 2, 2, arm, key, key])
    wheel, crank, flat_arm, *keys = (rest[a:b] for a, b in zip(starts, starts[1:], strict=False))
    return PartSizes(
        contact,
        pin,
        (wheel[0], wheel[1]),
        (crank[0], crank[1]),
        ArmDimensions(*flat_arm),
        *(KeyDimensions(*own) for own in keys),
    )


def stressed_parts(machine: Mechanism, layout: Layout | None) -> Stressed | None:
    """The stressed parts of a design, flat ones by their layout; None if they do not fit."""
    if layout or machine.spec.is_flat or not machine.spec.has_parts:
        return stressed(*layout) if layout else None
    try:
        return kind_of(machine).stressed(machine)
    except GenevaError:  # the check of the parts reports the error
        return None


def _numbers(of: Stressed) -> list[float]:
    shafts, keys = (*of.wheel_shaft, *of.crank_shaft), (*of.wheel_key, *of.crank_key)
    return [of.contact, of.pin, *shafts, *map(float, of.arm), *map(float, keys)]
