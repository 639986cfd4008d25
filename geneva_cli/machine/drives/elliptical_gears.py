"""Two equal elliptical gears, each turning about a focus, in front of the crank.

With the driver at phi the driven gear, which carries the crank, is at f:
tan(f/2) = (1-e)/(1+e) tan(phi/2), slowest at 0. The half angles' directions are
(cos phi/2, sin phi/2) and ((1+e) cos phi/2, (1-e) sin phi/2).

Source: the focal property of the ellipse; the same law is Kepler's true anomaly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, NamedTuple

from geneva_cli.machine.drives import Front
from geneva_cli.numerics.angles import sin_cos_deg
from geneva_cli.numerics.jet import Coefficient, Jet, library, sine_versine_of
from geneva_cli.spec.rules import OneOf, Range
from geneva_cli.spec.tables import Spec


class Keys(NamedTuple):
    """The keys that ``kind = "elliptical-gears"`` adds."""

    eccentricity: Annotated[float, Range(0.0, 1.0, "[)"), "of the gears' pitch ellipses"]
    phase: Annotated[str, OneOf(("slow", "quick")), "which index is at mid-motion"] = "slow"


def front(spec: Spec) -> Callable[[float], Front]:
    """Front about a crank angle f in degrees."""
    keys = spec.kind
    assert isinstance(keys, Keys)
    e = keys.eccentricity if keys.phase == "slow" else -keys.eccentricity
    return lambda crank_deg: _about(e, crank_deg)


def _about(e: float, crank_deg: float) -> Front:
    sin_h, cos_h = sin_cos_deg(0.5 * crank_deg)
    # The driver's half angle there, and W = 1 + e² + 2 e cos phi as a sum of positive terms.
    a, b = (1.0 + e) * sin_h, (1.0 - e) * cos_h
    size = math.hypot(a, b)
    sin_p, cos_p = a / size, b / size
    least = (1.0 - e) * (1.0 + e)

    def advance(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
        m = library(tau)
        s, c = m.sin(0.5 * tau), m.cos(0.5 * tau)
        # Half angles: the driver's direction, and the driven gear's against its own at f.
        sine, cosine = sin_p * c + cos_p * s, cos_p * c - sin_p * s
        across = size * size * s
        along = least * c - 4.0 * e * sin_h * cos_h * s
        x, y = along * along - across * across, 2.0 * along * across
        W = ((1.0 + e) * cosine) ** 2 + ((1.0 - e) * sine) ** 2
        sin_phi, cos_phi = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
        turns = (cos_phi, -sin_phi, -0.5 * cos_phi, sin_phi / 6.0, cos_phi / 24.0)[: max(order, 1)]
        rate = least / Jet((W, *[2.0 * e * t for t in turns[1:]]))
        return sine_versine_of(rate, y, x, order)

    phi = 2.0 * math.degrees(math.atan2(a, b))
    phi += 720.0 * round((crank_deg - phi) / 720.0)  # half angles come round every two turns
    return Front(phi, advance)
