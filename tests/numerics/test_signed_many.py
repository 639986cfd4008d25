"""Extremes of functions of many designs: how their spans are sampled to begin with."""

import numpy as np
import pytest

from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.signed_many import CELLS, FEW, search

WHOLE = 10.0


class Waves:
    """sin(rate x), x in degrees; of what its places are, it keeps how many."""

    signs, wanted, rooms = 0, 1, ()

    def __init__(self, rates):
        self.rates, self.asked = rates, []

    def at(self, x, which, order):
        self.asked.append(x.shape)
        return x, self.rates[which], order

    def look(self, at, forced=None, asked=None):
        x, rate, order = at
        slope = rate / DEGREE
        rows = np.sin(rate * x), slope * np.cos(rate * x), -0.5 * slope**2 * np.sin(rate * x)
        return np.empty((0, *x.shape), bool), [row[None] for row in rows[: order + 1]]


def extremes(rates, parted):
    waves = Waves(rates[:, None])
    ends = [np.full((len(rates), 1), 0.0), parted[:, None], np.full((len(rates), 1), WHOLE)]
    found = search(waves, list(zip(ends, ends[1:], strict=False)), len(rates), sized=False)
    return found, waves.asked


def test_the_greatest_and_the_least_of_waves():
    rng = np.random.default_rng(8)
    rates = rng.uniform(0.1, 2.0, 300)
    found, _ = extremes(rates, rng.uniform(0.5, 9.5, 300))
    dense = np.sin(rates[:, None] * np.linspace(0.0, WHOLE, 20_001))
    top = np.where(rates * WHOLE > 0.5 * np.pi, 1.0, dense.max(axis=1))
    low = np.where(rates * WHOLE > 1.5 * np.pi, -1.0, dense.min(axis=1))
    assert found.most[0] == pytest.approx(top, rel=1e-15)
    assert -found.most[1] == pytest.approx(low, rel=1e-15)


def test_a_piece_that_is_short_beside_another_has_fewer_samples():
    _, (first, last, *_) = extremes(np.full(3, 0.2), np.full(3, 2.0))
    assert (first, last) == ((3, FEW + 1), (3, CELLS + 1))


def test_no_design_hangs_on_how_its_neighbours_are_parted():
    rng = np.random.default_rng(9)
    rates, parted = rng.uniform(0.1, 2.0, 40), rng.uniform(0.5, 9.5, 40)
    together, _ = extremes(rates, parted)
    for i in range(40):
        alone, _ = extremes(rates[i : i + 1], parted[i : i + 1])
        assert np.array_equal(alone.most[:, 0], together.most[:, i])
        assert np.array_equal(alone.x[:, 0], together.x[:, i])
