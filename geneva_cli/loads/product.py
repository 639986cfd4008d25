"""What the product on the dial feels: travel, speed, acceleration and jerk in SI units.

A product at the radius r on a dial that turns i times as far as the wheel has, with V = psi',
A = psi'' and J = psi''' by the input's angle and the input's speed w,

    speed        r w i V
    acceleration r w² sqrt((i A)² + (i V)^4)     along its path, and towards the axis
    jerk         r w³ i J                        along its path

A chain, belt or film on a sprocket of N teeth of pitch p has r = N p / (2 pi), so that a step moves
it by whole pitches, and has no acceleration towards an axis.

A wheel on a carrier of the radius L turns at 1 + V from the ground, or at 1 - V inside. The product
is taken where it feels most: there the speed is greater by w L, the acceleration by w² L.

Source: circular motion. Between peaks of speed and of acceleration along the path, the resultant
has peaks of its own, so that its square is searched.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.carried import G
from geneva_cli.motion.batch import selection
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.many import worst_peaks
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import PeakArray, greater, search_motion
from geneva_cli.motion.timing import timings
from geneva_cli.numerics.angles import DEGREE, omega
from geneva_cli.numerics.arrays import Array, Which, parameter
from geneva_cli.numerics.extremes import Smooth


class ProductMotion(NamedTuple):
    """What the products of m designs feel, (m,) each; NaN for what a design does not have."""

    travel_mm: Array  # along the path in the longest step
    chord_mm: Array  # straight from stop to stop; NaN for a chain
    speed_m_s: PeakArray
    tangential_m_s2: PeakArray  # along the path
    centripetal_m_s2: PeakArray  # towards the axis; 0 for a chain
    acceleration_m_s2: PeakArray  # of both together
    jerk_m_s3: PeakArray  # along the path
    friction_needed: Array  # friction coefficient at which the product just does not slip
    swing_mm: Array  # amplitude that a step leaves of a product that hangs or sloshes


def product_motion(mechanism: Mechanism) -> ProductMotion | None:
    """The motion of the products of m designs; None if their place is not known.

    Nothing is said of slipping on a dial that stands upright, where the product's weight acts along
    its seat.

    >>> from geneva_cli import Design, External, Product
    >>> dial = Design(External(6), product=Product(radius_mm=300.0)).mechanism
    >>> round(product_motion(dial).travel_mm.item(), 6)
    314.159265
    """
    spec, product, m = mechanism.spec, mechanism.spec.product, mechanism.designs
    if not product.lies:
        return None
    radius_mm = product.radius_mm
    if radius_mm is None:
        assert product.sprocket_teeth is not None and product.pitch_mm is not None
        radius_mm = product.sprocket_teeth * product.pitch_mm / (2.0 * math.pi)
    steps = [2.0 * one.half_step for one in mechanism.engagements]
    ratio, w, r_mm, *each = (
        np.broadcast_to(np.ravel(x), m)
        for x in (spec.support.gear_ratio, omega(spec.drive.n_rpm), radius_mm, *steps)
    )
    step, scale = np.max(each, axis=0), 1e-3 * r_mm * ratio * w
    peaks = worst_peaks(mechanism, ["velocity", "acceleration", "jerk"])
    velocity, along, jerk = (peaks[name] for name in ("velocity", "acceleration", "jerk"))
    orbit = np.zeros(m)
    if mechanism.frame:  # from the ground the greatest velocity is at least that of the dwell, 1
        orbit = 1e-3 * np.ravel(mechanism.center_distance_mm) * w
        most, first = abs(mechanism.frame + velocity.max), mechanism.engagements[0]
        entry = np.ravel(mechanism.shown_deg(first.mid_deg + first.entry_deg))
        at_deg = np.where(most > 1.0, velocity.at_deg, entry)
        velocity = PeakArray(np.maximum(most, 1.0), at_deg)
    straight = product.runs_straight
    inwards = PeakArray(np.zeros(m) if straight else ratio * velocity.max**2, velocity.at_deg)
    both = along if straight else _resultant(mechanism, ratio)

    def scaled(peak: PeakArray, by: Array, more: Array | float = 0.0) -> PeakArray:
        return PeakArray(np.broadcast_to(peak.max * by + more, m), peak.at_deg)

    acceleration, none = scaled(both, scale * w, orbit * w), np.full(m, np.nan)
    return ProductMotion(
        r_mm * ratio * step,
        none if straight else 2.0 * r_mm * abs(np.sin(0.5 * ratio * step)),
        scaled(velocity, scale, orbit),
        scaled(along, scale * w),
        scaled(inwards, scale * w),
        acceleration,
        scaled(jerk, scale * w * w),
        acceleration.max / G if spec.support.axis == "vertical" else none,
        r_mm * ratio * _swing(mechanism),
    )


def _resultant(mechanism: Mechanism, ratio: Array) -> PeakArray:
    """The peak of sqrt(A² + i² V^4) over all engagements, which is a fraction 1/i of the above.

    On a carrier V is the velocity from the ground.
    """

    def greatest(engagement: Engagement) -> PeakArray:
        some = selection(engagement.motion)

        def square(x: Array, which: Which, order: int, _: Sequence[int]) -> list[tuple[Array, ...]]:
            rate = some(which).rate(x, order + 1)
            velocity, acceleration = rate.lower + mechanism.frame, rate.derivative()
            turned = velocity * velocity * ratio[which][:, None]
            return [(acceleration * acceleration + turned * turned).arrays()]

        most, x, _ = search_motion(engagement.motion, Smooth(square, unit=DEGREE))
        place = engagement.mid_deg + parameter(x[0][:, None])
        return PeakArray(np.sqrt(most[0]), np.ravel(mechanism.shown_deg(place)))

    return reduce(greater, map(greatest, mechanism.engagements))


def _swing(mechanism: Mechanism) -> Array:
    """The amplitude that a step leaves, in radians of the dial; NaN without a swing_Hz.

    It is NaN too where the motion's time over the natural period is out of the range computed.
    """
    from geneva_cli.loads.vibration.swing import Oscillator
    from geneva_cli.loads.vibration.vibration import PERIOD_RATIO, Oscillators

    product, m = mechanism.spec.product, mechanism.designs
    if product.swing_Hz is None:
        return np.full(m, np.nan)
    periods = timings(mechanism)[0].motion_s * product.swing_Hz
    ratio, zeta = (np.broadcast_to(np.ravel(x), m) for x in (periods, product.swing_damping))
    known = (ratio >= PERIOD_RATIO.low) & (ratio <= PERIOD_RATIO.high)
    swing = Oscillator(np.where(known, ratio, 1.0), zeta)
    left_deg = Oscillators(mechanism, swing).residual_deg.max(axis=0)
    return np.where(known, np.radians(left_deg), np.nan)
