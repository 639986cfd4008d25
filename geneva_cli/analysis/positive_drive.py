"""Positive drive: the input angles at which a curved slot lacks the wall that its load needs.

The roller passes each radius of the wheel twice, in and out. Both tracks are equal only if the odd
part of the motion is the straight slot's (the one-track theorem). Otherwise the slot has two
branches, and each keeps only its outer wall. Where the other wall would have to carry the torque,
only the play between the branches limits the wheel.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.analysis.forces import load_case
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, Mask

HALF_SAMPLES = 720  # places in half a motion


class PositiveDrives(NamedTuple):
    """Where m designs' slots lack the needed wall, and the distance of their branches, (m,) each.

    ``loose`` (m, k) is a mask of the places ``input_deg`` without positive drive.
    """

    fraction: Array  # of the motion without it
    gap_mm: Array  # greatest distance of the two branches, along the wheel's circumference
    gap_at_deg: Array
    loose_gap_mm: Array  # the greatest where the needed wall is missing
    input_deg: Array
    loose: Mask

    @property
    def loose_deg(self) -> list[tuple[float, float]]:
        """Intervals of a single design without the needed wall, input angles in degrees."""
        ((at,), (loose,)) = self.input_deg, self.loose
        return _intervals(np.sort(at[loose]).tolist(), abs(at[1] - at[0]).item())


def positive_drives(mechanism: Mechanism) -> PositiveDrives | None:
    """The positive drive of m designs; None for straight slots.

    The torque is inertia plus resistance. The wall ahead is needed where the torque is positive. At
    each radius, the entry branch keeps that wall where the roller leads the exit branch, and the
    exit branch where it lags.
    """
    engagement, L = mechanism.engagements[0], mechanism.center_distance_mm
    if not engagement.slot.curved:
        return None
    case = load_case(mechanism)
    # Midpoints of a grid that includes mid-motion, where the branches meet.
    x = np.atleast_2d(engagement.entry_deg * (1.0 - (np.arange(HALF_SAMPLES) + 0.5) / HALF_SAMPLES))
    back = engagement.inputs_deg(-engagement.own_deg(x))  # there the pin is as far along the slot
    (ax, ay), (bx, by) = engagement.slot(x, 0), engagement.slot(back, 0)
    lead = np.arctan2(ay.c[0], ax.c[0]) - np.arctan2(by.c[0], bx.c[0])
    gap = L * np.hypot(ax.c[0], ay.c[0]) * np.abs(lead)
    torque = [
        engagement.motion(places, 2).arrays()[2] * case.inertia_Nm + case.resists_Nm
        for places in (x, back)
    ]
    # branches nearer than 0.01 mm are one slot, as machined
    played = gap > 0.01 + 2.0 * mechanism.spec.size.allowances.slot_clearance_mm
    missing = [
        played & (side * np.sign(lead) * turned < 0.0)
        for side, turned in zip((1.0, -1.0), torque, strict=True)
    ]
    first, second, gap, x = np.broadcast_arrays(*missing, gap, x)
    wide = np.maximum(np.where(first, gap, 0.0), np.where(second, gap, 0.0)).max(axis=1)
    every, worst = np.arange(len(gap)), np.argmax(gap, axis=1)
    loose = np.hstack((first, second))
    return PositiveDrives(
        loose.mean(axis=1),
        gap[every, worst],
        x[every, worst],
        wide,
        np.hstack((x, np.broadcast_to(back, x.shape))),
        loose,
    )


def _intervals(places: list[float], step: float) -> list[tuple[float, float]]:
    """Adjacent places, each half a step wide on both sides, joined to intervals."""
    out: list[tuple[float, float]] = []
    for x in places:
        low, high = x - 0.5 * step, x + 0.5 * step
        if out and low - out[-1][1] < 0.1 * step:
            out[-1] = (out[-1][0], high)
        else:
            out.append((low, high))
    return out
