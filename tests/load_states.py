"""The loads at input angles, as the cycle's formulas have them, for tests."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.loads.contact import contact
from geneva_cli.loads.instant import QUANTITIES, Instant, bounded
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.motion.engagement import Peak
from geneva_cli.numerics.arrays import Number
from geneva_cli.numerics.quadrature import span_integrals


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
    at = contact(engagement, x, reactions=False)
    case = load_case(mechanism)
    with np.errstate(all="ignore"):
        here = Instant(case, at)
        names = ("wheel_torque_Nm", "pin_force_N", "input_torque_Nm")
        loads = [bounded(here, QUANTITIES[name]) for name in names]
        stress = (
            None if case.hertz is None else np.sqrt(bounded(here, QUANTITIES["contact_stress_MPa"]))
        )
    pressure = np.degrees(np.arctan2(np.abs(at.offset.c[0]), at.lever.c[0])) + 0.0 * x
    rows = (*loads, stress)
    single = np.ndim(input_deg) == 0 and all(np.ndim(row) < 2 for row in rows)
    return LoadState(*(row[0] if single and row is not None else row for row in (*rows, pressure)))


def greatest(mechanism, name):
    """The greatest size of a quantity of one design, and its first input angle."""
    most, at_deg = load_peaks(mechanism, [name])[name]
    return Peak(most.item(), at_deg.item())


def integrals(cycle, *of):
    """The integral of functions of instants over a period by the input angle in radians."""
    total = np.zeros((len(of), 1))
    for engagement in cycle.mechanism.engagements:
        pieces = [piece for owner, piece in cycle.stretches if owner is engagement]
        start, end, *signs = np.array(pieces).T

        def rows(x, which, engagement=engagement, signs=signs):
            at = contact(engagement, x)
            here = Instant(cycle.case, at, *(sign[which, None] for sign in signs))
            return np.stack([np.broadcast_to(f(here).c[0], x.shape) for f in of])

        one, needed = np.zeros(len(pieces), dtype=int), np.full(total.shape, True)
        with np.errstate(all="ignore"):
            each = span_integrals(rows, (start, end), one, needed)
            total += each.sum(axis=1, keepdims=True)
    return [float(x) for x in np.radians(total[:, 0])]
