"""What the product on the dial feels: travel, speed, acceleration and jerk in SI units.

A dial turns i times as far as the wheel. At its radius r the speed is r w i V, and the jerk along
the path r w³ i J. The acceleration r w² sqrt((i A)² + (i V)^4) is along the path and towards the
axis. A chain on a sprocket of N teeth of pitch p has r = N p / (2 pi) and no part towards an axis.
On a carrier the wheel turns at 1 + V from the ground, and w L and w² L add to the greatest.
"""

import math
from collections.abc import Sequence
from functools import reduce

import numpy as np

from geneva_cli.loads.load_case import G
from geneva_cli.motion.batch import selection
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.many import worst_peaks
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import PeakArray, greater, search_motion
from geneva_cli.numerics.angles import DEGREE, omega
from geneva_cli.numerics.arrays import Array, Which, parameter
from geneva_cli.numerics.extremes import Smooth
from geneva_cli.numerics.jet import Jet


def product_motion(mechanism: Mechanism) -> dict[str, Array]:
    """What the products of m designs feel, (m,) each by its name; nothing without their place.

    Speed and jerk are along the path, and the acceleration of a dial also towards the axis. At the
    friction coefficient ``friction_needed`` the product just does not slip.
    """
    spec, product, m = mechanism.spec, mechanism.spec.product, mechanism.designs
    if not product.lies:
        return {}
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
    # a chain, belt or film runs along a line
    both = _resultant(mechanism, ratio) if product.pitch_mm is None else along

    out: dict[str, Array] = {"travel_mm": r_mm * ratio * step}
    for name, peak, by, more in (
        ("speed_m_s", velocity, scale, orbit),
        ("acceleration_m_s2", both, scale * w, orbit * w),
        ("jerk_m_s3", jerk, scale * w * w, 0.0),
    ):
        out[f"{name}.max"] = np.broadcast_to(peak.max * by + more, m)
        out[f"{name}.at_deg"] = peak.at_deg
    if spec.support.axis == "vertical":
        out["friction_needed"] = out["acceleration_m_s2.max"] / G
    return out


def _resultant(mechanism: Mechanism, ratio: Array) -> PeakArray:
    """The peak of sqrt(A² + i² V^4) over all engagements; on a carrier V is from the ground."""

    def greatest(engagement: Engagement) -> PeakArray:
        some = selection(engagement.motion)

        def square(x: Array, which: Which, order: int, _: Sequence[int]) -> list[Jet]:
            rate = some(which).rate(x, order + 1)
            velocity, acceleration = rate.lower + mechanism.frame, rate.derivative()
            turned = velocity * velocity * ratio[which][:, None]
            return [acceleration * acceleration + turned * turned]

        most, x, _ = search_motion(engagement.motion, Smooth(square, unit=DEGREE))
        place = engagement.mid_deg + parameter(x[0][:, None])
        return PeakArray(np.sqrt(most[0]), np.ravel(mechanism.shown_deg(place)))

    return reduce(greater, map(greatest, mechanism.engagements))
