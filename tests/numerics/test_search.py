"""Extremes of functions of many designs, where they first are, and where signs change."""

import numpy as np
import pytest

from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.stretch_search import search

WHOLE = 10.0


class Waves:
    """sin(rate x), x in degrees."""

    signs, wanted, margins, poled = 0, 1, (), ()

    def __init__(self, rates):
        self.rates = rates

    def at(self, x, which, order):
        return x, self.rates[which], order

    def evaluate(self, at, forced=None, requested=None):
        x, rate, order = at
        slope = rate / DEGREE
        rows = np.sin(rate * x), slope * np.cos(rate * x), -0.5 * slope**2 * np.sin(rate * x)
        return np.empty((0, *x.shape), bool), [row[None] for row in rows[: order + 1]]


def extremes(rates, parted):
    waves = Waves(rates[:, None])
    ends = [np.full((len(rates), 1), 0.0), parted[:, None], np.full((len(rates), 1), WHOLE)]
    return search(waves, list(zip(ends, ends[1:], strict=False)), len(rates), sized=False)


def test_the_greatest_and_the_least_of_waves():
    rng = np.random.default_rng(8)
    rates = rng.uniform(0.1, 2.0, 300)
    found = extremes(rates, rng.uniform(0.5, 9.5, 300))
    dense = np.sin(rates[:, None] * np.linspace(0.0, WHOLE, 20_001))
    top = np.where(rates * WHOLE > 0.5 * np.pi, 1.0, dense.max(axis=1))
    low = np.where(rates * WHOLE > 1.5 * np.pi, -1.0, dense.min(axis=1))
    assert found.most[0] == pytest.approx(top, rel=1e-15)
    assert -found.most[1] == pytest.approx(low, rel=1e-15)


def test_no_design_hangs_on_how_its_neighbours_are_parted():
    rng = np.random.default_rng(9)
    rates, parted = rng.uniform(0.1, 2.0, 40), rng.uniform(0.5, 9.5, 40)
    together = extremes(rates, parted)
    for i in range(40):
        alone = extremes(rates[i : i + 1], parted[i : i + 1])
        assert np.array_equal(alone.most[:, 0], together.most[:, i])
        assert np.array_equal(alone.x[:, 0], together.x[:, i])


class Bent(Waves):
    """|x - turn| of each design, by way of the sign of x - turn, and 1 / (x - turn) beside it."""

    signs, wanted, margins = 1, 2, (0,)

    def column(self, at, number):
        x, rate, order = at
        return x[:, number : number + 1], rate, order

    def rows(self, at, which):
        x, rate, order = at
        return x[which], rate[which], order

    def evaluate(self, at, forced=None, requested=None):
        x, turn, order = at
        way = x - turn
        sign = (
            np.sign(way)
            if forced is None
            else np.where(np.isnan(forced[0]), np.sign(way), forced[0])
        )
        requested = range(2) if requested is None else requested
        one = np.ones_like(way)
        with np.errstate(divide="ignore"):
            pole = np.where(sign * way > 0.0, 1.0 / way, np.inf)
        wanted = [sign * way, pole], [sign * one, -pole * pole], [0.0 * one, pole**3]
        every = []
        for k, own in enumerate((way, one, 0.0 * one)[: order + 1]):
            scale = (1.0 / DEGREE) ** k
            every.append(np.stack([own * scale, *[wanted[k][i] * scale for i in requested]]))
        return (way > 0.0)[None], every


def test_a_kink_and_a_pole_are_cut_where_the_sign_changes():
    """The first place without a bound is the pole's, and beyond it least values are still found."""
    turn = np.random.default_rng(10).uniform(1.0, 9.0, 50)
    ends = [(np.zeros((50, 1)), np.full((50, 1), WHOLE))]
    found = search(Bent(turn[:, None]), ends, 50, sized=False)
    assert found.most[0] == pytest.approx(np.maximum(turn, WHOLE - turn), rel=1e-15)
    assert found.x[0] == pytest.approx(np.where(turn > 5.0, 0.0, WHOLE))
    assert -found.most[2] == pytest.approx(np.zeros(50), abs=1e-13)  # of |x - turn|
    assert found.x[2] == pytest.approx(turn, rel=1e-14)
    assert np.isinf(found.most[1]).all()
    assert np.array_equal(found.stretches.design, np.repeat(np.arange(50), 2))
    assert found.stretches.x[1, ::2] == pytest.approx(turn, rel=1e-14)
    assert found.stretches.positive[0].tolist() == [False, True] * 50


def test_of_equal_values_the_earlier_place_counts():
    """A whole wave and a half: its two tops differ by roundings."""
    rates = np.full(1, 3.0 * np.pi / WHOLE)
    found = extremes(rates, np.array([4.0]))
    assert found.x[0, 0] == pytest.approx(WHOLE / 6.0, rel=1e-7)


def test_a_constant_is_greatest_where_it_begins():
    found = extremes(np.zeros(2), np.array([4.0, 6.0]))
    assert np.array_equal(found.x, np.zeros((2, 2)))
