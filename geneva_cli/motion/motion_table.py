"""The wheel's position, velocity, acceleration and jerk over a whole period of the machine.

Tables are of one design, since each design has its own rows of motion and dwell. For a batch, call
the ``motion`` of an engagement.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.jet import Array
from geneva_cli.table import Table, computed_table

SAMPLES_MAX = 1_000_000  # some seconds of writing, some 80 MB


def motion_columns(mechanism: Mechanism) -> tuple[str, ...]:
    """Names of the columns of a table of motion.

    On a carrier the wheel's motion from the ground follows, positive as the carrier turns.
    """
    output = mechanism.output.column
    own = ("time_s", "input_deg", output, "velocity", "acceleration", "jerk")
    absolute = ("absolute_deg", "absolute_velocity", "absolute_acceleration")
    return (*own, *absolute) if mechanism.frame else own


def check_samples(samples: int) -> None:
    """Raise GenevaError for too few or too many samples."""
    if not 2 <= samples <= SAMPLES_MAX:
        raise GenevaError(f"--samples {cut(samples)}: must be at least 2, at most {SAMPLES_MAX}")


def motion_table(mechanism: Mechanism, samples: int) -> Table:
    """``samples`` rows, evenly spaced in the input angle over one period from the first entry.

    Entry and exit belong to the motion: their rows show the limits from inside. The last row is the
    end of the last dwell.
    """
    check_samples(samples)
    names = motion_columns(mechanism)
    return computed_table(names, samples, lambda i, j: _rows(mechanism, samples, i, j))


def turns_table(mechanism: Mechanism, samples: int, count: int, knots: Array) -> Table:
    """Rows as of ``motion_table`` over ``count`` periods, and one at each entry, exit and jump.

    ``knots`` are those of ``knots_deg``. ``samples`` rows are evenly spaced. The wheel's angle goes
    on from period to period.
    """
    check_samples(samples)
    whole = count * mechanism.period_deg
    even = np.linspace(0.0, whole, samples)
    nearest = np.searchsorted(knots, even)
    apart = np.minimum(
        abs(even - knots[np.clip(nearest, 0, len(knots) - 1)]), abs(even - knots[nearest - 1])
    )
    # An even row that a knot repeats but for rounding is left out.
    places = np.sort(np.append(even[apart > 1e-9 * mechanism.period_deg], knots))
    start = first_entry_deg(mechanism)
    total = math.fsum(2.0 * one.half_step for one in mechanism.engagements)
    columns: list[list[Array]] = []
    for k in range(count):
        after, before = k * mechanism.period_deg, (k + 1) * mechanism.period_deg
        last = k + 1 == count
        here = places[(places >= after) & ((places < before) | last)]
        wheel, *rates = derivatives(mechanism, start + (here - after), (0, 1, 2, 3))
        input_deg = start + here
        time_s = times_s(mechanism, input_deg)
        shown = (wheel + k * total) * mechanism.output.per_radian
        own = [time_s, input_deg, shown, *rates]
        columns.append([*own, *_from_ground(mechanism, input_deg, shown, rates)])
    return Table(motion_columns(mechanism), [np.concatenate(c) for c in zip(*columns, strict=True)])


class Span(NamedTuple):
    """A motion and the dwell after it, as slices of ascending input angles."""

    engagement: Engagement
    moves: slice
    rests: slice
    base: float  # the wheel's angle at mid-step, radians from the middle of the first step


def inputs(mechanism: Mechanism, samples: int, begin: int, end: int) -> Array:
    """The input angles of rows ``begin`` to ``end - 1`` of ``samples`` over a period."""
    start = first_entry_deg(mechanism)
    input_deg: Array = start + mechanism.period_deg * np.arange(begin, end) / (samples - 1)
    if end == samples:
        input_deg[-1] = start + mechanism.period_deg
    return input_deg


def first_entry_deg(mechanism: Mechanism) -> float:
    """The input angle at which a period begins, degrees."""
    return mechanism.engagements[0].mid_deg + mechanism.engagements[0].entry_deg


def spans(mechanism: Mechanism, input_deg: Array) -> Iterator[Span]:
    """The motions of a period with the dwells after them; entry and exit belong to the motion."""
    engagements = mechanism.engagements
    first = 0
    for i, engagement in enumerate(engagements):
        # The wheel's angle from the steps before this one, constant within a cycle.
        base = sum(2.0 * s.half_step for s in engagements[:i]) + engagement.half_step
        base -= engagements[0].half_step
        exit_ = engagement.mid_deg + engagement.exit_deg
        last = max(first, int(np.searchsorted(input_deg, exit_, side="right")))
        following = i + 1 < len(engagements)
        next_entry = exit_ + mechanism.dwell_deg(i) if following else math.inf
        after = int(np.searchsorted(input_deg, next_entry, side="left"))
        yield Span(engagement, slice(first, last), slice(last, after), base)
        first = after


def local_deg(span: Span, input_deg: Array) -> Array:
    """The input angles of a motion, degrees from its own mid-motion."""
    engagement = span.engagement
    here = input_deg[span.moves] - engagement.mid_deg
    return np.clip(here, engagement.entry_deg, engagement.exit_deg)


def _rows(mechanism: Mechanism, samples: int, begin: int, end: int) -> list[Array]:
    """The columns' rows ``begin`` to ``end - 1`` of ``samples``."""
    input_deg = inputs(mechanism, samples, begin, end)
    wheel, *rates = derivatives(mechanism, input_deg, (0, 1, 2, 3))
    shown = wheel * mechanism.output.per_radian
    own = [times_s(mechanism, input_deg), input_deg, shown, *rates]
    return [*own, *_from_ground(mechanism, input_deg, shown, rates)]


def _from_ground(
    mechanism: Mechanism, input_deg: Array, wheel_deg: Array, rates: Sequence[Array]
) -> list[Array]:
    """Absolute angle, velocity and acceleration of a wheel on a carrier; nothing without one."""
    if not mechanism.frame:
        return []
    sense = mechanism.spec.wheel.SIGN
    angle = mechanism.absolute_deg(input_deg, wheel_deg)
    return [angle, 1.0 + sense * rates[0], sense * rates[1]]


def derivatives(mechanism: Mechanism, input_deg: Array, orders: Sequence[int]) -> list[Array]:
    """The wheel's angle, radians, and its derivatives at ascending input angles of a period."""
    out = [np.zeros(len(input_deg)) for _ in orders]
    for span in spans(mechanism, input_deg):
        local = local_deg(span, input_deg)
        rest = span.engagement.half_step
        if len(local):
            rows = span.engagement.motion.derivatives(local, orders)
            for total, row in zip(out, rows, strict=True):
                total[span.moves] = row
        for order, total in zip(orders, out, strict=True):
            if order == 0:
                total[span.rests] = rest
                total[span.moves.start : span.rests.stop] += span.base
    return out


def times_s(mechanism: Mechanism, input_deg: Array) -> Array:
    """Seconds from the first entry."""
    return (input_deg - first_entry_deg(mechanism)) / (6.0 * mechanism.spec.drive.n_rpm)
