"""Side-crank drive (Whitworth's crank and rotating coulisse) in front of the crank.

An input crank of length r turns about an axis that stands the base offset a away from the
coulisse's; the coulisse carries the Geneva crank. A = a/r. With the input at phi the coulisse
points along the vector (A + cos phi, sin phi), whose angle is f.

Source: theory of the quick-return coulisse; the symbols A and f follow Polyudov and Kandyak,
"Kinematics of the Maltese cross mechanism with a side-crank drive".
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, NamedTuple

from geneva_cli.drives import Front
from geneva_cli.jet import Jet, atan2, sin_cos
from geneva_cli.rules import Range
from geneva_cli.units import sin_cos_deg


class Keys(NamedTuple):
    """The keys that ``kind = "side-crank"`` adds."""

    A: Annotated[
        float, Range(-1.0, 1.0, "()"), "side-crank: base offset / crank length; > 0 is slower"
    ]


def front(keys: Keys) -> Callable[[float], Front]:
    """Front about a crank (coulisse) angle f in degrees."""
    return lambda crank_deg: _about(keys.A, crank_deg)


def _about(A: float, crank_deg: float) -> Front:
    s, c = sin_cos_deg(crank_deg)
    # h = asin(A sin f) is the angle between input crank and coulisse. Its cosine, and the
    # coulisse's length cos h + A cos f, are written as sums of positive terms for A near +-1.
    sin_h = A * s
    cos_h = math.hypot(c, s * math.sqrt((1.0 - A) * (1.0 + A)))
    long = cos_h + abs(A * c)
    short = (1.0 - A) * (1.0 + A) / long
    length, rest = (long, short) if A * c > 0.0 else (short, long)

    def advance(tau: Jet) -> Jet:
        sin_t, cos_t = sin_cos(tau * 0.5)
        # The coulisse's vector in the frame of its own direction at f.
        x = cos_t * cos_t * length - sin_t * cos_t * (2.0 * sin_h) - sin_t * sin_t * rest
        y = sin_t * (cos_t * cos_h - sin_t * sin_h) * 2.0
        return atan2(y, x)

    return Front(crank_deg + math.degrees(math.atan2(sin_h, cos_h)), advance)
