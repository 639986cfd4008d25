"""Sines of exact fractions of pi are correctly rounded; angles and speeds."""

import math
from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st
from witness import mp, near

from geneva_cli.numerics.angles import omega, radians, sin_cos_deg, sin_cos_pi


def rounded(p, q):
    """The doubles nearest to sin and cos of pi p/q: mpmath rounds to nearest at 50 digits."""
    x = mp.mpf(p) / q
    return float(mp.sinpi(x)), float(mp.cospi(x))


def test_every_fraction_of_a_turn():
    for q in (*range(1, 61), 97, 100, 360, 1000, 999_983, 1_000_000):
        step = max(1, 4 * q // 97)
        for p in range(-2 * q, 2 * q + 1, step):
            assert sin_cos_pi(p, q) == rounded(p, q), (p, q)


@settings(max_examples=100)
@given(st.floats(-720.0, 720.0).filter(lambda d: d == 0.0 or abs(d) > 1e-6))
def test_degrees_are_taken_as_exact(deg):
    exact = Fraction(deg) / 180
    with mp.workdps(80):
        s, c = rounded(exact.numerator, exact.denominator)
    assert sin_cos_deg(deg) == (s, c)


def test_degrees_and_speeds():
    assert radians(180.0) == math.pi
    assert omega(60.0) == near(2.0 * math.pi, 3e-16)
    assert sin_cos_deg(30.0)[0] == 0.5
    assert sin_cos_deg(90.0) == (1.0, 0.0)
