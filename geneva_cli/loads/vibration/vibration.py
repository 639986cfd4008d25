"""Vibration of a load on an elastic shaft, for oscillators at several speeds or a batch of designs.

The wheel turns by psi, the load by psi + r, and between them are a spring k and a damper:

    r'' + 2 zeta wn r' + wn² r = -psi'',    wn² = k / I

The period ratio is the motion's time over the natural period 2 pi / wn. A residual is the amplitude
of the vibration after a motion that began at rest. Its share is the fraction of the wheel's step.

    >>> import numpy as np
    >>> from geneva_cli import External, Load, Shaft
    >>> from geneva_cli.motion.many import many
    >>> from geneva_cli.motion.machine_spec import Spec
    >>> spec = Spec(External(6), load=Load(inertia_kgm2=0.2), shaft=Shaft(stiffness_Nm_rad=5e3))
    >>> machine = many(spec, {"drive.n_rpm": np.array([60.0, 90.0])}).machine
    >>> design_vibrations(machine).residual_share.round(6)
    array([0.000708, 0.000695])
"""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads.carried import inertia_kgm2
from geneva_cli.loads.vibration.centrifugal import STIFFEST, pull, stiffness_ratio, with_each_motion
from geneva_cli.loads.vibration.maxima import Lobes, greatest_accelerations, highest_ratio, lobes
from geneva_cli.loads.vibration.oscillator import PERIOD_RATIO, Oscillator, period_ratio_of
from geneva_cli.loads.vibration.panels import law_shape, motion_shapes, shape
from geneva_cli.loads.vibration.swing import residual_swing
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import motion_peaks
from geneva_cli.motion.timing import timings
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Complex, Whole, array, parameter

SOFTER, STIFFER = math.sqrt(0.8), math.sqrt(1.2)  # the natural frequency's at 20 % of stiffness
SLOWER, FASTER = 0.5, 2.0  # range of speeds over the design's
AVOIDED_SHARE = 1e-4  # least share of the step that makes a speed one to avoid


class Vibrations(NamedTuple):
    """Vibration results of m designs, (m,) each; NaN for values that are not known."""

    period_ratio: Array
    damping_ratio: Array
    natural_Hz: Array
    residual_share: Array
    residual_deg: Array
    residual_share_worst: Array
    steady_share: Array
    dynamic_factor: Array
    windup_deg: Array


class SpeedToAvoid(NamedTuple):
    """A speed with a local maximum of the residual, and its range for a stiffness of +-20 %."""

    rpm: float
    from_rpm: float
    to_rpm: float
    residual_share: float


class Index:
    """One kind of index: of one design, or of each design in a batch of m."""

    def __init__(self, mechanism: Mechanism, engagement: Engagement) -> None:
        motion, law, m = engagement.motion, mechanism.input_law, mechanism.designs
        self.motion = motion
        # its time over that of the machine's first motion
        self.scale = np.ravel(engagement.motion_deg / mechanism.engagements[0].motion_deg)
        self.whole = np.ravel(engagement.motion_deg * DEGREE)
        self.pull = pull(mechanism, engagement)
        self.exit_deg = np.ravel(engagement.mid_deg + engagement.exit_deg)
        self.step = np.ravel(2.0 * engagement.half_step)
        # a law without numbers that vary has one shape in all designs
        alike = law is not None and taken(law, slice(0)) is law
        self.is_one = m == 1 or alike
        single = isinstance(mechanism.design, int)
        if law and (alike or single):
            self.panels = law_shape(law)
        else:
            self.panels = shape(motion) if single else motion_shapes(motion, m)

    def shapes(self, which: Whole) -> Whole:
        """Return the numbers of oscillators' motions among the panels'."""
        return 0 * which if self.is_one else which

    def residual(self, which: Whole, ratio: Array, damping: Array) -> Complex:
        """Return the residuals of oscillators, by period ratios of the first motion."""
        scale = self.scale if len(self.scale) == 1 else self.scale[which]
        swing, own = Oscillator(ratio * scale, damping), self.shapes(which)
        if self.pull is None:
            return residual_swing(self.panels, own, swing)
        swing = self.pull.softened(swing, which)
        return residual_swing(self.panels, own, swing) + self.pull.residual(own, swing)

    def spans_deg(self, dwell_deg: float, swing: Oscillator[Array]) -> tuple[Array, Array]:
        """Return input angles of the motion and of the dwell after it, as the load swings in them.

        They are angles in which the load without an unbalance would swing as often.
        """
        motion, dwell = np.ravel(self.whole / DEGREE), np.ravel(dwell_deg)
        if self.pull is None:
            return motion, dwell
        own, every = swing._replace(ratio=swing.ratio * self.scale), np.arange(len(swing.ratio))
        moves, rests = (self.pull.softened(own, every, resting).ratio for resting in (False, True))
        return motion * moves / own.ratio, dwell * rests / own.ratio

    def lobes(self, damping: Array, low: Array, high: Array) -> Lobes:
        """Return the lobes of oscillators, each between two period ratios."""
        return lobes(lambda of, ratio: np.abs(self.residual(of, ratio, damping[of])), low, high)

    def highest_ratio(self, low: float, damping: float) -> float:
        """Return a ratio of this motion, ``low`` or above, over which no speed is one to avoid."""
        if self.pull is None:
            return highest_ratio(self.panels, AVOIDED_SHARE, damping)
        # of the shaft's stiffness is left: at twice the speed U/k is four times as much
        left = 1.0 - 4.0 * STIFFEST
        # where each of the residual's two parts is below half of the share, their sum is below it
        omega = 2.0 * math.pi * low
        shares = 0.5 * AVOIDED_SHARE, 0.5 * AVOIDED_SHARE * omega * omega * left
        both = zip((self.panels, self.pull.shape), shares, strict=True)
        return max(highest_ratio(panels, share, damping) for panels, share in both) / math.sqrt(
            left
        )


class Oscillators:
    """n oscillators on a machine: each on one of its n designs, or all on one design.

    Arrays (stations, n) have a row for each kind of index in a period. The load is at rest before
    it, except in the steady state.
    """

    def __init__(
        self, mechanism: Mechanism, swing: Oscillator[Array], speed: Array | float = 1.0
    ) -> None:
        self.mechanism, self.swing = with_each_motion(mechanism), swing
        self.speed = speed  # over that of the mechanism
        self.every = np.arange(len(swing.ratio))
        self.indices = [Index(self.mechanism, e) for e in self.mechanism.engagements]

    @cached_property
    def ratio(self) -> Array:
        """Period ratios of each motion."""
        return np.array([self.swing.ratio * index.scale for index in self.indices])

    @cached_property
    def residual(self) -> Complex:
        """Residual vibrations, as complex numbers of ``residual_swing``."""
        return self.residuals(self.swing.ratio)

    def residuals(self, ratio: Array, which: Whole | None = None) -> Complex:
        """Return residual vibrations (stations, k) of some oscillators at period ratios (k,)."""
        which = self.every if which is None else which
        damping = self.swing.damping[which]
        return np.array([index.residual(which, ratio, damping) for index in self.indices])

    @property
    def share(self) -> Array:
        """Residual amplitudes over the step."""
        return np.abs(self.residual)

    @property
    def steps(self) -> Array:
        """The wheel's steps, radians."""
        return np.array([np.broadcast_to(index.step, self.every.shape) for index in self.indices])

    @property
    def residual_deg(self) -> Array:
        """Residual amplitudes, degrees."""
        return np.degrees(self.share * self.steps)

    @property
    def _bent_deg(self) -> Array:
        """Wind-up at an acceleration of 1 step over the motion's time squared, degrees."""
        out: Array = np.degrees(self.steps) / (2.0 * np.pi * self.ratio) ** 2
        return out

    @cached_property
    def windup_deg(self) -> Array:
        """I alpha / k at the wheel's greatest acceleration, degrees."""
        rows = []
        for index, bent in zip(self.indices, self._bent_deg, strict=True):
            most = motion_peaks(index.motion, ["acceleration"])["acceleration"].max
            # by the fraction of the motion's time, over the step
            rows.append(most * index.whole * index.whole / index.step * bent)
        return np.array(rows)

    @cached_property
    def swung_deg(self) -> Array:
        """I alpha / k at the load's greatest acceleration during the motion, degrees."""
        damping = self.swing.damping
        rows = [
            greatest_accelerations(i.panels, i.shapes(self.every), Oscillator(ratio, damping))
            for i, ratio in zip(self.indices, self.ratio, strict=True)
        ]
        return np.array(rows) * self._bent_deg

    @cached_property
    def steady_share(self) -> Array:
        """Residuals over the step in the steady state; NaN where there is none.

        A motion adds its own residual to the rest of all earlier ones: a geometric series. Without
        damping it has no sum, and a stop ends it after z - 1 motions.
        """
        exits, period = self._exits()
        stops = np.ravel(self.mechanism.stop_deg) * self.speed  # one in each dwell
        exits = [one + number * stops for number, one in enumerate(exits)]
        period = period + len(exits) * stops
        first = np.ravel(self.mechanism.engagements[0].motion_deg)
        rate = self.swing.p / first  # by degrees of the input
        added = [one * i.step for one, i in zip(self.residual, self.indices, strict=True)]
        rows = []
        with np.errstate(all="ignore"):
            sum_ = -np.expm1(rate * period)
            for index, own in zip(self.indices, exits, strict=True):
                ages = [(own - other) % period for other in exits]
                left = sum(a * np.exp(rate * age) for a, age in zip(added, ages, strict=True))
                rows.append(np.abs(left / sum_) / index.step)
        endless = not self.mechanism.spec.wheel.stopped
        return np.where((self.swing.damping > 0.0) & endless, rows, np.nan)

    def _exits(self) -> tuple[list[Array], Array]:
        """Return input angles at the ends of the motions, and the period, as the load swings."""
        if not self.mechanism.unbalanced:
            return [i.exit_deg for i in self.indices], np.ravel(self.mechanism.period_deg)
        exits, at = [], np.zeros(1)
        for number, index in enumerate(self.indices):
            motion, dwell = index.spans_deg(self.mechanism.dwell_deg(number), self.swing)
            exits.append(at + motion)
            at = exits[-1] + dwell
        return exits, at

    @cached_property
    def worst_share(self) -> Array:
        """Greatest residual share for any stiffness within 20 % of the spec's: (n,)."""
        low, high = self.swing.ratio * SOFTER, self.swing.ratio * STIFFER
        damping = self.swing.damping
        near = [self.residuals(ratio) for ratio in (low, self.swing.ratio, high)]
        worst: Array = np.abs(near).max(axis=(0, 1))
        for index in self.indices:
            one = index.is_one and bool((damping == damping[0]).all())
            if one:  # all oscillators have the lobes of one
                tops = index.lobes(damping, low.min(keepdims=True), high.max(keepdims=True))
                of, top = np.nonzero((tops.ratio >= low[:, None]) & (tops.ratio <= high[:, None]))
            else:
                tops = index.lobes(damping, low, high)
                of, top = tops.which, np.arange(len(tops.which))
            np.maximum.at(worst, of, tops.share[top])
        return worst


def oscillators_of(mechanism: Mechanism, load: Oscillator[float]) -> Oscillators:
    """Return the oscillator of one design."""
    return Oscillators(mechanism, Oscillator(np.array([load.ratio]), np.array([load.damping])))


def vibrations(
    oscillators: Oscillators, requested: Collection[str] = Vibrations._fields
) -> Vibrations:
    """Return the results of each oscillator; of several motions the greatest.

    The worst residual and the dynamic factor take time: they are NaN unless ``requested``.
    """
    swing, none = oscillators.swing, np.full(len(oscillators.every), np.nan)
    windup = oscillators.windup_deg.max(axis=0)
    return Vibrations(
        swing.ratio,
        swing.damping,
        swing.ratio / np.ravel(timings(oscillators.mechanism)[0].motion_s),
        oscillators.share.max(axis=0),
        oscillators.residual_deg.max(axis=0),
        oscillators.worst_share if "residual_share_worst" in requested else none,
        oscillators.steady_share.max(axis=0),
        oscillators.swung_deg.max(axis=0) / windup if "dynamic_factor" in requested else none,
        windup,
    )


def design_vibrations(
    mechanism: Mechanism, requested: Collection[str] = Vibrations._fields
) -> Vibrations | None:
    """Return the results of m designs; None without ``stiffness_Nm_rad``.

    They are NaN for a design whose period ratio is out of range, or whose shaft is so soft that
    bodies off the wheel's axis turn it about (``centrifugal``).
    """
    stiffness = mechanism.spec.shaft.stiffness_Nm_rad
    if stiffness is None:
        return None
    with np.errstate(all="ignore"):
        # an array, as a float's quotient by 0 is an error
        inertia = parameter(array(inertia_kgm2(mechanism.spec)))
        periods = period_ratio_of(mechanism, stiffness, inertia)
    damping = mechanism.spec.shaft.damping_ratio
    ratio, zeta = (np.broadcast_to(np.ravel(x), mechanism.designs) for x in (periods, damping))
    soft = stiffness_ratio(mechanism, ratio) <= STIFFEST
    known = np.flatnonzero(np.isfinite(ratio) & PERIOD_RATIO.holds(ratio) & soft)
    out = np.full((len(Vibrations._fields), len(ratio)), np.nan)
    size = 32  # designs at a time: the panels of each are some 20 kB, and stay in the cache
    for i in range(0, len(known), size):
        part = known[i : i + size]
        some = Oscillators(taken(mechanism, part), Oscillator(ratio[part], zeta[part]))
        out[:, part] = vibrations(some, requested)
    return Vibrations(*out)


def speeds_to_avoid(mechanism: Mechanism, load: Oscillator[float]) -> list[SpeedToAvoid]:
    """Return speeds at which the residual has a local maximum above ``AVOIDED_SHARE`` of the step.

    They range from half to twice the design's, ascending. If engagements differ, the greatest
    residual of all counts.
    """
    n_rpm, own = mechanism.spec.drive.n_rpm, oscillators_of(mechanism, load)
    places: list[tuple[float, float]] = []
    for index in own.indices:
        scale = float(index.scale[0])
        low = load.ratio / FASTER
        high = min(load.ratio / SLOWER, index.highest_ratio(low * scale, load.damping) / scale)
        if low >= high:
            continue
        tops = index.lobes(own.swing.damping, np.array([low]), np.array([high]))
        most = np.abs(own.residuals(tops.ratio, tops.which)).max(axis=0)
        # a lobe within 1e-12 of the greatest residual is equal to it
        kept = (tops.share >= AVOIDED_SHARE) & (tops.share >= most * (1.0 - 1e-12))
        places += zip(tops.ratio[kept].tolist(), tops.share[kept].tolist(), strict=True)
    speeds = [(n_rpm * load.ratio / ratio, share) for ratio, share in places]
    out: list[SpeedToAvoid] = []
    for n, share in sorted(speeds):
        # a body's directions that mirror each other have equal lobes, but for rounding
        if not (out and math.isclose(n, out[-1].rpm, rel_tol=1e-9)):
            out.append(SpeedToAvoid(n, n * SOFTER, n * STIFFER, share))
    return out
