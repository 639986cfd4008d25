"""Quantities of machines whose motion a law gives, from the scaled peaks of the law."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from geneva_cli.analysis.law_values import Characteristic, characteristic
from geneva_cli.kinematics.laws.law import Law
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.study.sweep.columns import columns

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array


@cache
def law_costs(law: Law) -> Characteristic:
    """The greatest values of a law, cached."""
    return characteristic(law)


def law_columns(machine: Mechanism, names: Sequence[str], count: int) -> list[Array] | None:
    """Quantities of ``count`` machines in a batch, (count,) each, as ``columns`` returns them.

    The peaks of a law's motion are scaled from the law's own, so that no search is needed.
    """
    known = law_peaks(machine)
    rest = [name for name in names if name not in known]
    searched = columns(machine, rest, count) if rest else []
    if searched is None:
        return None
    others = iter(searched)
    return [
        np.broadcast_to(np.reshape(known[name], -1), (count,)) if name in known else next(others)
        for name in names
    ]


def law_peaks(machine: Mechanism) -> dict[str, Any]:
    """A law's greatest values, scaled to the step and to the motion angle; empty without a law.

    For a batch they are arrays (n, 1).
    """
    law = machine.engagements[0].motion.law
    if law is None:
        return {}
    (engagement,) = machine.engagements
    C_v, C_a, C_j, C_p = law_costs(law)
    step, rate = 2.0 * engagement.half_step, 1.0 / (engagement.motion_deg * (math.pi / 180.0))
    speed = omega(machine.spec.drive.n_rpm)
    entry = engagement.motion(engagement.entry_deg, 2).derivatives()[2]
    return {
        "velocity.max": C_v * step * rate,
        "acceleration.max": C_a * step * rate**2,
        "acceleration.max_rad_s2": C_a * step * (rate * speed) ** 2,
        "acceleration.entry": abs(entry),
        "jerk.max": C_j * step * rate**3,
        "power.max": C_p * step**2 * rate**3,
    }
