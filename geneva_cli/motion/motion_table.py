"""Position, velocity, acceleration and jerk of one design's wheel over whole periods."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import distinct
from geneva_cli.numerics.arrays import Whole, rising
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG
from geneva_cli.table import Table, computed_table

SAMPLES_MAX = 1_000_000  # some seconds of writing, some 80 MB


def motion_columns(mechanism: Mechanism) -> tuple[str, ...]:
    """Names of the columns of a table of motion."""
    own = "time_s", "input_deg", mechanism.output.column, "velocity", "acceleration", "jerk"
    # on a carrier the motion from the ground follows, positive as the carrier turns
    absolute = "absolute_deg", "absolute_velocity", "absolute_acceleration"
    return (*own, *rates_at_speed(mechanism), *(absolute if mechanism.frame else ()))


def rates_at_speed(mechanism: Mechanism) -> dict[str, float]:
    """Names of velocity and acceleration at the spec's speed, with an invariant's unit there."""
    output, omega = mechanism.output, mechanism.spec.drive.n_rpm * math.pi / 30.0
    scale = output.rate_per_radian
    rates = {"omega_rad_s": omega * scale, "alpha_rad_s2": omega * omega * scale}
    of_rack = {of: name for name, of, _ in output.loads}
    return {of_rack.get(name, name): rate for name, rate in rates.items()}


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

    def rows(begin: int, end: int) -> list[Array]:
        at = inputs(mechanism, samples, begin, end)
        return [*_columns(mechanism, at, np.zeros(len(at), int))]

    return computed_table(motion_columns(mechanism), samples, rows)


def turns_table(mechanism: Mechanism, samples: int, turns: int) -> Table:
    """Rows as of ``motion_table`` over some turns of the input, and at each entry, exit and jump.

    ``samples`` rows are evenly spaced. The wheel's angle goes on from period to period.
    """
    check_samples(samples)
    period, count = mechanism.period_deg, periods(mechanism, turns)
    knots = knots_deg(mechanism, count)
    even = np.linspace(0.0, count * period, samples)
    nearest = np.searchsorted(knots, even)
    apart = np.minimum(
        abs(even - knots[np.clip(nearest, 0, len(knots) - 1)]), abs(even - knots[nearest - 1])
    )
    # An even row that a knot repeats but for rounding is left out.
    places = np.sort(np.append(even[apart > 1e-9 * period], knots))
    passed = np.searchsorted(period * np.arange(1, count), places, "right")
    columns = _columns(mechanism, first_entry_deg(mechanism) + places, passed)
    return Table(motion_columns(mechanism), [*columns])


def checked_angles(at_deg: Sequence[float]) -> Array:
    """Input angles, degrees. Raises GenevaError for no number, or more than 1000 turns away."""
    places: Array = np.array([float(x) for x in at_deg], dtype=np.float64)
    most = 360_000.0  # degrees; farther away they lose their digits
    if not len(places) or not (abs(places) <= most).all():
        raise GenevaError(f"--at: input angles must be numbers of at most {most:g} degrees")
    return places


def angles_table(mechanism: Mechanism, at_deg: Sequence[float]) -> Table:
    """Rows as of ``motion_table`` at input angles from mid-motion, degrees, in their order.

    Time and the wheel's angle count from the first entry; before it they are those of the periods
    before. An entry and an exit within rounding of an angle belong to it.
    """
    places = checked_angles(at_deg)
    start, period = first_entry_deg(mechanism), mechanism.period_deg
    count = np.floor((places - start + SAME_INPUT_DEG) / period).astype(int)
    knots = start + knots_deg(mechanism, 1)
    near = knots[np.abs((places - count * period)[:, None] - knots).argmin(axis=1)] + count * period
    exact = np.where(abs(near - places) <= SAME_INPUT_DEG, near, places)
    columns = _columns(mechanism, exact, count)
    columns[1] = places
    return Table(motion_columns(mechanism), list(columns))


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


def times_s(mechanism: Mechanism, input_deg: Array) -> Array:
    """Seconds from the first entry. At the angle of a stop it is the time when the stop begins.

    Where braking and starting fit into a dwell, they stand in its middle, one after the other.
    """
    drive, begin = mechanism.spec.drive, first_entry_deg(mechanism)
    turned_deg, second = input_deg - begin, 6.0 * drive.n_rpm  # degrees of input a second
    time_s: Array = turned_deg / second
    if not drive.stop_s:
        return time_s
    count = np.floor(turned_deg / mechanism.period_deg)
    local = turned_deg - count * mechanism.period_deg
    lost_s: Array = count * len(mechanism.engagements) * drive.stop_s
    for number, engagement in enumerate(mechanism.engagements):
        dwell = mechanism.dwell_deg(number)
        brake, start = drive.brake_and_start_deg
        lead = 0.5 * (dwell - brake - start)
        if lead < 0.0:  # ``verdict`` warns: they are taken to be short
            brake, start, lead = 0.0, 0.0, 0.5 * dwell
        at = local - (engagement.mid_deg + engagement.exit_deg - begin) - lead
        # at constant acceleration the angle goes with the square of the time
        slower = np.clip(at, 0.0, brake)
        left = np.sqrt(1.0 - slower / brake) if brake else 0.0
        braking = drive.brake_s * (1.0 - left) - slower / second
        faster = np.clip(at - brake, 0.0, start)
        starting = drive.start_s * np.sqrt(faster / start) - faster / second if start else 0.0
        stands_s = drive.stop_s - (brake + start) / second
        lost_s = lost_s + np.where(at > 0.0, braking, 0.0)
        lost_s = lost_s + np.where(at > brake, stands_s + starting, 0.0)
    return time_s + lost_s


def _columns(mechanism: Mechanism, input_deg: Array, passed: Whole) -> Array:
    """The columns, each a row (k,), at input angles (k,), which so many periods have ``passed``."""
    out = np.empty((len(motion_columns(mechanism)), len(input_deg)))
    turned = math.fsum(2.0 * one.half_step for one in mechanism.engagements)
    for k in rising(passed).tolist():
        which = np.flatnonzero(passed == k)
        which = which[np.argsort(input_deg[which])]
        at = input_deg[which]
        wheel, *rates = derivatives(mechanism, at - k * mechanism.period_deg, (0, 1, 2, 3))
        shown = (wheel + k * turned) * mechanism.output.per_radian
        out[:, which] = columns_of(mechanism, at, shown, rates)
    return out


def columns_of(
    mechanism: Mechanism, input_deg: Array, shown: Array, rates: Sequence[Array]
) -> list[Array]:
    """The columns of a table of motion, from the wheel's angle as shown and three derivatives."""
    columns = [times_s(mechanism, input_deg), input_deg, shown, *rates]
    of_speed = rates_at_speed(mechanism).values()
    columns += [rate * scale for rate, scale in zip(rates[:2], of_speed, strict=True)]
    if mechanism.frame:
        sense = mechanism.spec.wheel.SIGN
        columns += [input_deg + sense * shown, 1.0 + sense * rates[0], sense * rates[1]]
    return columns


class Span(NamedTuple):
    """A motion and the dwell after it, as slices of ascending input angles."""

    engagement: Engagement
    moves: slice
    rests: slice
    base: float  # the wheel's angle at mid-step, radians from the middle of the first step
    local: Array  # the input angles of the motion, degrees from its own mid-motion


def spans(mechanism: Mechanism, input_deg: Array) -> Iterator[Span]:
    """The motions of a period with the dwells after them; entry and exit belong to the motion."""
    engagements = mechanism.engagements
    first = 0
    for i, one in enumerate(engagements):
        base = sum(2.0 * s.half_step for s in engagements[:i]) + one.half_step
        base -= engagements[0].half_step
        exit_ = one.mid_deg + one.exit_deg
        last = max(first, int(np.searchsorted(input_deg, exit_, side="right")))
        following = i + 1 < len(engagements)
        next_entry = exit_ + mechanism.dwell_deg(i) if following else math.inf
        after = int(np.searchsorted(input_deg, next_entry, side="left"))
        local = np.clip(input_deg[first:last] - one.mid_deg, one.entry_deg, one.exit_deg)
        yield Span(one, slice(first, last), slice(last, after), base, local)
        first = after


def derivatives(mechanism: Mechanism, input_deg: Array, orders: Sequence[int]) -> list[Array]:
    """The wheel's angle, radians, and its derivatives at ascending input angles of a period."""
    out = [np.zeros(len(input_deg)) for _ in orders]
    for engagement, moves, rests, base, local in spans(mechanism, input_deg):
        moving = engagement.motion.derivatives(local, orders) if len(local) else []
        for total, row in zip(out, moving, strict=False):
            total[moves] = row
        for order, total in zip(orders, out, strict=True):
            if order == 0:
                total[rests] = engagement.half_step
                total[moves.start : rests.stop] += base
    return out


class Stretch(NamedTuple):
    """A part of the period between two places where a derivative may jump.

    Angles of the master, the input, and of the slave, the wheel, are degrees from the first entry.
    """

    mechanism: Mechanism
    begin_deg: float
    end_deg: float

    def states(self, master_deg: Array, side: int) -> Array:
        """Slave angle, velocity and acceleration a degree (3, k) at ascending angles (k,).

        The acceleration is that just after the angles for ``side`` 1, just before for -1.
        """
        nudge = 1e-9 * side * (self.end_deg - self.begin_deg)  # into the stretch
        (velocity,) = self._derivatives(master_deg, (1,))
        acceleration, jerk = self._derivatives(master_deg + nudge, (2, 3))
        per_deg = np.radians(acceleration - np.radians(nudge) * jerk)
        return np.stack([self.slave_deg(master_deg), velocity, per_deg])

    def slave_deg(self, master_deg: Array) -> Array:
        """Slave angle (k,) at ascending angles (k,)."""
        (wheel,) = self._derivatives(master_deg, (0,))
        return np.degrees(wheel + self.mechanism.engagements[0].half_step)

    def _derivatives(self, master_deg: Array, orders: Sequence[int]) -> list[Array]:
        return derivatives(self.mechanism, first_entry_deg(self.mechanism) + master_deg, orders)


def stretches(mechanism: Mechanism) -> list[Stretch]:
    """The stretches of a period, in order."""
    knots = knots_deg(mechanism, 1).tolist()
    return [Stretch(mechanism, begin, end) for begin, end in pairwise(knots)]


def knots_deg(mechanism: Mechanism, count: int) -> Array:
    """Where a derivative may jump in ``count`` periods, and the end: degrees from first entry."""
    begins, entry = list[float](), 0.0
    for i, engagement in enumerate(mechanism.engagements):
        # seams within the rounding of half a turn are one: no stretch is that short
        *seams, last = distinct(engagement.motion.seams_deg, 1e-12)
        mid, dwell = entry - engagement.entry_deg, mechanism.dwell_deg(i)
        begins += [mid + seam for seam in (*seams, *([last] if dwell > 0.0 else []))]
        entry = mid + engagement.exit_deg + dwell
    repeats = mechanism.period_deg * np.arange(count)[:, None]
    knots: Array = np.append((repeats + np.array(begins)).ravel(), count * mechanism.period_deg)
    return knots


def periods(mechanism: Mechanism, turns: int | None) -> int:
    """The number of periods in ``turns`` of the input; 1 for None."""
    if turns is None:
        return 1
    if not 1 <= turns <= 1000:  # more make no file that a program reads
        raise GenevaError(f"--turns {cut(turns)}: must be at least 1, at most 1000")
    count = 360.0 * turns / mechanism.period_deg
    if abs(count - round(count)) > 1e-9:
        whole = round(mechanism.period_deg / 360.0)
        raise GenevaError(f"--turns {turns}: give a multiple of {whole}, this machine's period")
    z = mechanism.spec.wheel.z
    if mechanism.spec.wheel.stopped and turns > z - 2:
        raise GenevaError(f"--turns {turns}: the stop leaves {z - 2} whole motions; give no more")
    return round(count)
