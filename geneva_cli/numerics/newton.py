"""Roots of many functions, one for each design of a batch.

Newton's method, within brackets, runs on the designs that are not finished yet only. A design that
is NaN anywhere has NaN for a result, and disturbs no other.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.numerics.roots import MOST_STEPS


class Brackets(NamedTuple):
    """Ends of intervals and the functions' values there, NaN where unknown."""

    a: Array
    b: Array
    at_a: Array
    at_b: Array


def find_roots(
    slope: Callable[[Array, Whole], tuple[Array, Array]], a: Array, b: Array, close: float = 0.0
) -> Array:
    """The root of each function in [a, b], where its sign changes: shape (n,), to the last bit.

    ``slope(x, which)`` gives value and derivative of the functions ``which`` at x, both (m,). A
    Newton step shorter than ``close`` times the bracket is the last one.

    >>> A = np.array([2.0, 9.0])
    >>> find_roots(lambda x, which: (x * x - A[which], 2.0 * x), 0.0 * A, A)
    array([1.41421356, 3.        ])
    """
    if not len(a):
        return a.copy()
    with np.errstate(all="ignore"):
        every = np.arange(len(a))
        rising = slope(a, every)[0] < 0.0
        ends = Brackets(a, b, *np.full((2, len(a)), np.nan))
        return newton_roots(slope, ends, 0.5 * (a + b), rising, close)[0]


def newton_roots(
    f: Callable[[Array, Whole], tuple[Array, ...]],
    brackets: Brackets,
    x: Array,
    rising: Mask,
    close: float,
) -> tuple[Array, Array, list[Array]]:
    """Roots in brackets from x on, gains of f's integral in the last steps, and f before.

    ``f`` begins with value and slope. Newton steps are corrected by the values at the bracket's
    ends. A bracket is finished after a step of ``close`` times its width, or of two units in the
    last place; finished ones drop out.
    """
    out, rises, live = x.copy(), np.zeros(len(x)), np.arange(len(x))
    last: list[Array] = []
    a, b, f_a, f_b = brackets
    near, step = close * (b - a), b - a
    for _ in range(MOST_STEPS):
        values = f(x, live)
        if not last:
            last = [v.copy() for v in values]
        for all_, some in zip(last, values, strict=True):
            all_[live] = some
        value, slope = values[:2]
        bent, rise = _bent_step(value, slope, (a - x, f_a), (b - x, f_b))
        left = (value < 0.0) == rising
        a, b = np.where(left, x, a), np.where(left, b, x)
        f_a, f_b = np.where(left, value, f_a), np.where(left, f_b, value)
        new = x + bent
        newton = ((a < new) & (new < b) | (new == x)) & (np.abs(bent) < 0.5 * np.abs(step))
        new = np.where(newton, new, 0.5 * (a + b))
        new = np.where(value == 0.0, x, np.where(np.isnan(value), value, new))
        step = new - x
        out[live], rises[live] = new, np.where(newton, rise, 0.5 * value * step)
        short = np.abs(step) <= np.maximum(near, 2.0 * np.spacing(np.abs(x)))
        open_ = ~((newton & short) | (new == x) | (new == a) | (new == b) | np.isnan(new))
        if not open_.any():
            break
        live, a, b, x = live[open_], a[open_], b[open_], new[open_]
        rising, near, step = rising[open_], near[open_], step[open_]
        f_a, f_b = f_a[open_], f_b[open_]
    return out, rises, last


def nearer(value: Array, slope: Array, brackets: Brackets, x: Array) -> Array:
    """x after one step of ``newton_roots``; unchanged if that step leaves its bracket."""
    a, b, f_a, f_b = brackets
    new = x + _bent_step(value, slope, (a - x, f_a), (b - x, f_b))[0]
    inside: Array = np.where((a < new) & (new < b), new, x)
    return inside


def _bent_step(
    f: Array, slope: Array, one: tuple[Array, Array], two: tuple[Array, Array]
) -> tuple[Array, Array]:
    """The step to the root of a cubic through two values, a third value and its slope.

    Also returns the cubic's integral over the step. It is Newton's step where one of the two values
    is unknown. The error of Newton's step is quadratic. This one's also has the bracket's third
    power, which saves one step in the brackets of a scan.
    """
    (s, f_s), (t, f_t) = one, two
    p, q = (f_s - f - slope * s) / (s * s), (f_t - f - slope * t) / (t * t)
    cubic = (q - p) / (t - s)
    square = p - cubic * s
    newton = -f / slope
    # one Newton step on the cubic, whose first two terms are 0 there
    more = newton * newton * (square + newton * cubic)
    step = newton - more / (slope + newton * (2.0 * square + 3.0 * newton * cubic))
    plain = ~np.isfinite(step)
    step = np.where(plain, newton, step)
    bend = np.where(plain, 0.0, square / 3.0 + step * cubic / 4.0)
    return step, step * (f + step * (0.5 * slope + step * bend))
