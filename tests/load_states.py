"""The loads at input angles, as the cycle's formulas have them, for tests."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.loads.contact import contact, contact_values
from geneva_cli.loads.instant import bounded_loads
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.motion.engagement import Peak
from geneva_cli.numerics.arrays import Number


class LoadState(NamedTuple):
    """The loads at input angles from an engagement's mid-motion, (k,) or (m, k)."""

    torque_Nm: Number  # torque that the wheel needs
    pin_force_N: Number
    input_torque_Nm: Number
    contact_stress_MPa: Number | None  # None without a face width
    pressure_deg: Number


def state(mechanism, engagement, input_deg):
    """The loads at an input angle, or at several; infinite where they have no bound.

    At one angle they are numbers of one design, or (m, 1).
    """
    x = np.atleast_1d(input_deg)
    at = contact_values(contact(engagement, x, reactions=False))
    loads = bounded_loads(load_case(mechanism), at)
    squared = loads.stress_squared
    pressure = np.degrees(np.arctan2(np.abs(at.offset), at.lever)) + 0.0 * x
    stress = None if squared is None else np.sqrt(squared)
    rows = (loads.wheel_torque_Nm, np.abs(loads.pin_force_N), loads.input_torque_Nm, stress)
    single = np.ndim(input_deg) == 0 and all(np.ndim(row) < 2 for row in rows)
    return LoadState(*(row[0] if single and row is not None else row for row in (*rows, pressure)))


def greatest(mechanism, name):
    """The greatest size of a quantity of one design, and its first input angle."""
    most, at_deg = load_peaks(mechanism, [name])[name]
    return Peak(most.item(), at_deg.item())
