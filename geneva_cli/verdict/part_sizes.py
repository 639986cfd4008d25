"""The dimensions of stressed parts, of the lock and of racks' horns, for one machine or a batch.

Parts are sized one design after the other, as their defaults depend on rollers' whole paths.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.analysis.locking import Lock
from geneva_cli.drawings.model import kind_of
from geneva_cli.errors import GenevaError
from geneva_cli.layout.assembly import Assembly
from geneva_cli.layout.plain_sizes import Sizes
from geneva_cli.layout.sizes import Layout, sized
from geneva_cli.layout.stressed import Stressed, stressed
from geneva_cli.loads.strength.arm import ArmDimensions
from geneva_cli.loads.strength.keys import KeyDimensions
from geneva_cli.machine.many import alone, designs_in
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.arrays import parameter
from geneva_cli.numerics.jet import Array
from geneva_cli.outlines.cut_lock import cut_lock


class LockSizes(NamedTuple):
    """Sizes of slot and lock, mm; (m, 1) for m designs, NaN for those without."""

    half_width: float  # half the slot's width: roller and clearance
    lock: Lock  # in its narrowest sector


def design_lock_sizes(mechanism: Mechanism) -> LockSizes | None:
    """The sizes of m designs, (m, 1), or numbers for one; None if none has a lock."""
    whole = mechanism.spec
    # the parts' sizes depend on these tables; designs that differ in loads only are sized once
    spec = Spec(whole.wheel, whole.drive, whole.motion, whole.size, drive_before=whole.drive_before)
    return layouts_lock_sizes([sized(build(alone(spec, i))) for i in range(designs_in(spec))])


def layouts_lock_sizes(layouts: Sequence[Layout | None]) -> LockSizes | None:
    """The sizes of designs whose parts are laid out; None if none has a lock."""
    columns = number_columns([_lock(*one) if one and one[1].lock else None for one in layouts])
    return LockSizes(columns[0], Lock(*columns[1:])) if columns else None


def _lock(where: Assembly, size: Sizes) -> tuple[float, ...]:
    """Half the slot's width, and the lock as it is cut."""
    return size.half_width, *cut_lock(where, size)


def number_columns(rows: Sequence[Sequence[float] | None]) -> list[float] | None:
    """The columns of m designs' numbers, (m, 1), or numbers for one; None if no design has any.

    They are NaN for a design without numbers.
    """
    columns = _columns(rows)
    if columns is None:
        return None
    return [parameter(column[:, None]) if len(rows) > 1 else column.item() for column in columns]


def _columns(rows: Sequence[Sequence[float] | None]) -> Array | None:
    """The k columns of m designs' numbers, (k, m), NaN without any; None if no design has any."""
    known = next((row for row in rows if row is not None), None)
    if known is None:
        return None
    none = [math.nan] * len(known)
    return np.array([none if row is None else row for row in rows]).T


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
    columns = _columns([_numbers(one) if one else None for one in parts])
    if columns is None:
        return None
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


def rack_horns(machines: Sequence[Mechanism]) -> tuple[float, float] | None:
    """Half the slot's width and the recess's radius of racks, (m, 1); None if none has a lock.

    They are NaN for a rack without a lock, and for one that cannot be cut.
    """
    columns = number_columns([_horn(machine) for machine in machines])
    return (columns[0], columns[1]) if columns else None


def _horn(machine: Mechanism) -> tuple[float, float] | None:
    from geneva_cli.outlines.rack import rack_sizes  # a wheel that turns needs none

    try:
        sizes = rack_sizes(machine)
    except GenevaError:  # the check of the parts reports the error
        return None
    return (sizes.half_width, sizes.recess) if sizes.lock else None
