"""Loops over side-cranks and over angles, number by number, as one would write them for Numba.

The formulas of side-cranks are those of a handbook, over the crank's angle f from mid-motion, v = 1
- cos f. An internal wheel has a negative l. With C and rho of the side-crank and D of the wheel,
the velocity is l (c - l)/D C/rho, and the acceleration is -l sin f (u - (c - l) w). The wheel's
term is u, that of the crank's changing speed w. The slope is scanned for sign changes, and each is
refined by secants inside its bracket.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array


def looped(compiled: Callable[[Any], Any]) -> Callable[[Array, Array, Array, Array], None]:
    """Return the loop from sign, l and A of designs to the size of their peaks.

    ``compiled`` turns a function into a faster one, as ``numba.njit`` does, or returns it
    unchanged.
    """
    terms = compiled(_terms)
    peak = _peak(compiled, terms, _root(compiled, terms))

    def loop(sign: Array, l: Array, A: Array, out: Array) -> None:
        for i in range(len(out)):
            out[i] = peak(sign[i] * l[i], A[i])

    fast: Callable[[Array, Array, Array, Array], None] = compiled(loop)
    return fast


@cache
def by_numba(loop: Callable[[Callable[[Any], Any]], Any]) -> Any:
    """Return one of the loops, compiled by Numba."""
    import numba

    return loop(numba.njit)


def motion_loop(compiled: Callable[[Any], Any]) -> Callable[[float, Array, Array, Array], None]:
    """Return the loop from l and angles to velocity and acceleration of a plain wheel."""

    def loop(l: float, x: Array, velocity: Array, acceleration: Array) -> None:
        rest = 1.0 - l
        k = l * rest * (1.0 + l)
        for i in range(len(x)):
            h, g = math.sin(0.5 * x[i]), math.cos(0.5 * x[i])
            v = 2.0 * h * h
            D = rest * rest + 2.0 * l * v
            velocity[i] = l * (rest - v) / D
            acceleration[i] = -2.0 * k * h * g / (D * D)

    fast: Callable[[float, Array, Array, Array], None] = compiled(loop)
    return fast


def _terms(l: float, A: float, s: float, c: float, v: float) -> tuple[float, float]:
    """Size of the acceleration, and its slope up to a factor, for sine s and cosine c."""
    K = (1.0 - A) * (1.0 + A)
    C = math.sqrt(c * c + K * s * s)
    rho = C + A * c if A * c > 0.0 else K / (C - A * c)
    D = (1.0 - l) * (1.0 - l) + 2.0 * l * v
    u = (1.0 - l) * (1.0 + l) * C * C / (D * D * rho * rho)
    w = A * K / (D * rho * rho * rho)
    turn = -A * A * s * c / C
    apart, drawn = 2.0 * l * s / D, (turn - A * s) / rho
    slope = 2.0 * u * (turn / C - apart - drawn) + w * (s + (c - l) * (apart + 3.0 * drawn))
    size = u - w * (c - l)
    return abs(l * s * size), c * size + s * slope


def _root(compiled: Callable[[Any], Any], terms: Any) -> Any:
    def root(l: float, A: float, low: float, high: float, below: float, above: float) -> float:
        last, value = low, below
        x = low + (high - low) * below / (below - above)
        for _ in range(40):  # secants in a bracket, at most
            here = terms(l, A, math.sin(x), math.cos(x), 1.0 - math.cos(x))[1]
            if here * below > 0.0:
                low = x
            else:
                high = x
            new = x - here * (x - last) / (here - value) if here != value else low
            if not low < new < high:
                new = 0.5 * (low + high)
            last, value = x, here
            # nearer than 1e-7 radians the peak is flat: its value is exact to the last digit
            if abs(new - x) < 1e-7:
                return new
            x = new
        return x

    return compiled(root)


def _peak(compiled: Callable[[Any], Any], terms: Any, root: Any) -> Any:
    def peak(l: float, A: float) -> float:
        intervals = 10
        step = math.acos(l) / intervals
        best: float = terms(l, A, math.sqrt((1.0 - l) * (1.0 + l)), l, 1.0 - l)[0]
        turn = 2.0 * math.cos(step)
        c, following = 1.0, 0.5 * turn
        before = terms(l, A, 0.0, 1.0, 0.0)[1]
        for i in range(intervals):
            c, following = following, turn * following - c
            here = terms(l, A, math.sqrt((1.0 - c) * (1.0 + c)), c, 1.0 - c)[1]
            if before * here < 0.0:
                x = root(l, A, i * step, (i + 1) * step, before, here)
                half_sine = math.sin(0.5 * x)
                v = 2.0 * half_sine * half_sine
                best = max(best, terms(l, A, math.sin(x), 1.0 - v, v)[0])
            before = here
        return best

    return compiled(peak)
