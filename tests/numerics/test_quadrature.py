"""Integrals with roots at their ends, and the sine over its angle with its derivatives."""

import math

import numpy as np
import pytest

from geneva_cli.motion.given_motion import _sinc
from geneva_cli.numerics.jet import Jet
from geneva_cli.numerics.quadrature import lobatto, rule, span_integrals

CLOSED = {  # over 2..5
    "root at the start": (lambda x: np.sqrt(x - 2.0), 2.0 / 3.0 * 3.0**1.5),
    "root at the end": (lambda x: np.sqrt(5.0 - x), 2.0 / 3.0 * 3.0**1.5),
    "roots at both": (lambda x: np.sqrt((x - 2.0) * (5.0 - x)), math.pi / 8.0 * 9.0),
    "a life to the power": (lambda x: (x - 2.0) ** (10.0 / 3.0), 3.0 ** (16.0 / 3.0) / 13.0),
    "smooth": (np.exp, math.exp(5.0) - math.exp(2.0)),
}


@pytest.mark.parametrize("name", CLOSED)
def test_roots_at_the_ends_cost_no_more_than_what_is_smooth(name):
    f, exact = CLOSED[name]
    calls = []

    def rows(x, which):
        calls.append(x.size)
        return f(x)[None]

    ends, one = (np.array([2.0]), np.array([5.0])), np.zeros(1, dtype=int)
    (found,) = span_integrals(rows, ends, one, np.full((1, 1), True), True)[0]
    # beside an end x itself is rounded, to 4e-16 of 5: a root of that over so short a way is lost
    assert found == pytest.approx(exact, rel=1e-14)
    assert len(calls) <= 4, "an end is halved time and again"


@pytest.mark.parametrize("kink", [2.0 + 1e-3, 2.003, 2.05, 3.5, 4.997])
def test_a_kink_beside_an_end_is_found(kink):
    """|x - kink| over 2..5: between an end and the nearest place of Gauss none would tell of it."""
    ends, one = (np.array([2.0]), np.array([5.0])), np.zeros(1, dtype=int)
    found = span_integrals(lambda x, _: abs(x - kink)[None], ends, one, np.full((1, 1), True), True)
    exact = 0.5 * ((kink - 2.0) ** 2 + (5.0 - kink) ** 2)
    assert found[0, 0] == pytest.approx(exact, rel=1e-12)  # what its last terms may leave


@pytest.mark.parametrize("nodes", [4, 12, 20, 28])
def test_rules_are_exact_for_polynomials(nodes):
    """Gauss to the degree 2 n - 1, and Lobatto to 2 n - 3: a few roundings of 1."""
    for (x, weight), degree in ((rule(nodes), 2 * nodes - 2), (lobatto(nodes), 2 * nodes - 4)):
        for power in (0, 2, degree):
            assert x**power @ weight == pytest.approx(2.0 / (power + 1), abs=2e-15)
            assert x ** (power + 1) @ weight == pytest.approx(0.0, abs=2e-15)


@pytest.mark.parametrize("x", [0.0, 1e-9, -0.05, 0.3, 0.5])
def test_sine_over_its_angle_and_its_derivatives(x):
    mpmath = pytest.importorskip("mpmath")
    with mpmath.workdps(40):
        exact = mpmath.taylor(mpmath.sinc, x, 4)
    for found, true in zip(_sinc(Jet.variable(x, 4)).c, exact, strict=True):
        # a rounding of its own size, or of the terms that cancel, of which the first is 1/6
        assert found == pytest.approx(float(true), rel=1e-15, abs=4e-17)
