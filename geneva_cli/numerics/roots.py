"""Roots, minima and boundaries in one variable, to the last bit."""

import math
from collections.abc import Callable, Sequence

from geneva_cli.numerics.arrays import Array, Real, Truth, Whole, all_true, choose
from geneva_cli.numerics.tolerances import TIE

MOST_STEPS = 200  # towards a root, at most; halving reaches the last digit in 60


def find_roots(f: Callable[[Array, Whole], tuple[Array, Array]], a: Array, b: Array) -> Array:
    """The root of each function in [a, b], where its sign changes: shape (n,), to the last bit.

    ``f(x, which)`` gives value and derivative of the functions ``which`` at x, both (m,). Newton's
    method, within brackets, runs on the functions that are not finished yet only. A function that
    is NaN anywhere has NaN for a result, and disturbs no other.
    """
    import numpy as np

    live, out = np.arange(len(a)), 0.5 * (a + b)
    with np.errstate(all="ignore"):
        x, step, rising = out.copy(), b - a, f(a, live)[0] < 0.0
        for _ in range(MOST_STEPS):
            if not len(live):
                break
            value, slope = f(x, live)
            left = (value < 0.0) == rising
            a, b = np.where(left, x, a), np.where(left, b, x)
            new = x - value / slope
            inside = ((a < new) & (new < b) | (new == x)) & (abs(new - x) < 0.5 * abs(step))
            new = np.where(inside, new, 0.5 * (a + b))
            new = np.where(value == 0.0, x, np.where(np.isnan(value), value, new))
            out[live], step = new, new - x
            short = inside & (abs(step) <= 2.0 * np.spacing(abs(x)))
            open_ = ~(short | (new == x) | (new == a) | (new == b) | np.isnan(new))
            live, a, b, x = live[open_], a[open_], b[open_], new[open_]
            rising, step = rising[open_], step[open_]
    return out


def boundary(
    holds: Callable[[Real], Truth], good: Real, bad: Real, evaluations: int = MOST_STEPS
) -> Real:
    """The last number from ``good`` towards ``bad`` for which a condition holds, by halving.

    ``good`` and ``bad`` are floats, or arrays of designs.
    ``evaluations`` limits their number; the condition holds for the result then too.
    """
    for _ in range(evaluations):
        middle = (good + bad) / 2
        if all_true((middle == good) | (middle == bad) | (middle != middle)):
            break
        yes = holds(middle)
        good, bad = choose(yes, middle, good), choose(yes, bad, middle)
    return good


def boundary_by_sections(margin: Callable[[Array], Array], good: float, bad: float) -> float:
    """The last number from ``good`` towards ``bad`` at which a margin is positive."""
    import numpy as np

    fractions = np.arange(1, 64) / 64
    for _ in range(MOST_STEPS):
        x = good + (bad - good) * fractions
        ends, holds = [good, *x.tolist(), bad], margin(x) > 0.0
        first = len(x) if holds.all() else int(np.argmin(holds))
        if [good, bad] == ends[first : first + 2]:
            break
        good, bad = ends[first : first + 2]
    return good


def greatest_at(candidates: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """The greatest of some values, and the first place that has it apart from rounding."""
    most = max(value for value, _ in candidates)
    bar = most - TIE * abs(most) if math.isfinite(most) else most
    return most, next(place for value, place in candidates if value >= bar)
