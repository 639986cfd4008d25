"""The swing of many designs' loads: the numbers of ``geneva vibration``, all worked out together.

The speeds to avoid are a list as long as a design has lobes, and so of one design alone.

    >>> import numpy as np
    >>> from geneva_cli import External, Load, Shaft
    >>> from geneva_cli.machine.many import many
    >>> from geneva_cli.machine.spec import Spec
    >>> spec = Spec(External(6), load=Load(inertia_kgm2=0.2), shaft=Shaft(stiffness_Nm_rad=5e3))
    >>> found = many(spec, {"drive.n_rpm": np.array([60.0, 90.0])})
    >>> vibrations_of_many(found.machine).residual_share.round(6)
    array([0.000708, 0.000695])
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.carried import inertia_kgm2
from geneva_cli.analysis.peaks_many import peaks_of_many
from geneva_cli.analysis.timing import timings
from geneva_cli.analysis.vibration.during import greatest_accelerations
from geneva_cli.analysis.vibration.lobes import lobes_of_many
from geneva_cli.analysis.vibration.oscillator import RATIO, period_ratio_of
from geneva_cli.analysis.vibration.panels import Panels
from geneva_cli.analysis.vibration.shape import Shape, law_shape, motion_panels
from geneva_cli.analysis.vibration.swing import Swing, residual_swing
from geneva_cli.analysis.vibration.swing_many import residual_swing_of_many
from geneva_cli.analysis.vibration.vibration import SOFTER, STIFFER
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.many import taken
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Complex, Whole

GROUP = 32  # designs at a time: the panels of each are some 20 kB, and stay in the cache


class Vibrations(NamedTuple):
    """Of m designs (m,) each, as of the command; NaN where one is not known."""

    period_ratio: Array
    damping_ratio: Array
    natural_Hz: Array
    residual_share: Array
    residual_deg: Array
    residual_share_worst: Array
    steady_share: Array
    dynamic_factor: Array
    windup_deg: Array


class Index:
    """One kind of index of m designs, behind which their loads swing."""

    def __init__(self, engagement: Engagement, m: int) -> None:
        self.engagement = engagement
        law = engagement.motion.law
        alike = law is not None and taken(law, slice(0)) is law  # it has no numbers that vary
        self.shape: Shape | None = law_shape(law) if law and alike else None
        self.panels: Panels = self.shape.flat if self.shape else motion_panels(engagement.motion, m)

    def motion(self, which: Whole) -> Whole:
        """The numbers of designs' motions among the panels'."""
        return 0 * which if self.shape else which

    def residual_swing(self, which: Whole, swing: Swing) -> Complex:
        """What the motions of designs leave of their oscillators' swing."""
        if self.shape:
            return residual_swing(self.shape, swing)
        return residual_swing_of_many(self.panels, which, swing)

    def greatest(self, swing: Swing) -> Array:
        """The greatest accelerations of the loads, over the step, by the share of the time."""
        motion = self.motion(np.arange(len(swing.ratio)))
        return greatest_accelerations(self.panels, motion, swing)


def vibrations_of_many(
    mechanism: Mechanism, asked: Collection[str] = Vibrations._fields
) -> Vibrations | None:
    """The answers of m designs; None where they have no ``stiffness_Nm_rad``.

    What takes its time and is not ``asked`` for is NaN: the worst residual, and what happens during
    the motion.
    """
    stiffness = mechanism.spec.shaft.stiffness_Nm_rad
    if stiffness is None:
        return None
    with np.errstate(all="ignore"):
        found = period_ratio_of(mechanism, stiffness, inertia_kgm2(mechanism.spec))
    damping = mechanism.spec.shaft.damping_ratio
    motions = [engagement.motion for engagement in mechanism.engagements]
    own = [motion(motion.entry_deg, 1).c[1] + motion.entry_deg for motion in motions]
    ratio, zeta = (np.ravel(x) for x in np.broadcast_arrays(found, damping, *own)[:2])
    known = np.flatnonzero(np.isfinite(ratio) & RATIO.holds(ratio))
    out = np.full((len(Vibrations._fields), len(ratio)), np.nan)
    for i in range(0, len(known), GROUP):
        part = known[i : i + GROUP]
        out[:, part] = _of(taken(mechanism, part), Swing(ratio[part], zeta[part]), asked)
    return Vibrations(*out)


def _of(mechanism: Mechanism, swing: Swing, asked: Collection[str]) -> list[Array]:
    """The answers of designs whose oscillators are known."""
    m, every = len(swing.ratio), np.arange(len(swing.ratio))
    indices = [Index(engagement, m) for engagement in mechanism.engagements]
    steps = [np.ravel(2.0 * index.engagement.half_step) for index in indices]
    first = indices[0].engagement.motion_deg
    scales = [np.ravel(index.engagement.motion_deg / first) for index in indices]
    own = [swing._replace(ratio=swing.ratio * scale) for scale in scales]
    residuals = [
        index.residual_swing(every, some) for index, some in zip(indices, own, strict=True)
    ]
    residual = [np.abs(one) for one in residuals]
    windup, swung, none = [], [], np.full(m, np.nan)
    for index, some, step in zip(indices, own, steps, strict=True):
        whole = np.ravel(index.engagement.motion_deg * DEGREE)
        motion = index.engagement.motion
        wheel = peaks_of_many(motion, ["acceleration"])["acceleration"].max * whole * whole / step
        bent = np.degrees(step) / (2.0 * np.pi * some.ratio) ** 2
        windup.append(wheel * bent)
        swung.append(index.greatest(some) * bent if "dynamic_factor" in asked else none)
    natural = swing.ratio / np.ravel(timings(mechanism)[0].motion_s)
    turned = [np.degrees(share * step) for share, step in zip(residual, steps, strict=True)]
    most = np.max(windup, axis=0)
    return [
        swing.ratio,
        swing.damping,
        natural,
        np.max(residual, axis=0),
        np.max(turned, axis=0),
        _worst(indices, scales, swing) if "residual_share_worst" in asked else none,
        _steady(mechanism, residuals, steps, swing),
        np.max(swung, axis=0) / most,
        most,
    ]


def _worst(indices: list[Index], scales: list[Array], swing: Swing) -> Array:
    """The greatest residual share for any stiffness within 20 % of the given."""
    worst = np.zeros(len(swing.ratio))
    for index, scale in zip(indices, scales, strict=True):
        own = swing.ratio * scale

        def share_at(which: Whole, ratio: Array, index: Index = index) -> Array:
            return np.abs(index.residual_swing(which, Swing(ratio, swing.damping[which])))

        every = np.arange(len(own))
        for factor in (SOFTER, 1.0, STIFFER):
            worst = np.maximum(worst, share_at(every, own * factor))
        found = lobes_of_many(share_at, own * SOFTER, own * STIFFER)
        inside = found.ratio <= own[found.which] * STIFFER
        inside &= found.ratio >= own[found.which] * SOFTER
        np.maximum.at(worst, found.which[inside], found.share[inside])
    return worst


def _steady(
    mechanism: Mechanism, residuals: list[Complex], steps: list[Array], swing: Swing
) -> Array:
    """The residual share once the cycle repeats itself, as of ``vibration.steady``."""
    engagements = mechanism.engagements
    period = np.ravel(mechanism.period_deg)
    rate = swing.p / np.ravel(engagements[0].motion_deg)  # by degrees of the input
    exits = [np.ravel(e.mid_deg + e.exit_deg) for e in engagements]
    added = [one * step for one, step in zip(residuals, steps, strict=True)]
    out = []
    with np.errstate(all="ignore"):
        sum_ = -np.expm1(rate * period)
        for exit_, step in zip(exits, steps, strict=True):
            ages = [(exit_ - other) % period for other in exits]
            left_over = sum(a * np.exp(rate * age) for a, age in zip(added, ages, strict=True))
            out.append(np.abs(left_over / sum_) / step)
        return np.where(swing.damping > 0.0, np.max(out, axis=0), np.nan)
