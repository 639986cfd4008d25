"""Positive drive: the input angles at which a curved slot lacks the wall that its load needs.

The roller passes each radius of the wheel twice. Unless both tracks are equal, the slot has two
branches, and each keeps only its outer wall.
"""

from typing import NamedTuple

import numpy as np

from geneva_cli.loads.load_case import load_case
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import opposites
from geneva_cli.numerics.arrays import Array, Mask


class PositiveDrives(NamedTuple):
    """Where m designs' slots lack the needed wall, and the distance of their branches."""

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
        half = 0.5 * (at[1] - at[0])  # each place is half a step wide on both sides
        ends = np.flatnonzero(np.diff(np.pad(loose.astype(int), 1))).reshape(-1, 2)
        return [((at[a] - half).item(), (at[b - 1] + half).item()) for a, b in ends.tolist()]


def positive_drives(mechanism: Mechanism) -> PositiveDrives | None:
    """The positive drive of m designs; None for straight slots."""
    engagement, L = mechanism.engagements[0], mechanism.center_distance_mm
    if not engagement.slot.curved:
        return None
    case = load_case(mechanism)
    samples = 1440  # midpoints of a grid that includes mid-motion, where the branches meet
    start, end = np.atleast_2d(engagement.entry_deg, engagement.exit_deg)
    x = start + (end - start) * (np.arange(samples) + 0.5) / samples
    with np.errstate(invalid="ignore"):  # a longer branch has no opposite at its end
        (ax, ay), (bx, by) = (engagement.slot(at, 0) for at in (x, opposites(engagement, x)))
        lead = np.arctan2(ay.c[0], ax.c[0]) - np.arctan2(by.c[0], bx.c[0])
    gap = np.nan_to_num(L * np.hypot(ax.c[0], ay.c[0]) * np.abs(lead))
    torque = engagement.motion(x, 2).derivatives()[2] * case.inertia_Nm + case.resists_Nm
    # branches nearer than 0.01 mm are one slot, as machined
    played = gap > 0.01 + 2.0 * mechanism.spec.size.allowances.slot_clearance_mm
    loose, gap, x = np.broadcast_arrays(played & (lead * torque < 0.0), gap, x)
    every, worst = np.arange(len(gap)), np.argmax(np.where(x < 0.0, gap, 0.0), axis=1)
    widest, loosest = (every, worst), np.where(loose, gap, 0.0).max(axis=1)
    return PositiveDrives(loose.mean(axis=1), gap[widest], x[widest], loosest, x, loose)
