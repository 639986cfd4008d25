"""Intervals of doubles hold the values at fifty digits, and never become floats."""

import math
import random

import mpmath
import numpy as np
import pytest
from sampling import some

from geneva_cli.numerics.arrays import library, piece_of
from geneva_cli.numerics.intervals import Interval, Undecided
from geneva_cli.numerics.spline import at_rest

ONE_OF = {
    "sin": mpmath.sin,
    "cos": mpmath.cos,
    "sqrt": lambda x: mpmath.sqrt(abs(x)),
}


def holds(interval, value):
    return mpmath.mpf(float(interval.low)) <= value <= mpmath.mpf(float(interval.high))


def test_a_comparison_is_refused():
    for ask in (lambda x: x < 0.7, lambda x: x >= 0.7, lambda x: x == 0.7, lambda x: x != 0.7):
        with pytest.raises(TypeError):
            ask(Interval(0.5, 1.0))


def test_a_decided_piece_is_answered():
    x = Interval(0.5, 1.0)
    assert x.piece([0.25, 2.0]) == piece_of(0.7, [0.25, 2.0]) == 1
    assert Interval(0.5, math.nextafter(1.0, 2.0)).piece([1.0]) == 0
    with pytest.raises(Undecided):
        x.piece([0.7])


@pytest.mark.long
def test_every_operation_holds_the_exact_values():
    """At the ends, in the middle and at a random place of random intervals."""
    rng = random.Random(1)
    with mpmath.workdps(50):
        for _ in range(some(3000, 500)):
            a, b, c, d = (rng.uniform(-9.0, 9.0) * 10.0 ** -rng.randrange(4) for _ in range(4))
            x, y = Interval(min(a, b), max(a, b)), Interval(min(c, d), max(c, d))
            u, v = mpmath.mpf(rng.uniform(x.low, x.high)), mpmath.mpf(rng.uniform(y.low, y.high))
            assert holds(x + y, u + v) and holds(x - y, u - v) and holds(x * y, u * v)
            assert holds(x * x, u * u) and holds(x**3, u**3) and holds(abs(x), abs(u))
            assert holds(2.0 - x, 2 - u) and holds(x / y, u / v) and holds(1.0 / y, 1 / v)
            for name, exact in ONE_OF.items():
                of = abs(x) if name == "sqrt" else x
                assert holds(getattr(library(x), name)(of), exact(u)), name
            assert holds(library(x).hypot(x, y), mpmath.sqrt(u * u + v * v))


@pytest.mark.parametrize(("middle", "answers"), [(0.9, [0.0, math.nan, 0.0]), (1.05, [1, 2, 2])])
def test_each_interval_has_its_own_answer(middle, answers):
    x = Interval(np.array([0.5, middle, 1.2]), np.array([0.9, 1.1, 1.5]))
    with pytest.raises(Undecided) as refused:
        x.piece([0.25, 1.0])
    np.testing.assert_equal(refused.value.answers, answers)


def test_intervals_in_several_pieces_of_a_spline_are_evaluated_together():
    """Each has the bounds that it has alone, where the spline is one polynomial."""
    x = [0.0, 0.2, 0.5, 0.7, 1.0]
    spline = at_rest(x, [u**4 * (35.0 - u * (84.0 - u * (70.0 - 20.0 * u))) for u in x])
    ends = np.array([[0.0, 0.2, 0.55, 0.71], [0.1, 0.5, 0.7, 0.99]])
    together = spline(Interval(*ends), 3)
    for k, (low, high) in enumerate(ends.T.tolist()):
        for whole, alone in zip(together, spline(Interval(low, high), 3), strict=True):
            assert (whole.low[k], whole.high[k]) == (alone.low, alone.high)
