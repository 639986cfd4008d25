"""Reference values in 50 digits, by formulas that differ from the program's.

The pin is a complex number, and the wheel's angle is its argument. The derivatives follow from the
logarithm in closed form: d/dx log(1 - C) = i g C/(1 - C) with C = g l e^(-i g f). For the coulisse,
d/dx arg(A + E) = Re E/(A + E) with E = e^(i x).
"""

from __future__ import annotations

from functools import cache
from typing import Any

from geneva_cli.errors import GenevaError
from geneva_cli.motion import registry


@cache
def digits() -> Any:
    """mpmath at 50 digits, in a context of its own."""
    try:
        import mpmath
    except ImportError:
        raise GenevaError(
            "errors need mpmath, which is not installed: pip install --group bench"
        ) from None
    context = mpmath.mp.clone()
    context.dps = 50
    return context


def motion(z: int, gearing: str, A: float, x: Any) -> tuple[Any, Any, Any, Any]:
    """Wheel angle, velocity, acceleration and jerk at x radians from mid-motion (exact)."""
    mp = digits()
    g = registry.gearing(gearing).SIGN
    E = mp.expj(x)
    w = E / (A + E)
    w1 = 1j * w * (1 - w)
    w2 = 1j * w1 * (1 - 2 * w)
    f1, f2, f3 = w.real, w1.real, w2.real
    C = g * mp.sin(mp.pi / z) * mp.expj(-g * mp.arg(A + E))
    v = C / (1 - C)
    v1 = -1j * g * v * (1 + v)
    v2 = -1j * g * v1 * (1 + 2 * v)
    p1, p2, p3 = (g * part.real for part in (v, v1, v2))
    return (mp.arg(1 - C), p1 * f1, p2 * f1**2 + p1 * f2, p3 * f1**3 + 3 * p2 * f1 * f2 + p1 * f3)


def half_motion(z: int, gearing: str, A: float) -> Any:
    """Input angle from entry to mid-motion, radians."""
    mp = digits()
    half = mp.pi / 2 - int(registry.gearing(gearing).SIGN) * mp.pi / z
    return half + mp.asin(A * mp.sin(half))


@cache
def acceleration_peak(z: int, gearing: str, A: float) -> Any:
    """Greatest |acceleration| over the motion: the stationary points of a fine scan, and the end.

    The scan is in double precision and even in the crank's angle, by ``formulas``.
    """
    import numpy as np

    from bench.formulas import Proportions, jerk

    mp = digits()
    crank = np.linspace(0.0, np.pi / 2 - registry.gearing(gearing).SIGN * np.pi / z, 401)
    x = crank + np.arcsin(A * np.sin(crank))
    slope = jerk(np, Proportions.of(registry.gearing(gearing).SIGN, z, A), x)
    end = half_motion(z, gearing, A)
    sizes = [abs(motion(z, gearing, A, end)[2])]
    for i in np.flatnonzero(slope[:-1] * slope[1:] < 0.0):
        a, b = mp.mpf(float(x[i])), mp.mpf(float(x[i + 1]))
        root = mp.findroot(lambda t: motion(z, gearing, A, t)[3], (a, b), solver="illinois")
        sizes.append(abs(motion(z, gearing, A, root)[2]))
    return max(sizes)


def relative(value: float, exact: Any) -> float:
    """Relative error of a double."""
    return float(abs(digits().mpf(float(value)) / exact - 1))
