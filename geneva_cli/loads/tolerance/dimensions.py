"""The dimensions that deviate: the sizes of their deviations in mm and radians, and corners.

They are jets: of order 0 the values of many machines, of order 1 the slope by one dimension.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import all_true
from geneva_cli.numerics.jet import Jet, Number


class Deviations(NamedTuple):
    """Deviations of the dimensions in ``[tolerance]``, in their order."""

    center_distance_mm: Jet
    crank_radius_mm: Jet
    roller_diameter_mm: Jet
    slot_width_mm: Jet
    slot_angle_deg: Jet  # in radians here
    lock_radius_mm: Jet
    recess_radius_mm: Jet


AS_DRAWN = Deviations(*[Jet((0.0,))] * len(Deviations._fields))  # without any


def tolerances(spec: Spec) -> dict[str, float]:
    """Plus or minus of each dimension, in millimetres and radians."""
    values = spec.tolerance.as_dict()
    return {
        name: radians(values[name]) if name.endswith("_deg") else values[name]
        for name in Deviations._fields
    }


def without_effect(spec: Spec) -> dict[str, str]:
    """Dimensions whose deviations have no effect in a machine, with the reason."""
    why = {}
    if not spec.drive.ONE_ARM:
        why["crank_radius_mm"] = "no crank's arm carries the roller"
    if not spec.wheel.FLAT:
        why["center_distance_mm"] = "the shafts meet, whatever the sphere's radius"
    return why


def deviations(values: Sequence[Number]) -> Deviations:
    """Deviations with these values, without slopes."""
    return Deviations(*[Jet((value,)) for value in values])


def slope_of(number: int) -> Deviations:
    """Deviations of 0, with the slope by one of them."""
    return Deviations(*[Jet((0.0, float(i == number))) for i in range(len(Deviations._fields))])


def corners(sizes: Sequence[float]) -> Deviations:
    """Every combination of the ends of the nonzero tolerances: (2**n,), or (2**n, m, 1) of m."""
    ends = [(0.0,) if all_true(size == 0.0) else (-size, size) for size in sizes]
    return deviations([np.array(column) for column in zip(*product(*ends), strict=True)])
