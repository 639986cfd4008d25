"""Extrema of a smooth function on an interval: scan, bracket, refine to the last bit."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from geneva_cli.numerics.budget import ask

# x -> value, first derivative, second derivative
Curve: TypeAlias = Callable[[float], tuple[float, float, float]]
_Sample: TypeAlias = tuple[float, float, float]

SCAN = 16  # intervals of the first scan
DEEPEST = 50  # halvings of one of them: a feature 2**-50 of the interval wide is still seen
PREDICTED = 1e-2  # share of the range by which a cubic may miss the middle of its interval
TIE = 1e-13  # peaks whose sizes differ by a smaller share are one peak that occurs twice


def root(
    slope: Callable[[float], tuple[float, float]], a: float, b: float, before: float | None = None
) -> float:
    """Where ``slope`` (value, derivative) changes sign in [a, b]: Newton, kept in the bracket.

    ``before`` has the sign just after a, where it is not that at a.

    Falls back on bisection wherever Newton leaves the bracket or shrinks it too slowly, so at
    most about a hundred steps, and stops where the bracket or the step is one unit in the last
    place.
    """
    f_a = slope(a)[0] if before is None else before
    x, step = 0.5 * (a + b), b - a
    for _ in range(200):
        f, d = slope(x)
        if f == 0.0:
            return x
        if (f > 0.0) == (f_a > 0.0):
            a = x
        else:
            b = x
        newton = x - f / d if d else a
        inside = min(a, b) < newton < max(a, b)
        new = newton if inside and abs(newton - x) < 0.5 * abs(step) else 0.5 * (a + b)
        step = new - x
        if new in (x, a, b):
            return new
        x = new
    return x


def extrema(f: Curve, a: float, b: float) -> list[float]:
    """All stationary points of f inside [a, b], in order.

    The scan is refined wherever the cubic through two neighbours' values and slopes does not
    predict the value midway, level by level, so that a narrow peak is not stepped over and the
    measure of what counts grows with the peaks that come to light.
    """
    knots = [a + (b - a) * i / SCAN for i in range(SCAN)] + [b]
    samples: list[_Sample] = [(x, *f(x)[:2]) for x in knots]
    low = min(v for _, v, _ in samples)
    high = max(v for _, v, _ in samples)
    open_ = list(zip(samples, samples[1:], strict=False))
    settled: list[tuple[_Sample, _Sample]] = []
    for _ in range(DEEPEST):
        ask()
        halves = []
        for left, right in open_:
            x = 0.5 * (left[0] + right[0])
            middle = (x, *f(x)[:2])
            low, high = min(low, middle[1]), max(high, middle[1])
            halves.append((left, middle, right))
        open_ = []
        for left, middle, right in halves:
            width = right[0] - left[0]
            predicted = 0.5 * (left[1] + right[1]) + width * (left[2] - right[2]) / 8.0
            missed = abs(middle[1] - predicted) > PREDICTED * (high - low)
            (open_ if missed else settled).extend(((left, middle), (middle, right)))
    found = []
    for (p, _, d_p), (q, _, d_q) in sorted(settled + open_):
        # A stationary neighbour may hide another: the slope beside it has its bend's sign.
        before, after = d_p or f(p)[2], d_q or -f(q)[2]
        if before * after < 0.0:
            found.append(root(_without(f, p, d_p, q, d_q), p, q, before))
        if d_q == 0.0:
            found.append(q)
    return found


def _without(
    f: Curve, p: float, d_p: float, q: float, d_q: float
) -> Callable[[float], tuple[float, float]]:
    """The slope of f; where it is zero at p or q, as if that root had been divided out of it."""
    if d_p and d_q:
        return lambda x: f(x)[1:]

    def slope(x: float) -> tuple[float, float]:
        _, s, bend = f(x)
        if not d_p:
            bend -= s / (x - p)
        if not d_q:
            bend += s / (q - x)
        return s, bend

    return slope
