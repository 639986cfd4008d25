"""What a load on an elastic shaft does at a design's speed, and at which speeds it swings most.

The wheel turns by psi, the load by psi + r, and between them are a spring k and a damper:

    r'' + 2 zeta wn r' + wn² r = -psi'',    wn² = k / I

The period ratio is the motion's time over the natural period 2 pi / wn. A residual is the amplitude
of the swing that a motion leaves, begun at rest, at its end; its share is that of the wheel's step.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.peaks import peak
from geneva_cli.analysis.vibration.during import greatest_acceleration
from geneva_cli.analysis.vibration.lobes import Lobes, highest_ratio, lobes, shares
from geneva_cli.analysis.vibration.oscillator import Oscillator
from geneva_cli.analysis.vibration.shape import shape
from geneva_cli.analysis.vibration.swing import Swing, residual_swing
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

SOFTER, STIFFER = math.sqrt(0.8), math.sqrt(1.2)  # the natural frequency's at 20 % of stiffness
SLOWER, FASTER = 0.5, 2.0  # the speeds looked at, over the design's
AVOIDED = 1e-4  # least share of the step that makes a speed one to avoid


class Station(NamedTuple):
    """One kind of index."""

    period_ratio: float
    residual_share: float
    residual_deg: float
    dynamic_factor: float  # greatest acceleration of the load over the wheel's, during the motion
    windup_deg: float  # I alpha / k at the wheel's greatest acceleration
    steady_share: (
        float | None
    )  # the residual after many cycles; None: without damping there is none


class Avoid(NamedTuple):
    """A speed at which the residual is greatest, and where it moves to with stiffness +-20 %."""

    rpm: float
    from_rpm: float
    to_rpm: float
    residual_share: float


def stations(mechanism: Mechanism, load: Oscillator) -> list[Station]:
    """Each engagement of a period, the load at rest before it (but for the steady state)."""
    out = []
    for engagement, scale, share in zip(
        mechanism.engagements, _scales(mechanism), steady_shares(mechanism, load), strict=True
    ):
        form, ratio = shape(engagement), load.ratio * scale
        step = 2.0 * engagement.half_step
        residual = float(shares(form, np.array([ratio]), load.damping)[0])
        # the wheel's greatest acceleration by the share of the motion's time, over the step
        whole = engagement.motion_deg * DEGREE
        wheel = peak(engagement.motion, "acceleration").max * whole * whole / step
        swings = greatest_acceleration(form, ratio, load.damping)
        windup = wheel * math.degrees(step) / (2.0 * math.pi * ratio) ** 2
        out.append(
            Station(ratio, residual, residual * math.degrees(step), swings / wheel, windup, share)
        )
    return out


def _scales(mechanism: Mechanism) -> list[float]:
    """The time of each motion over that of the first."""
    first = mechanism.engagements[0].motion_deg
    return [engagement.motion_deg / first for engagement in mechanism.engagements]


def steady_shares(mechanism: Mechanism, load: Oscillator) -> list[float | None]:
    """The residual after each motion once the cycle repeats itself, over that motion's step.

    A motion adds its own residual to what is left of all before it: a geometric series. Without
    damping it has no sum.
    """
    engagements = mechanism.engagements
    if not load.damping:
        return [None] * len(engagements)
    return [float(s[0]) for s in steady(mechanism, np.array([load.ratio]), load.damping)]


def steady(mechanism: Mechanism, ratio: Array, damping: float) -> list[Array]:
    """The same at many period ratios of the first engagement, with a damping above 0."""
    engagements = mechanism.engagements
    zeta = np.full(ratio.shape, damping)
    rate = Swing(ratio, zeta).p / engagements[0].motion_deg  # by degrees of the input
    added = [
        residual_swing(shape(e), Swing(ratio * scale, zeta)) * e.half_step
        for e, scale in zip(engagements, _scales(mechanism), strict=True)
    ]
    exits = [e.mid_deg + e.exit_deg for e in engagements]
    sum_ = -np.expm1(rate * mechanism.period_deg)
    out = []
    for here, exit_ in zip(engagements, exits, strict=True):
        ages = [(exit_ - other) % mechanism.period_deg for other in exits]
        swing = sum(a * np.exp(rate * age) for a, age in zip(added, ages, strict=True))
        out.append(np.abs(swing / sum_) / here.half_step)
    return out


def speeds_to_avoid(mechanism: Mechanism, load: Oscillator) -> list[Avoid]:
    """Speeds at which the residual has a local maximum of at least ``AVOIDED`` of the step.

    From half to twice the design's, ascending. Where engagements differ, the greatest residual of
    all counts.
    """
    n_rpm = mechanism.spec.drive.n_rpm
    scales = _scales(mechanism)
    found: list[tuple[float, float]] = []
    for i, engagement in enumerate(mechanism.engagements):
        form = shape(engagement)
        low = load.ratio / FASTER * scales[i]
        high = min(load.ratio / SLOWER * scales[i], highest_ratio(form, AVOIDED, load.damping))
        if low >= high:
            continue
        own = lobes(form, low, high, load.damping)
        worst = residuals(mechanism, own.ratio / scales[i], load.damping)
        kept = (own.share >= AVOIDED) & (own.share >= worst * (1.0 - 1e-12))
        places = zip(own.ratio[kept] / scales[i], own.share[kept], strict=True)
        found += [(float(r), float(s)) for r, s in places]
    speeds = [(n_rpm * load.ratio / ratio, share) for ratio, share in found]
    return [Avoid(n, n * SOFTER, n * STIFFER, share) for n, share in sorted(speeds)]


def each_share(mechanism: Mechanism, ratio: Array, damping: float) -> list[Array]:
    """The residual share of each engagement, at period ratios of the first."""
    every = zip(mechanism.engagements, _scales(mechanism), strict=True)
    return [shares(shape(e), ratio * scale, damping) for e, scale in every]


def residuals(mechanism: Mechanism, ratio: Array, damping: float) -> Array:
    """The greatest of them."""
    worst: Array = np.max(each_share(mechanism, ratio, damping), axis=0)
    return worst


def worst_residuals(mechanism: Mechanism, ratio: Array, damping: float) -> Array:
    """The same, the greatest for any stiffness within 20 % of the given."""
    near = [residuals(mechanism, ratio * f, damping) for f in (SOFTER, 1.0, STIFFER)]
    out: Array = np.max(near, axis=0)
    for engagement, scale in zip(mechanism.engagements, _scales(mechanism), strict=True):
        low, high = ratio * (SOFTER * scale), ratio * (STIFFER * scale)
        own: Lobes = lobes(shape(engagement), float(low.min()), float(high.max()), damping)
        first, last = np.searchsorted(own.ratio, low), np.searchsorted(own.ratio, high)
        for i in np.flatnonzero(first < last):
            out[i] = max(out[i], own.share[first[i] : last[i]].max())
    return out
