"""The stretches of a period between places where a derivative of the motion may jump."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import distinct
from geneva_cli.numerics.jet import Array


class Stretch(NamedTuple):
    """A part of the period between two places where a derivative may jump.

    ``engagement`` is None in a dwell. Master and slave are degrees from the first entry.
    """

    engagement: Engagement | None
    begin_deg: float
    end_deg: float
    mid_deg: float  # where the engagement's own angle is 0
    base_deg: float  # the slave's angle there; in a dwell everywhere

    def states(self, master_deg: Array, side: int) -> Array:
        """Slave angle, velocity and acceleration (3, k) at ascending angles (k,).

        The acceleration is that just after the angles for ``side`` 1, just before for -1.
        """
        if self.engagement is None:
            rest = np.zeros((3, len(master_deg)))
            rest[0] = self.base_deg
            return rest
        wheel, velocity = self._derivatives(master_deg, (0, 1))
        nudge = 1e-9 * side * (self.end_deg - self.begin_deg)  # into the stretch
        acceleration, jerk = self._derivatives(master_deg + nudge, (2, 3))
        per_deg = np.radians(acceleration - np.radians(nudge) * jerk)
        return np.stack([self.base_deg + np.degrees(wheel), velocity, per_deg])

    def slave_deg(self, master_deg: Array) -> Array:
        """Slave angle (k,) at ascending angles (k,)."""
        if self.engagement is None:
            return np.full(len(master_deg), self.base_deg)
        return self.base_deg + np.degrees(self._derivatives(master_deg, (0,))[0])

    def _derivatives(self, master_deg: Array, orders: Sequence[int]) -> list[Array]:
        assert self.engagement is not None
        first, last = self.engagement.entry_deg, self.engagement.exit_deg
        local = np.clip(master_deg - self.mid_deg, first, last)
        return self.engagement.motion.derivatives(local, orders)


def periods(mechanism: Mechanism, turns: int | None) -> int:
    """The number of periods in ``turns`` of the input; 1 for None.

    Raises GenevaError if the turns are no whole periods.
    """
    if turns is None:
        return 1
    if not 1 <= turns <= 1000:  # more make no file that a program reads
        raise GenevaError(f"--turns {cut(turns)}: must be at least 1, at most 1000")
    count = 360.0 * turns / mechanism.period_deg
    if abs(count - round(count)) > 1e-9:
        whole = round(mechanism.period_deg / 360.0)
        raise GenevaError(
            f"--turns {turns}: this machine repeats after {whole} turns of its input; "
            f"give a multiple of {whole}"
        )
    z = mechanism.spec.wheel.z
    if mechanism.spec.wheel.stopped and turns > z - 2:
        raise GenevaError(
            f"--turns {turns}: the stop leaves {z - 2} whole motions, as the first and the last of "
            f"{z} are blocked half-way; give at most {z - 2}"
        )
    return round(count)


def knots_deg(mechanism: Mechanism, count: int) -> Array:
    """Where a derivative may jump in ``count`` periods, and the end: degrees from first entry."""
    ends = [stretch.begin_deg for stretch in stretches(mechanism)]
    repeats = mechanism.period_deg * np.arange(count)[:, None]
    knots: Array = np.append((repeats + np.array(ends)).ravel(), count * mechanism.period_deg)
    return knots


def stretches(mechanism: Mechanism) -> list[Stretch]:
    """The stretches of a period, in order: those of each motion, then its dwell."""
    out: list[Stretch] = []
    begin, slave = 0.0, 0.0
    for i, engagement in enumerate(mechanism.engagements):
        half = math.degrees(engagement.half_step)
        mid = begin - engagement.entry_deg
        # seams within the rounding of half a turn are one: no stretch is that short
        for first, last in pairwise(distinct(engagement.motion.seams_deg, 1e-12)):
            out.append(Stretch(engagement, mid + first, mid + last, mid, slave + half))
        slave += 2.0 * half
        dwell = mechanism.dwell_deg(i)
        begin = mid + engagement.exit_deg + dwell
        if dwell > 0.0:
            out.append(Stretch(None, begin - dwell, begin, begin, slave))
    # Sums of angles are rounded: each stretch ends where the next one begins, the last at the end.
    ends = [*(stretch.begin_deg for stretch in out[1:]), mechanism.period_deg]
    return [stretch._replace(end_deg=end) for stretch, end in zip(out, ends, strict=True)]
