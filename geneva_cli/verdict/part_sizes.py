"""The dimensions of stressed parts, for one machine or a batch.

Parts are sized one design after the other, as their defaults depend on rollers' whole paths.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.layout.sizes import sized
from geneva_cli.layout.stressed import Stressed, stressed
from geneva_cli.loads.strength.arm import ArmDimensions
from geneva_cli.loads.strength.keys import KeyDimensions
from geneva_cli.loads.strength.part_loads import PartLoads
from geneva_cli.machine.many import alone
from geneva_cli.machine.mechanism import Mechanism, build

if TYPE_CHECKING:
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


def part_sizes(mechanism: Mechanism, loads: PartLoads) -> PartSizes | None:
    """The dimensions of the parts of m designs under these loads; None if no design has parts."""
    if isinstance(mechanism.design, int):  # whose sizes are cached
        rows = [_row(mechanism)]
    else:
        each = (build(alone(mechanism.spec, i)) for i in range(mechanism.designs))
        rows = [_row(one, loads.of(i)) for i, one in enumerate(each)]
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


def _row(machine: Mechanism, loads: PartLoads | None = None) -> list[float]:
    """The numbers of a machine's parts in one row; none for a machine without flat parts."""
    parts = sized(machine, loads)
    return _numbers(stressed(*parts)) if parts else []


def _numbers(of: Stressed) -> list[float]:
    shafts, keys = (*of.wheel_shaft, *of.crank_shaft), (*of.wheel_key, *of.crank_key)
    return [of.contact, of.pin, *shafts, *map(float, of.arm), *map(float, keys)]
