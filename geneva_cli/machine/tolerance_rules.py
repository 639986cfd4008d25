"""Tolerances that make no machine: refused when it is built."""

from __future__ import annotations

import math
from functools import partial

from geneva_cli.errors import GenevaError, refuse
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.arrays import choose


def refuse_tolerances(spec: Spec, L: float, ratio: float) -> None:
    """Raise GenevaError, naming the key, for a tolerance that is too large or has no dimension."""
    values, lock = spec.tolerance.as_dict(), spec.size.lock_radius_mm
    unlocked = (not spec.drive.LOCKS) | (lock == 0.0)
    for key in ("lock_radius_mm", "recess_radius_mm"):
        refuse(unlocked & (values[key] != 0.0), partial(_no_lock, key, values[key]))
    steps = spec.wheel.steps
    arm = L * (math.sin(math.radians(0.5 * min(steps))) if steps else ratio)
    step = min(steps) if steps else 360.0 / spec.wheel.z
    roller = 2.0 * spec.roller_radius_mm(L)
    slot = roller + 2.0 * spec.size.allowances.slot_clearance_mm
    disc = arm if lock is None else choose(lock == 0.0, arm, lock)
    for key, below, what in (
        ("center_distance_mm", L, "the centre distance"),
        ("crank_radius_mm", arm, "the crank's radius"),
        ("roller_diameter_mm", roller, "the roller's diameter"),
        ("slot_width_mm", slot, "the slot's width"),
        ("slot_angle_deg", 0.5 * step, "half the wheel's step"),
        ("lock_radius_mm", disc, "the locking disc's radius, or the crank's"),
        ("recess_radius_mm", disc, "the locking disc's radius, or the crank's"),
    ):
        refuse(values[key] >= below, partial(_too_large, key, values[key], below, what))


def _no_lock(key: str, value: float) -> GenevaError:
    return GenevaError(
        f"{key} = {value:g}: this machine has no locking disc; remove it", ("tolerance", key)
    )


def _too_large(key: str, value: float, below: float, what: str) -> GenevaError:
    return GenevaError(
        f"{key} = ±{value:g} is as large as the dimension itself: it must be below "
        f"{below:.6g}, {what}",
        ("tolerance", key),
    )
