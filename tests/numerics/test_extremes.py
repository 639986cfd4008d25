"""Extremes of functions of many designs, where they first are, and where signs change."""

import math

import numpy as np
import pytest
from numpy.polynomial import polynomial

from geneva_cli.numerics.cuts import Rows
from geneva_cli.numerics.extremes import SearchResult, Smooth, cuts, search
from geneva_cli.numerics.jet import Jet

WHOLE = 10.0
pytestmark = pytest.mark.filterwarnings("error")  # nothing is said of designs that are no numbers


def column(values):
    return np.array(values, dtype=float)[:, None]


def waves(rates):
    def jets(x, which, order, requested):
        rate = rates[which, None]
        sine, cosine = np.sin(rate * x), np.cos(rate * x)
        return [Jet((sine, rate * cosine, -0.5 * rate**2 * sine))]

    return Smooth(jets)


def extremes(rates, parted):
    ends = [np.full((len(rates), 1), 0.0), parted[:, None], np.full((len(rates), 1), WHOLE)]
    return search(waves(rates), list(zip(ends, ends[1:], strict=False)), sized=False)


def polynomials(c):
    """One polynomial a row of c."""

    def jets(x, which, order, requested):
        own = [polynomial.polyder(c[which], k, axis=1) / max(1, k) for k in range(3)]
        return [Jet(polynomial.polyval(x.T, one.T[:, None], tensor=False).T for one in own)]

    return Smooth(jets)


@pytest.mark.long
def test_the_greatest_and_the_least_of_waves():
    rng = np.random.default_rng(8)
    rates = rng.uniform(0.1, 2.0, 300)
    found = extremes(rates, rng.uniform(0.5, 9.5, 300))
    dense = np.sin(rates[:, None] * np.linspace(0.0, WHOLE, 20_001))
    top = np.where(rates * WHOLE > 0.5 * np.pi, 1.0, dense.max(axis=1))
    low = np.where(rates * WHOLE > 1.5 * np.pi, -1.0, dense.min(axis=1))
    assert found.most[0] == pytest.approx(top, rel=1e-15)
    assert -found.most[1] == pytest.approx(low, rel=1e-15)


def test_an_empty_piece_hides_none_that_begins_with_it():
    ends, one = np.array([[0.0, 2.0, 2.0], [2.0, 5.0, 2.0]]), np.zeros(3, dtype=int)
    found = SearchResult(*np.zeros((2, 1)), [(Rows(one, one, ends, ends), np.ones((1, 3)))])
    assert found.stretches.x.tolist() == [[0.0], [5.0]]


class Bent:
    """|x - turn| of each design, by way of the sign of x - turn, and 1 / (x - turn) beside it."""

    signs, wanted, poled = 1, 2, ()

    def __init__(self, turn):
        self.turn = turn

    def __call__(self, x, which, order, held=None, requested=None):
        way = x - self.turn[which]
        own = np.sign(way)
        sign = own if held is None else np.where(np.isnan(held[0]), own, held[0])
        one, requested = np.ones_like(way), range(2) if requested is None else requested
        with np.errstate(divide="ignore"):
            pole = np.where(sign * way > 0.0, 1.0 / way, np.inf)
        wanted = [sign * way, pole], [sign * one, -pole * pole], [0.0 * one, pole**3]
        rows = zip((way, one, 0.0 * one)[: order + 1], wanted, strict=False)
        return (way > 0.0)[None], [np.stack([a, *[of[i] for i in requested]]) for a, of in rows]


def test_a_kink_and_a_pole_are_cut_where_the_sign_changes():
    """The first place without a bound is the pole's, and beyond it least values are still found."""
    turn = np.random.default_rng(10).uniform(1.0, 9.0, 50)
    bent = Bent(turn[:, None])
    ends = [(np.zeros((50, 1)), np.full((50, 1), WHOLE))]
    found = search(bent, ends, sized=False)
    assert found.most[0] == pytest.approx(np.maximum(turn, WHOLE - turn), rel=1e-15)
    assert found.x[0] == pytest.approx(np.where(turn > 5.0, 0.0, WHOLE))
    assert -found.most[2] == pytest.approx(np.zeros(50), abs=1e-13)  # of |x - turn|
    assert found.x[2] == pytest.approx(turn, rel=1e-14)
    assert np.isinf(found.most[1]).all()
    assert np.array_equal(found.stretches.design, np.repeat(np.arange(50), 2))
    assert found.stretches.x[1, ::2] == pytest.approx(turn, rel=1e-14)
    assert found.stretches.positive[0].tolist() == [False, True] * 50


@pytest.mark.sampled(2)
@pytest.mark.parametrize("sized", [True, False])
def test_extremes_of_polynomials(sized):
    """The greatest of the ends and of the companion matrix's real parts.

    That of no real root is a value of the function as well, so it is never above.
    """
    c = np.random.default_rng(3).normal(size=(600, 8))
    most, x, _ = search(polynomials(c), [(column([-1.5] * 600), column([1.5] * 600))], sized)
    for i, own in enumerate(c):
        roots = polynomial.polyroots(polynomial.polyder(own)).real
        values = polynomial.polyval([-1.5, 1.5, *roots[abs(roots) < 1.5]], own)
        # 2e-14: the rounding of terms that add up to 1.5^7 times the peak and cancel
        size = 2e-14 * abs(values).max()
        true = abs(values).max() if sized else values.max()
        assert most[0, i] == pytest.approx(true, rel=0.0, abs=size)
        here = polynomial.polyval(x[:, i], own)
        assert (abs(here) if sized else here * (1.0, -1.0)) == pytest.approx(most[:, i], abs=size)


def test_every_zero_is_a_cut():
    """Of sin(rate x) they are the multiples of pi/rate."""
    rates = np.random.default_rng(4).uniform(0.5, 6.0, 200)
    f = waves(rates)
    f.signs, f.wanted = 1, 0
    parts = cuts(f, [(column([0.1] * 200), column([WHOLE] * 200))])
    inner = np.diff(parts.design, prepend=-1) == 0
    turns = parts.x[0][inner] * rates[parts.design[inner]] / math.pi
    assert turns == pytest.approx(np.round(turns), rel=1e-14)
    zeros = np.floor(WHOLE * rates / math.pi) - np.floor(0.1 * rates / math.pi)
    assert np.array_equal(np.bincount(parts.design[inner], minlength=200), zeros)


def test_designs_that_are_not_numbers():
    """They have no answer, and the others have the very answers that they have alone."""
    rates = np.array([1.0, math.nan, 3.0, 2.0])
    most, x, _ = search(waves(rates), [(np.zeros((4, 1)), np.ones((4, 1)))], True)
    assert most[0, [0, 2, 3]].tolist() == [math.sin(1.0), 1.0, 1.0]
    assert x[0, [0, 2, 3]] == pytest.approx([1.0, math.pi / 6.0, math.pi / 4.0], rel=2.3e-16)
    assert most[0, 1] == -math.inf


def test_rounding_is_not_halved_without_end():
    """A constant with rounding of 1e-11 in value and slope, as the jerk of a law by points."""
    evaluations = 0

    def noisy(x, which, order, requested):
        nonlocal evaluations
        evaluations += x.size
        noise = 1e-11 * np.sin(1e9 * x)
        return [Jet((12.0 + noise, 1e4 * noise, noise))]

    most = search(Smooth(noisy), [(np.zeros((1, 1)), np.ones((1, 1)))], True).most
    assert most[0, 0] == pytest.approx(12.0, rel=1e-11)
    assert evaluations < 1_000_000
