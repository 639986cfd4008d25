"""Crank and rotating coulisse (Whitworth): the transmission of the side-crank drive.

An input crank of length r turns about an axis that stands the base offset a away from the
coulisse's. A = a/r. With the input at phi the coulisse points along the vector
(A + cos phi, sin phi), whose angle is f.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from geneva_cli.machine.drives import Front
from geneva_cli.numerics.angles import sin_cos_deg
from geneva_cli.numerics.jet import Coefficient, Jet, library, sine_versine_of


def coulisse(A: float) -> Callable[[float], Front]:
    """Front about a coulisse angle f in degrees, for an offset A between -1 and 1."""
    return lambda crank_deg: _about(A, crank_deg)


def _about(A: float, crank_deg: float) -> Front:
    s, c = sin_cos_deg(crank_deg)
    # h = asin(A sin f) is the angle between input crank and coulisse. Its cosine, and the
    # coulisse's length cos h + A cos f, are written as sums of positive terms for A near +-1.
    sin_h = A * s
    cos_h = math.hypot(c, s * math.sqrt((1.0 - A) * (1.0 + A)))
    long = cos_h + abs(A * c)
    short = (1.0 - A) * (1.0 + A) / long
    length, rest = (long, short) if A * c > 0.0 else (short, long)
    level = s == 0.0  # on the line of centres, which is where most peaks are
    if level:
        length, rest = 1.0 + A * c, 1.0 - A * c

    h = math.atan2(sin_h, cos_h)

    def advance(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
        m = library(tau)
        sin_t, cos_t = m.sin(0.5 * tau), m.cos(0.5 * tau)
        # The coulisse's vector in the frame of its own direction at f.
        x = cos_t * cos_t * length - 2.0 * sin_t * cos_t * sin_h - sin_t * sin_t * rest
        y = 2.0 * sin_t * (cos_t * cos_h - sin_t * sin_h)
        # df/dphi = (1 + (1 - A²)/W)/2 with W = x² + y² = 1 + A² + 2 A cos phi: as A nears 1 the
        # coulisse turns at half speed, and nothing cancels.
        sine, cosine = x * s + y * c, x * c - y * s - A
        turns = (cosine, -sine, -0.5 * cosine, sine / 6.0, cosine / 24.0)[: max(order, 1)]
        # On the line of centres W is a sum for one sign of A; elsewhere x² + y² is.
        grows = level and A * c < 0.0
        W = length * length - 4.0 * A * c * sin_t * sin_t if grows else x * x + y * y
        square = Jet((W, *[2.0 * A * t for t in turns[1:]]))
        rate = 0.5 + (0.5 * (1.0 - A) * (1.0 + A)) / square
        return sine_versine_of(rate, y, x, order)

    # phi = f + h, but where the two nearly cancel, the angle of the input crank itself.
    phi = crank_deg + math.degrees(h)
    if A < 0.0:
        turns = round(crank_deg / 360.0)
        phi = 360.0 * turns + math.degrees(math.atan2(length * s, length * c - A))
    return Front(phi, advance)
