"""The wheel's position, velocity, acceleration and jerk over a whole period of the machine."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.table import Table, pieces

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

SAMPLES_MAX = 1_000_000  # some seconds of writing, some 80 MB
HELD = 100_000  # rows; longer tables are computed as they are written
NAMES = ("time_s", "input_deg", "wheel_deg", "velocity", "acceleration", "jerk")


def check_samples(samples: int) -> None:
    """Raise GenevaError where so many samples are too few or too many."""
    if not 2 <= samples <= SAMPLES_MAX:
        raise GenevaError(f"--samples {cut(samples)}: must be at least 2, at most {SAMPLES_MAX}")


def motion_table(mechanism: Mechanism, samples: int) -> Table:
    """``samples`` rows, evenly in the input angle over one period from the first entry.

    Entry and exit belong to the motion: what is just inside is shown there. The last row is the
    end of the last dwell.
    """
    check_samples(samples)
    if samples > HELD:
        return Table(
            NAMES, pieces(samples, len(NAMES), lambda i, j: _rows(mechanism, samples, i, j))
        )
    return Table(NAMES, _rows(mechanism, samples, 0, samples))


def _rows(mechanism: Mechanism, samples: int, begin: int, end: int) -> list[Array]:
    """The columns' rows from ``begin`` up to ``end``, left out, of ``samples`` in all."""
    engagements = mechanism.engagements
    start = engagements[0].mid_deg + engagements[0].entry_deg
    input_deg = start + mechanism.period_deg * np.arange(begin, end) / (samples - 1)
    if end == samples:
        input_deg[-1] = start + mechanism.period_deg
    wheel = np.empty(len(input_deg))
    rates = [np.zeros(len(input_deg)) for _ in range(3)]
    first = 0
    for i, engagement in enumerate(engagements):
        # What stays constant within a cycle: the steps that are done before it.
        base = sum(2.0 * s.half_step for s in engagements[:i]) + engagement.half_step
        base -= engagements[0].half_step
        exit_ = engagement.mid_deg + engagement.exit_deg
        last = int(np.searchsorted(input_deg, exit_, side="right"))
        if last > first:
            local = np.clip(
                input_deg[first:last] - engagement.mid_deg,
                engagement.entry_deg,
                engagement.exit_deg,
            )
            for out, values in zip(
                [wheel, *rates], engagement.motion.derivatives(local), strict=True
            ):
                out[first:last] = values
            wheel[first:last] += base
        following = i + 1 < len(engagements)
        next_entry = exit_ + mechanism.dwell_deg(i) if following else math.inf
        first = int(np.searchsorted(input_deg, next_entry, side="left"))
        wheel[last:first] = base + engagement.half_step
    time = (input_deg - start) / (6.0 * mechanism.spec.drive.n_rpm)
    return [time, input_deg, np.degrees(wheel), *rates]
