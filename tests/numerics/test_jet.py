"""Jets against numerical Taylor expansion at 100 digits."""

import math

import numpy as np
import pytest
from witness import mp, taylor

from geneva_cli.numerics.jet import Jet, atan2, piecewise, sin_cos, sqrt

ORDER = 5


def sin(x):
    return sin_cos(x)[0]


def cos(x):
    return sin_cos(x)[1]


# name: (with jets, with mpmath)
COMPOSED = {
    "sum": (lambda x: 2.5 + x - 3.0 * x + (1.0 - x), lambda x: mp.mpf(3.5) - 3 * x),
    "product": (lambda x: x * x * (x - 2.0) * 3.0, lambda x: 3 * x * x * (x - 2)),
    "quotient": (lambda x: (x + 1.0) / (x * x + 2.0), lambda x: (x + 1) / (x * x + 2)),
    "number over jet": (lambda x: 3.0 / (x - 4.0), lambda x: 3 / (x - 4)),
    "jet over number": (lambda x: x * x / 3.0, lambda x: x * x / 3),
    "negative": (lambda x: -(x * x), lambda x: -(x * x)),
    "sine": (lambda x: sin(2.0 * x), lambda x: mp.sin(2 * x)),
    "cosine": (lambda x: cos(x * x), lambda x: mp.cos(x * x)),
    "square root": (lambda x: sqrt(x * x + 0.5), lambda x: mp.sqrt(x * x + mp.mpf(0.5))),
    "angle": (
        lambda x: atan2(sin(x) * 0.5, 1.0 - cos(x) * 0.5),
        lambda x: mp.atan2(mp.sin(x) / 2, 1 - mp.cos(x) / 2),
    ),
    "angle behind": (lambda x: atan2(x - 3.0, -1.0 - x * x), lambda x: mp.atan2(x - 3, -1 - x * x)),
    "chain": (
        lambda x: sin(sqrt(cos(x) + 1.5) / (x * x + 1.0)),
        lambda x: mp.sin(mp.sqrt(mp.cos(x) + mp.mpf(1.5)) / (x * x + 1)),
    ),
    "two cranks": (
        lambda x: atan2(sin(atan2(sin(x), cos(x) + 0.6)), 2.0 - cos(atan2(sin(x), cos(x) + 0.6))),
        lambda x: mp.atan2(
            mp.sin(mp.atan2(mp.sin(x), mp.cos(x) + mp.mpf(0.6))),
            2 - mp.cos(mp.atan2(mp.sin(x), mp.cos(x) + mp.mpf(0.6))),
        ),
    ),
}
POINTS = (-1.25, -0.3, 0.0, 0.5, 1.1)


@pytest.mark.parametrize("name", COMPOSED)
def test_derivatives(name):
    ours, theirs = COMPOSED[name]
    for x in POINTS:
        got = ours(Jet.variable(x, ORDER)).derivatives()
        exact = [float(v) for v in taylor(theirs, x, ORDER)]
        scale = 1.0
        for k, (value, true) in enumerate(zip(got, exact, strict=True)):
            # Every recurrence adds up at most k + 1 products; intermediate coefficients here stay
            # below some 10^k/k!, so rounding stays below a few units of the largest so far.
            scale = max(scale, abs(true))
            assert value == pytest.approx(true, rel=0.0, abs=2e-15 * 5.0**k * scale), (x, k)


def pieces():
    return [lambda x: Jet.variable(x, 1) * 2.0, lambda x: Jet.variable(x, 1) + 10.0]


def test_piecewise_gives_a_cut_to_the_piece_before_it():
    assert piecewise(1.0, (1.0,), pieces()).c == (2.0, 2.0)
    assert piecewise(math.nextafter(1.0, 2.0), (1.0,), pieces()).c[1] == 1.0
    x = np.array([3.0, -1.0, 1.0, 1.5])
    value, slope = piecewise(x, (1.0,), pieces()).derivatives()
    assert value.tolist() == [13.0, -2.0, 2.0, 11.5]
    assert (slope * np.ones(4)).tolist() == [1.0, 2.0, 2.0, 1.0]
