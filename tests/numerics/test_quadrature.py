"""Integrals of functions, some with roots at their ends."""

import math

import numpy as np
import pytest

from geneva_cli.numerics import quadrature
from geneva_cli.numerics.quadrature import LAST_TERMS, NODES, span_integrals

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
    (found,) = span_integrals(rows, ends, one, np.full((1, 1), True))[0]
    # beside an end x itself is rounded, to 4e-16 of 5: a root of that over so short a way is lost
    assert found == pytest.approx(exact, rel=1e-14)
    assert len(calls) <= 4, "an end is halved time and again"


@pytest.mark.parametrize("kink", [2.0 + 1e-3, 2.003, 2.05, 3.4999, 3.5, 3.503, 4.997])
def test_a_kink_beside_an_end_is_found(kink):
    """|x - kink| over 2..5, between an end, or the middle, and the nearest place of a rule."""
    ends, one = (np.array([2.0]), np.array([5.0])), np.zeros(1, dtype=int)
    found = span_integrals(lambda x, _: abs(x - kink)[None], ends, one, np.full((1, 1), True))
    exact = 0.5 * ((kink - 2.0) ** 2 + (5.0 - kink) ** 2)
    assert found[0, 0] == pytest.approx(exact, rel=1e-12)  # what its last terms may leave


def summed(f, n=1):
    """The integral over [0, 1] of n functions (n, k) of a place, and how many places it took."""
    places = []

    def functions(x, which):
        places.append(x.size)
        return f(x, which)[None]

    a, every = np.zeros(n), np.arange(n)
    found = span_integrals(functions, (a, a + 1.0), every, np.full((1, n), True))
    return found[0], sum(places)


@pytest.mark.parametrize("pole", [0.05, 0.1, 0.2, 0.5, 1.0])
def test_what_is_left_is_told_by_the_series(pole, monkeypatch):
    """∫ dx/(x + p) is log(1 + 1/p): whatever may be left, no more is."""
    for left in (LAST_TERMS, 1e-9, 1e-6, 1e-3):
        monkeypatch.setattr(quadrature, "LAST_TERMS", left)
        found, _ = summed(lambda x, _: 1.0 / (x + pole))
        assert found == pytest.approx(math.log1p(1.0 / pole), rel=left + 4e-15)


def test_designs_that_need_more_are_halved():
    """∫ dx/(x² + s²) over [0, 1] is atan(1/s)/s: of a narrow peak the rule sees nothing."""
    s = np.array([1.0, 1e-4])
    found, _ = summed(lambda x, which: 1.0 / (x * x + s[which, None] ** 2), 2)
    assert found == pytest.approx(np.arctan(1.0 / s) / s, rel=4e-15)


def test_noise_is_given_up_after_a_count_and_leaves_other_designs():
    """Halving spans of noise would double their number forty times; a smooth design stays exact."""

    def rounding(x, which):
        noise = np.modf(1e9 * np.sin(1e9 * x))[0]
        return np.where((which == 0)[:, None], noise, x)

    result, places = summed(rounding, n=2)
    assert math.isnan(result[0]) and result[1] == pytest.approx(0.5, rel=4e-15)
    assert places < 100_000 * NODES
