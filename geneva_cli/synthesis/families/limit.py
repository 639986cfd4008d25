"""The least A or eccentricity that reduces a wheel's peak acceleration to a limit.

With f the crank's angle from mid-motion and f1(f) the drive's ratio, the wheel's acceleration is

    G2(f) f1² + G1(f) f1 df1/df

with G the plain wheel. As functions of f, not of the input angle, both drives have short forms,
which are smooth even for ratios near their limits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeAlias

from geneva_cli.kinematics.wheels.classic import gap, half_motion_deg
from geneva_cli.kinematics.wheels.gearing import Gearing
from geneva_cli.numerics.angles import DEGREE, sin_cos_pi
from geneva_cli.numerics.roots import Falsi, least
from geneva_cli.synthesis.families.closed import PARAMETER_MAX

# parameter, sin f, cos f -> f1 and f2, the second derivative of f by the input angle
Ratio: TypeAlias = Callable[[float, float, float], tuple[float, float]]
Peak: TypeAlias = Callable[[float], float]

# sizes of the parameter in the search from the plain crank on
PARAMETERS = (*(0.05 * i for i in range(20)), 0.98, 0.99, 0.999, PARAMETER_MAX)


def side_crank(A: float, s: float, c: float) -> tuple[float, float]:
    """Side-crank: f1 = C/rho, f2 = A (1-A²) sin f / rho³, C² = 1 - A² sin² f, rho = C + A cos f."""
    minus = (1.0 - A) * (1.0 + A)
    C, Ac = math.sqrt(c * c + minus * s * s), A * c
    rho = C + Ac if Ac > 0.0 else minus / (C - Ac)
    return C / rho, A * minus * s / rho**3


def elliptical_gears(e: float, s: float, c: float) -> tuple[float, float]:
    """Equal ellipses: f1 = (1 - 2 e cos f + e²)/(1-e²), e < 0 in the quick phase."""
    minus = (1.0 - e) * (1.0 + e)
    toward = 2.0 * e * (1.0 - c) if e > 0.0 else -2.0 * e * (1.0 + c)
    f1 = ((1.0 - abs(e)) ** 2 + toward) / minus
    return f1, f1 * 2.0 * e * s / minus


def peak_of(wheel: Gearing, ratio: Ratio) -> Peak:
    """The greatest size of the acceleration (invariant) as a function of the drive's parameter."""
    z, sign = wheel.z, wheel.SIGN
    l, _ = sin_cos_pi(1, z)
    half = half_motion_deg(sign, 1, z) * DEGREE
    rest = gap(1.0, 1, z)

    def size(x: float, f: float) -> float:
        sine, cosine = math.sin(0.5 * f), math.cos(0.5 * f)
        s, c = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
        near = sine if sign > 0.0 else cosine
        D = rest * rest + 4.0 * l * near * near
        f1, f2 = ratio(x, s, c)
        return abs(l * (c - sign * l) / D * f2 - l * rest * (1.0 + l) * s / (D * D) * f1 * f1)

    def peak(x: float) -> float:
        count = 64  # intervals of the scan
        places = [half * i / count for i in range(count + 1)]
        values = [size(x, f) for f in places]
        best = values[-1]
        for i in range(1, count):
            if values[i] >= values[i - 1] and values[i] >= values[i + 1]:
                low, high = places[i - 1], places[i + 1]
                best = max(best, -least(lambda f: -size(x, f), low, high)[1])
        return best

    return peak


def least_parameter(peak: Peak, limit: float) -> tuple[float | None, float]:
    """The parameter of least size with peak <= limit, and the lowest peak met in the search.

    The plain crank (parameter 0) is above the limit. The search goes from it to either side while
    the peak decreases; None if the peak increases again before it reaches the limit.
    """
    parameter, lowest = None, math.inf
    for side in (1.0, -1.0):
        x, low = _walk(lambda t, side=side: peak(side * t), limit)  # type: ignore[misc]
        lowest = min(lowest, low)
        if x is not None and (parameter is None or x < abs(parameter)):
            parameter = side * x
    return parameter, lowest


def _walk(peak: Peak, limit: float) -> tuple[float | None, float]:
    values = [peak(0.0)]
    for i in range(1, len(PARAMETERS)):
        values.append(peak(PARAMETERS[i]))
        if values[i] <= limit:
            return _crossing(peak, limit, PARAMETERS[i - 1], PARAMETERS[i]), values[i]
        if values[i] > values[i - 1]:
            back = max(i - 2, 0)
            x, low = least(peak, PARAMETERS[back], PARAMETERS[i])
            return (_crossing(peak, limit, PARAMETERS[back], x) if low <= limit else None), low
    return None, values[-1]


def _crossing(peak: Peak, limit: float, above: float, below: float) -> float:
    """The parameter at which the peak reaches the limit, from below."""
    bracket = Falsi(below, limit - peak(below), above, limit - peak(above))
    while abs(bracket.bad - bracket.good) > 1e-13 and bracket.left > 0.0:  # of the parameter
        x = bracket.middle()
        if x in (bracket.good, bracket.bad):
            break
        bracket.add(x, limit - peak(x))
    return bracket.good
