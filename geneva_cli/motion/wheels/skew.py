"""Straight slots whose axes miss the wheel's centre by e, in units of the centre distance L.

They are shockless at both ends if the slot's axis is tangent to the crank's circle. Then l = sin b
cos d, with d = asin(e / cos b). The crank's angle of motion stays 180° - 2b. The jumps differ: l /
cos(b - d) at entry, l / cos(b + d) at exit.

At the limit |e| = cos² b, where b + |d| = 90°, the gentler of the slot's ends would meet the
wheel's centre line. All that is small there is a product with the distance to that limit, which is
computed once.
"""

from __future__ import annotations

from geneva_cli.motion.wheels.classic import gap, half_motion_deg
from geneva_cli.motion.wheels.poses import HalfStep, PinPose, Skew, middle
from geneva_cli.numerics.angles import sin_cos_pi
from geneva_cli.numerics.arrays import choose, library


def margin(step: HalfStep, e: float) -> float:
    """cos² b - |e|: positive if a slot of offset e exists for half an index angle b."""
    # cos² b by the double angle, which is exact for 3, 4 and 6 slots
    limit: float = 0.5 + 0.5 * sin_cos_pi(2 * step.p, step.q)[1]
    return limit - abs(e)


def skew(step: HalfStep, e: float, spare: float) -> Skew:
    """The slot of offset e for half an index angle b; ``spare`` is its ``margin``, above 0."""
    m = library(e, step.p, step.q)
    sin_b, cos_b = step.sin_cos
    less = 2.0 * sin_cos_pi(step.p, 2 * step.q)[0] ** 2  # 1 - cos b
    size = abs(e) / cos_b  # |sin d|
    # cos b - |e| = (cos² b - |e|) + cos b (1 - cos b)
    cos_d = m.sqrt((spare + cos_b * less) * (cos_b + abs(e))) / cos_b
    d = m.atan2(size, cos_d)
    wide = cos_b * cos_d + sin_b * size  # cos(b - |d|), a sum of positive terms
    near = spare / cos_b * (cos_b + size)  # cos² b - sin² d
    narrow = near / wide  # cos(b + |d|)
    deepest = near / (cos_d + sin_b)  # cos d - sin b
    least = gap(1.0, *step) + sin_b * size * size / (1.0 + cos_d)  # 1 - l
    l = sin_b * cos_d
    long = half_motion_deg(1.0, *step) + m.degrees(d)
    short = m.degrees(m.atan2(narrow, sin_b * cos_d + cos_b * size))
    turn = m.atan2(size * (sin_b - cos_d * less), deepest * cos_d + abs(e) * size)
    mid = middle(1.0, l, least)
    gentle = e > 0.0  # at entry
    poses = (
        PinPose(
            choose(gentle, -long, -short),
            -step.b,
            choose(gentle, wide, narrow),
            (-l, 0.0),
            (0.0, l),
        ),
        mid._replace(wheel=choose(gentle, turn, -turn)),
        PinPose(
            choose(gentle, short, long), step.b, choose(gentle, narrow, wide), (l, 0.0), (0.0, -l)
        ),
    )
    return Skew(e, m.copysign(d, e), deepest, poses)
