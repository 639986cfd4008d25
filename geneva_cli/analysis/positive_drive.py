"""Is the wheel driven positively? Where a curved slot lacks the wall that its load needs.

The roller passes each radius of the wheel twice, in and out, and by the same track only if the odd
part of the motion is the straight slot's (the one-track theorem). Otherwise the slot has two
branches, and each keeps only its outer wall. Where the other wall would have to carry the torque,
nothing holds the wheel but the play between the branches.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.analysis.loads import loads
from geneva_cli.machine.mechanism import Mechanism

SAMPLES = 720  # in a half motion
PLAY_MM = 0.01  # branches nearer than this are one slot, as a shop cuts it


class Drive(NamedTuple):
    """How a curved slot drives: the intervals where it does not, and its branches' distance."""

    loose_deg: tuple[tuple[float, float], ...]  # input angles without the needed wall
    share: float  # of the motion that they take
    gap_mm: float  # greatest distance of the two branches, along the wheel's circumference
    gap_at_deg: float
    loose_gap_mm: float = 0.0  # the same where the needed wall is missing


def positive_drive(mechanism: Mechanism) -> Drive | None:
    """Where the slot drives the wheel under the spec's load; None for straight slots.

    The torque is inertia plus resistance. The wall ahead is needed where it is positive: the way
    in keeps that wall where the roller leads the way out at the same radius, the way out where
    it lags.
    """
    engagement, L = mechanism.engagements[0], mechanism.center_distance_mm
    if not engagement.slot.curved:
        return None
    # Places between the samples of a grid that has mid-motion, where the branches meet.
    x = engagement.entry_deg * (1.0 - (np.arange(SAMPLES) + 0.5) / SAMPLES)
    (ax, ay), (bx, by) = engagement.slot(x, 0), engagement.slot(-x, 0)
    lead = np.arctan2(ay.c[0], ax.c[0]) - np.arctan2(by.c[0], bx.c[0])
    gap = L * np.hypot(ax.c[0], ay.c[0]) * np.abs(lead)
    play = PLAY_MM + 2.0 * mechanism.spec.size.slot_clearance_mm
    loose, wide = [], 0.0
    for side, degrees in ((1.0, x), (-1.0, -x)):
        torque = loads.state(mechanism, engagement, degrees).torque_Nm
        missing = (gap > play) & (side * np.sign(lead) * torque < 0.0)
        loose += [float(d) for d in degrees[missing]]
        wide = max(wide, float(gap[missing].max(initial=0.0)))
    step = abs(engagement.entry_deg) / SAMPLES
    worst = int(np.argmax(gap))
    return Drive(
        tuple(_intervals(sorted(loose), step)),
        len(loose) / (2.0 * SAMPLES),
        float(gap[worst]),
        float(x[worst]),
        wide,
    )


def _intervals(places: list[float], step: float) -> list[tuple[float, float]]:
    """Neighbouring places, each half a step wide on both sides, joined."""
    out: list[tuple[float, float]] = []
    for x in places:
        low, high = x - 0.5 * step, x + 0.5 * step
        if out and low - out[-1][1] < 0.1 * step:
            out[-1] = (out[-1][0], high)
        else:
            out.append((low, high))
    return out
