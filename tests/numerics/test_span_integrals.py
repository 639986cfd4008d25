"""The rule by which loads of many designs are summed up."""

import math

import numpy as np
import pytest

from geneva_cli.numerics import quadrature
from geneva_cli.numerics.quadrature import LAST_TERMS, NODES, span_integrals


def summed(f, n=1, ends=False):
    """The integral over [0, 1] of n functions (n, k) of a place, and how many places it took."""
    places = []

    def functions(x, which):
        places.append(x.size)
        return f(x, which)[None]

    a, every = np.zeros(n), np.arange(n)
    found = span_integrals(functions, (a, a + 1.0), every, np.full((1, n), True), ends)
    return found[0], sum(places)


@pytest.mark.parametrize("pole", [0.05, 0.1, 0.2, 0.5, 1.0])
def test_what_is_left_is_told_by_the_series(pole, monkeypatch):
    """∫ dx/(x + p) is log(1 + 1/p): whatever may be left, no more is."""
    for left in (LAST_TERMS, 1e-9, 1e-6, 1e-3):
        monkeypatch.setattr(quadrature, "LAST_TERMS", left)
        found, _ = summed(lambda x, _: 1.0 / (x + pole))
        assert found == pytest.approx(math.log1p(1.0 / pole), rel=left + 4e-15)


@pytest.mark.parametrize("power", [1, 3, 5, 7])
def test_a_kink_is_no_series_that_falls(power):
    """∫ |x - c|^p: each halving leaves the half that has the kink."""
    c = 1.0 / math.pi
    found, places = summed(lambda x, _: np.abs(x - c) ** power)
    exact = (c ** (power + 1) + (1.0 - c) ** (power + 1)) / (power + 1)
    assert found == pytest.approx(exact, rel=LAST_TERMS)
    assert places > 2 * NODES


@pytest.mark.parametrize("ends", [False, True])
def test_designs_that_need_more_are_halved(ends):
    """∫ dx/(x² + s²) over [0, 1] is atan(1/s)/s: of a narrow peak the rule sees nothing."""
    s = np.array([1.0, 1e-4])
    found, _ = summed(lambda x, which: 1.0 / (x * x + s[which, None] ** 2), 2, ends)
    assert found == pytest.approx(np.arctan(1.0 / s) / s, rel=4e-15)


def test_noise_is_given_up_after_a_count_and_leaves_other_designs():
    """Halving spans of noise would double their number forty times; a smooth design stays exact."""

    def rounding(x, which):
        noise = np.modf(1e9 * np.sin(1e9 * x))[0]
        return np.where((which == 0)[:, None], noise, x)

    result, places = summed(rounding, n=2)
    assert math.isnan(result[0]) and result[1] == pytest.approx(0.5, rel=4e-15)
    assert places < 100_000 * NODES
