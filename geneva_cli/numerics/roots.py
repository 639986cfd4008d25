"""Roots, minima and boundaries in one variable, to the last bit."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from geneva_cli.numerics.arrays import Array, Real, Truth, Whole, all_true, choose
from geneva_cli.numerics.tolerances import TIE

MOST_STEPS = 200  # towards a root, at most; halving reaches the last of 50 digits in 170


def root(
    slope: Callable[[float], tuple[float, float]], a: float, b: float, before: float | None = None
) -> float:
    """The root of ``slope`` (value, derivative) in [a, b], by Newton's method within the bracket.

    ``before`` has the sign just after a, if that differs from the sign at a. The search bisects
    where Newton leaves the bracket or shrinks it too slowly, down to one unit in the last place.
    """
    f_a = slope(a)[0] if before is None else before
    x, step = 0.5 * (a + b), b - a
    for _ in range(MOST_STEPS):
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


def find_roots(f: Callable[[Array, Whole], tuple[Array, Array]], a: Array, b: Array) -> Array:
    """The root of each function in [a, b], where its sign changes: shape (n,), to the last bit.

    ``f(x, which)`` gives value and derivative of the functions ``which`` at x, both (m,). Newton's
    method, within brackets, runs on the functions that are not finished yet only. A function that
    is NaN anywhere has NaN for a result, and disturbs no other.

    >>> import numpy as np
    >>> A = np.array([2.0, 9.0])
    >>> find_roots(lambda x, which: (x * x - A[which], 2.0 * x), 0.0 * A, A)
    array([1.41421356, 3.        ])
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

    ``good`` and ``bad`` are floats, arrays of designs, or Decimals of the current context.
    ``evaluations`` limits their number; the condition holds for the result then too.

    >>> boundary(lambda x: x * x <= 2.0, 1.0, 2.0)
    1.414213562373095
    """
    for _ in range(evaluations):
        middle = (good + bad) / 2
        if all_true((middle == good) | (middle == bad) | (middle != middle)):
            break
        yes = holds(middle)
        good, bad = choose(yes, middle, good), choose(yes, bad, middle)
    return good


def boundary_by_sections(margin: Callable[[Array], Array], good: float, bad: float) -> float:
    """The last number from ``good`` towards ``bad`` at which a margin is positive.

    The margin is evaluated at many numbers at once, most of them near the root of the line through
    the bracket's ends. So four or five calls reach the last bit.

    >>> boundary_by_sections(lambda x: 2.0 - x * x, 1.0, 2.0)
    1.414213562373095
    """
    import numpy as np

    even, close = np.arange(1, 32) / 32, 0.5 ** np.arange(6, 54, 3)
    left, short, root = math.nan, math.nan, 0.5
    for _ in range(MOST_STEPS):
        if math.nextafter(good, bad) == bad:
            break
        fractions = np.sort(np.concatenate((even, root - close, root + close)))
        x = good + (bad - good) * fractions[(fractions > 0.0) & (fractions < 1.0)]
        y = margin(x)
        yes = y > 0.0
        i = len(x) if yes.all() else int(np.argmin(yes))
        ends, margins = [good, *x.tolist(), bad], [left, *y.tolist(), short]
        if (good, bad) == (ends[i], ends[i + 1]):
            break
        (good, bad), (left, short) = ends[i : i + 2], margins[i : i + 2]
        known = math.isfinite(left - short)
        root = left / (left - short) if known else 0.5
    return good


class Falsi:
    """Regula falsi with Illinois halving, for the place where a limit is just kept.

    ``left`` >= 0 is the margin to the limit at ``good``, and ``short`` < 0 that at ``bad``. The
    caller takes the next place from ``middle`` and adds the margin there. If one of the two values
    is infinite, the bracket is halved.
    """

    def __init__(self, good: float, left: float, bad: float, short: float) -> None:
        self.good, self.left, self.bad, self.short = good, left, bad, short
        self._stayed = 0  # times in a row that the good end moved (> 0), or the bad one (< 0)

    def middle(self, margin: float = 0.0) -> float:
        """The next place, at least a fraction ``margin`` of the bracket from either end."""
        known = math.isfinite(self.left) and math.isfinite(self.short)
        fraction = self.left / (self.left - self.short) if known else 0.5
        return self.good + (self.bad - self.good) * min(max(fraction, margin), 1.0 - margin)

    def add(self, x: float, left: float) -> None:
        """Narrow the bracket by the margin at a place in it."""
        if left >= 0.0:
            self.good, self.left, self._stayed = x, left, max(self._stayed, 0) + 1
            self.short *= 0.5 if self._stayed > 1 else 1.0
        else:
            self.bad, self.short, self._stayed = x, left, min(self._stayed, 0) - 1
            self.left *= 0.5 if self._stayed < -1 else 1.0


def greatest_at(candidates: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """The greatest of some values, and the first place whose value equals it apart from rounding.

    >>> greatest_at([(1.0, 10.0), (3.0, 20.0), (3.0000000000000004, 30.0)])
    (3.0000000000000004, 20.0)
    """
    most = max(value for value, _ in candidates)
    bar = most - TIE * abs(most) if math.isfinite(most) else most
    return most, next(place for value, place in candidates if value >= bar)
