"""The strict ball: no float comes of it, and no open comparison has an answer."""

import math

import mpmath
import numpy as np
import pytest
from flint import ctx

from geneva_cli.extras.certify.balls import Ball
from geneva_cli.extras.certify.enclosures import greatest
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import library
from geneva_cli.numerics.intervals import Undecided
from geneva_cli.numerics.jet import Jet, atan2, sin_cos, sqrt


@pytest.mark.parametrize(
    "ask",
    [
        lambda x: x < 0.7,
        lambda x: x > 0.7,
        lambda x: x == 0.7,
        lambda x: x < Ball.between(0.9, 2.0),
        lambda x: library(x).copysign(1.0, x - 0.7),
        lambda x: x.piece([0.7]),
    ],
)
def test_an_open_comparison_is_refused(ask):
    with pytest.raises(Undecided):
        ask(Ball.between(0.5, 1.0))


def test_formulas_of_balls_hold_those_at_fifty_digits():
    """Each coefficient of a composed jet, at both ends and in the middle of the ball."""

    def formula(x):
        s, c = sin_cos(x)
        return sqrt(x * x + 0.5) / (c + 2.0) - atan2(s * 0.5, 1.0 - c * 0.5) * 3.0

    def exact(x):
        s, c = mpmath.sin(x), mpmath.cos(x)
        return mpmath.sqrt(x * x + 0.5) / (c + 2) - 3 * mpmath.atan2(s / 2, 1 - c / 2)

    with ctx.workprec(128), mpmath.workdps(50):
        jet = formula(Jet.variable(Ball.between(0.7, 0.7001), 4))
        for at in (0.7, 0.70003, 0.7001):
            for ball, c in zip(jet.c, mpmath.taylor(exact, mpmath.mpf(at), 4), strict=True):
                low, high = ball.bounds()
                assert low <= c <= high


def wave(x, order):
    """|sin 3x| has the size 1 at three places of 0 to 180 degrees."""
    return sin_cos(Jet.variable(radians(x), order) * 3.0)[0]


def test_the_greatest_size_and_all_its_places():
    with ctx.workprec(128):
        found = greatest([(wave, (0.0, 180.0))], 200)
    assert found.open is None
    assert found.low <= 1.0 <= found.high
    assert found.high - found.low <= 4e-16  # a unit in the last place to either side
    middles = [0.5 * (place.start + place.end) for place in found.places]
    assert middles == pytest.approx([30.0, 90.0, 150.0], abs=1e-10)


def test_a_curve_without_bounds_is_left_open():
    """1/(x - 1): its size has no bound at 1, and an interval about 1 stays open."""

    def pole(x, order):
        return 1.0 / (Jet.variable(x, order) - 1.0)

    with ctx.workprec(128):
        found = greatest([(pole, (0.0, 3.0))], 500)
    assert found.open is not None
    assert found.open.start <= 1.0 <= found.open.end
    assert found.high == math.inf


@pytest.mark.parametrize(
    "take", [float, bool, int, round, math.sin, math.floor, np.sin, np.float64]
)
def test_no_float_comes_of_a_ball(take):
    with pytest.raises(TypeError):
        take(Ball.between(0.5, 1.0))
