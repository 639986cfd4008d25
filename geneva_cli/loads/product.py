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
    product, m = mechanism.spec.product, mechanism.designs
    if not product.lies:
        return None
    ratio = _each(mechanism.spec.support.gear_ratio, m)
    w = _each(omega(mechanism.spec.drive.n_rpm), m)
    radius_mm = _each(_radius_mm(mechanism), m)
    scale = 1e-3 * radius_mm * ratio * w
    straight = product.runs_straight
    peaks = worst_peaks(mechanism, ["velocity", "acceleration", "jerk"])
    velocity, along, jerk = (peaks[name] for name in ("velocity", "acceleration", "jerk"))
    orbit = np.zeros(m)
    if mechanism.frame:
        velocity = _from_ground(mechanism, velocity)
        orbit = _each(1e-3 * mechanism.center_distance_mm, m) * w
    squared = np.zeros(m) if straight else ratio * velocity.max**2
    inwards = PeakArray(squared, velocity.at_deg)
    both = along if straight else _resultant(mechanism, ratio)
    acceleration = _raised(_scaled(both, scale * w), orbit * w)
    step = np.max(
        [np.broadcast_to(np.ravel(2.0 * one.half_step), m) for one in mechanism.engagements], axis=0
    )
    lies_flat = mechanism.spec.support.axis == "vertical"
    return ProductMotion(
        radius_mm * ratio * step,
        np.full(m, np.nan) if straight else 2.0 * radius_mm * abs(np.sin(0.5 * ratio * step)),
        _raised(_scaled(velocity, scale), orbit),
        _scaled(along, scale * w),
        _scaled(inwards, scale * w),
        acceleration,
        _scaled(jerk, scale * w * w),
        acceleration.max / G if lies_flat else np.full(m, np.nan),
        radius_mm * ratio * _swing(mechanism),
    )


def _radius_mm(mechanism: Mechanism) -> float:
    """The product's distance from the axis; of a sprocket its chain's travel per radian."""
    product = mechanism.spec.product
    if product.radius_mm is not None:
        return product.radius_mm
    assert product.sprocket_teeth is not None and product.pitch_mm is not None
    return product.sprocket_teeth * product.pitch_mm / (2.0 * math.pi)


def _each(value: float | Array, m: int) -> Array:
    return np.broadcast_to(np.ravel(value), m)


def _scaled(peak: PeakArray, scale: Array) -> PeakArray:
    return PeakArray(np.broadcast_to(peak.max * scale, len(scale)), peak.at_deg)


def _raised(peak: PeakArray, by: Array) -> PeakArray:
    return peak._replace(max=peak.max + by)


def _from_ground(mechanism: Mechanism, velocity: PeakArray) -> PeakArray:
    """The peak of a velocity from the ground, over the carrier's; at rest it is 1."""
    most = abs(mechanism.frame + velocity.max)
    first = mechanism.engagements[0]
    entry = _each(mechanism.shown_deg(first.mid_deg + first.entry_deg), len(most))
    return PeakArray(np.maximum(most, 1.0), np.where(most > 1.0, velocity.at_deg, entry))


def _resultant(mechanism: Mechanism, ratio: Array) -> PeakArray:
    """The peak of sqrt(A² + i² V^4) over all engagements, which is a fraction 1/i of the above.

    On a carrier V is the velocity from the ground.
    """
    best: PeakArray | None = None
    for engagement in mechanism.engagements:
        size, at_deg = _greatest_square(engagement, ratio, mechanism.frame)
        place = engagement.mid_deg + parameter(at_deg[:, None])
        here = PeakArray(np.sqrt(size), np.ravel(mechanism.shown_deg(place)))
        best = here if best is None else greater(best, here)
    assert best is not None  # a machine has an engagement
    return best


def _greatest_square(engagement: Engagement, ratio: Array, frame: float) -> tuple[Array, Array]:
    motion, some = engagement.motion, selection(engagement.motion)

    def square(x: Array, which: Which, order: int, _: Sequence[int]) -> list[tuple[Array, ...]]:
        rate = some(which).rate(x, order + 1)
        velocity, acceleration = rate.lower + frame, rate.derivative()
        turned = velocity * velocity * ratio[which][:, None]
        return [(acceleration * acceleration + turned * turned).arrays()]

    most, x, _ = search_motion(motion, Smooth(square, unit=DEGREE))
    return most[0], x[0]


def _swing(mechanism: Mechanism) -> Array:
    """The amplitude that a step leaves, in radians of the dial; NaN without a swing_Hz.

    It is NaN too where the motion's time over the natural period is out of the range computed.
    """
    from geneva_cli.loads.vibration.oscillator import PERIOD_RATIO, Oscillator
    from geneva_cli.loads.vibration.vibration import Oscillators

    product, m = mechanism.spec.product, mechanism.designs
    if product.swing_Hz is None:
        return np.full(m, np.nan)
    ratio = _each(timings(mechanism)[0].motion_s * product.swing_Hz, m)
    known = (ratio >= PERIOD_RATIO.low) & (ratio <= PERIOD_RATIO.high)
    swing = Oscillator(np.where(known, ratio, 1.0), _each(product.swing_damping, m))
    left_deg = Oscillators(mechanism, swing).residual_deg.max(axis=0)
    return np.where(known, np.radians(left_deg), np.nan)
