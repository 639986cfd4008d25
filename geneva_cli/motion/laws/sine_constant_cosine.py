"""One family of laws: the acceleration rises as a sine, is constant, and falls as a cosine.

R. L. Norton, Cam Design and Manufacturing Handbook, "The SCCA family": these take the fractions b,
c and d of the time in which a law accelerates. A middle fraction v may have constant velocity.
"""

import math
from itertools import compress, pairwise

from geneva_cli.motion.laws.law import from_velocity
from geneva_cli.numerics.arrays import enclosed, library
from geneva_cli.numerics.jet import Jet, Number, piecewise, sin


def peak(b: float, d: float, pi: float = math.pi) -> float:
    """Greatest acceleration without a middle at constant velocity; c is 1 - b - d."""
    bends = (pi * pi - 8.0) * (b - d) * (b + d)
    return 4.0 * pi * pi / (bends - 2.0 * pi * (pi - 2.0) * b + pi * pi)


def breaks(b: float, d: float, v: float = 0.0) -> tuple[float, ...]:
    """Values of u inside the motion at which a derivative up to the fourth jumps."""
    sine, constant, rise = _ends(b, d, v)
    flat = sine < constant
    jumps = b and (flat or d != b), d and flat, v or not d
    joints = {*compress((sine, constant, rise), jumps)}
    return tuple(sorted({*joints, *[1.0 - x for x in joints]}))


def _ends(b: float, d: float, v: float) -> tuple[float, float, float]:
    """Times at which sine, constant and cosine end; then constant velocity until the middle."""
    rise = 0.5 * (1.0 - v)
    return rise * b, max(rise * (1.0 - d), rise * b), rise


def first_half(u: Number, order: int, b: float, d: float, v: float = 0.0) -> Jet:
    """Fraction s on 0 <= u <= 1/2, with its derivatives; c is 1 - b - d."""
    joints = (0.0, *_ends(b, d, v), 0.5)
    b, d, v = enclosed(u, (b, d, v))
    rise = 0.5 * (1.0 - v)
    sine = rise * b
    level = rise * (1.0 - d) if joints[1] < joints[2] else sine  # where the cosine begins
    constant, cosine = level - sine, rise - level
    # v only stretches the time: top speed V of the rise alone, in 1 - v of its time
    m = library(u)
    pi, greatest = m.pi, peak(b, d, m.pi)
    alone = greatest * ((b + d) / pi + 0.5 * (1.0 - b - d))
    top = alone / (1.0 - v + v * alone)
    a = greatest * top / alone / (1.0 - v)

    v_1 = a * sine * 2.0 / pi  # after the sine
    s_1 = v_1 * sine * (1.0 - 2.0 / pi)
    v_2 = v_1 + a * constant  # before the cosine
    s_2 = s_1 + constant * (v_1 + 0.5 * a * constant)

    def start(x: Number) -> Jet:
        rate = 0.5 * pi / sine

        def velocity(x: Jet) -> Jet:
            half = sin(x * (0.5 * rate))
            return half * half * (2.0 * a / rate)

        return from_velocity(x, order, lambda x: a / rate * (x - m.sin(rate * x) / rate), velocity)

    def flat(x: Number) -> Jet:
        t = Jet.variable(x - sine, order)
        return t * (t * (0.5 * a) + v_1) + s_1

    def end(x: Number) -> Jet:
        rate, t = 0.5 * pi / cosine, x - level

        def position(x: Number) -> Number:
            return s_2 + v_2 * t + 2.0 * a * (m.sin(0.5 * rate * t) / rate) ** 2

        return from_velocity(
            x, order, position, lambda x: sin((x - level) * rate) * (a / rate) + v_2
        )

    def middle(x: Number) -> Jet:
        return 0.5 - (0.5 - Jet.variable(x, order)) * top

    each = zip(pairwise(joints), (start, flat, end, middle), strict=True)
    pieces = [(until, piece) for (since, until), piece in each if since < until]
    ends, kept = zip(*pieces, strict=True)
    return piecewise(u, ends[:-1], kept) if len(kept) > 1 else kept[0](u)
