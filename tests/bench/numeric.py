"""Ways in which scripts compute a peak: grids, parabolas, SciPy, closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from bench.formulas import Proportions, acceleration, jerk


def size_at(d: Proportions, x: float) -> float:
    """Size of the acceleration at one input angle, radians."""
    return abs(float(acceleration(math, d, x)))


def slope_at(d: Proportions, x: float) -> float:
    """Signed slope of the acceleration at one input angle, radians."""
    return float(jerk(math, d, x))


def grid(d: Proportions, n: int) -> float:
    """Greatest of n even points."""
    return float(np.abs(acceleration(np, d, np.linspace(0.0, d.half, n))).max())


def vertex(below: Any, middle: Any, above: Any) -> Any:
    """Greatest value of the parabola through three even points around a greatest one."""
    return middle + (above - below) ** 2 / (8.0 * (2.0 * middle - below - above))


def parabola(d: Proportions, n: int) -> float:
    """Greatest of n even points, refined by a parabola through it and its neighbours."""
    size = np.abs(acceleration(np, d, np.linspace(0.0, d.half, n)))
    i = int(size.argmax())
    if i in (0, n - 1):
        return float(size[i])
    return float(vertex(size[i - 1], size[i], size[i + 1]))


def bounded(d: Proportions, tolerance: float) -> float:
    """Peak by SciPy's bounded minimiser, or the value at the end."""
    from scipy.optimize import minimize_scalar

    minimum = minimize_scalar(
        lambda x: -size_at(d, x),
        bounds=(0.0, d.half),
        method="bounded",
        options={"xatol": tolerance},
    )
    return max(-float(minimum.fun), size_at(d, d.half))


def brentq(d: Proportions, tolerance: float, scan: int = 17) -> float:
    """Peak by SciPy's brentq on the slope between the points of a scan, or the value at the end."""
    from scipy.optimize import brentq as solve

    x = [d.half * i / (scan - 1) for i in range(scan)]
    slopes = [slope_at(d, t) for t in x]
    best = size_at(d, d.half)
    for i in range(scan - 1):
        if slopes[i] * slopes[i + 1] < 0.0:
            root = solve(partial(slope_at, d), x[i], x[i + 1], xtol=tolerance)
            best = max(best, size_at(d, root))
    return best


def colleague(d: Proportions, degree: int) -> float:
    """Peak from a Chebyshev series of the slope, with roots from the colleague matrix."""
    from numpy.polynomial import chebyshev

    series = chebyshev.chebinterpolate(lambda t: jerk(np, d, 0.5 * d.half * (1.0 + t)), degree)
    roots = chebyshev.chebroots(series)
    real = roots.real[(abs(roots.imag) < 1e-8) & (abs(roots.real) <= 1.0)]
    places = [*(0.5 * d.half * (1.0 + real)), d.half]
    return max(size_at(d, float(x)) for x in places)


def by_chebpy(d: Proportions) -> float:
    """Peak by Chebpy: the acceleration as a Chebyshev series, and the roots of its derivative."""
    from chebpy import chebfun

    series = chebfun(lambda x: acceleration(np, d, x), [0.0, d.half])
    return max(size_at(d, float(x)) for x in (*series.diff().roots(), d.half))


def closed(d: Proportions) -> tuple[float, float]:
    """Peak and its angle for A = 0 outside, in the textbook form.

    cos a* = sqrt(q² + 2) - q, q = (1 + l²)/(4 l). The angle is included since ours returns it too.
    """
    l = d.l
    q = (1.0 + l * l) / (4.0 * l)
    cosine = math.sqrt(q * q + 2.0) - q
    D = 1.0 - 2.0 * l * cosine + l * l
    size = l * (1.0 - l * l) * math.sqrt(1.0 - cosine * cosine) / (D * D)
    return size, math.degrees(math.acos(cosine))


class Numeric(NamedTuple):
    """A method for single designs, and the sizes that are measured."""

    name: str
    run: Callable[[Proportions, Any], float]
    sizes: tuple[float, ...]


# The registry of methods, also for ``many``.
NUMERIC = (
    Numeric("grid", grid, (11, 101, 1001, 10001)),
    Numeric("grid + parabola", parabola, (11, 33, 101, 1001)),
    Numeric("SciPy bounded, xatol", bounded, (1e-3, 1e-5, 1e-9)),
    Numeric("scan of 17 + SciPy brentq, xtol", brentq, (1e-3, 1e-6, 1e-12)),
    Numeric("Chebyshev colleague roots, degree", colleague, (8, 16, 32, 64)),
)
