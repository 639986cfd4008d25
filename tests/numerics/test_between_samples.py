"""What functions may come to between samples, and what of many designs is told from them."""

import numpy as np
import pytest

from geneva_cli.numerics.between_samples import limits
from geneva_cli.numerics.cells import Tops
from geneva_cli.numerics.ties import quartiles

UNIT = np.linspace(0.0, 1.0, 401)


def sample(polynomials, x):
    """Place, value and slope of polynomials (n, terms) at a place of each."""
    power = np.arange(polynomials.shape[1])
    value = (polynomials * x[:, None] ** power).sum(axis=1)
    return x, value, (polynomials * power * x[:, None] ** np.maximum(power - 1, 0)).sum(axis=1)


@pytest.mark.parametrize("place", [0.5, 0.8])  # in the middle; beside what was cut
def test_polynomials_keep_within_their_limits(place):
    """Of the fifth degree, of which a cubic predicts little."""
    polynomials = np.random.default_rng(1).normal(size=(2000, 6))
    every = np.array([sample(polynomials, np.full(2000, x))[1] for x in UNIT])
    low, high = limits(*(sample(polynomials, np.full(2000, x)) for x in (0.0, place, 1.0)))
    assert (low <= every.min(axis=0)).all()
    assert (every.max(axis=0) <= high).all()
    narrow = np.median((high - low) / np.ptp(every, axis=0))
    assert narrow < 15.0  # they tell something


def test_what_may_pass():
    """The greatest known is 2 and the least -1; of another design there is no greatest."""
    tops = Tops(1, 2, sized=False)
    tops.add_all(np.array([0, 0, 1, 1]), np.zeros(4), np.array([[2.0, -1.0, np.inf, 1.0]]))

    def may(design, low, high):
        which = np.array([design])
        return tops.may_pass(np.array([0]), which, np.array([low]), np.array([high]))[0]

    assert not may(0, -0.9, 1.9)
    assert may(0, -0.9, 2.1)
    assert may(0, -1.1, 1.9)
    assert may(0, np.nan, np.nan)  # nothing is known
    assert not may(1, 1.1, np.inf)
    assert may(1, 0.9, np.inf)


def test_sizes_that_may_pass():
    tops = Tops(1, 1, sized=True)
    tops.add_all(np.array([0]), np.zeros(1), np.array([[-2.0]]))
    ends = np.array([[-1.9, 1.9], [-2.1, 0.0], [0.0, 2.1]])
    found = [tops.may_pass(np.array([0]), np.array([0]), *end[:, None])[0] for end in ends]
    assert found == [False, True, True]


def test_quartiles_of_many_rows():
    rows = np.random.default_rng(2).normal(size=(200, 9))
    rows[:, 1:][np.random.default_rng(3).random((200, 8)) < 0.4] = np.nan
    expected = np.nanquantile(rows, (0.25, 0.75), axis=1)
    # both round one interpolation
    np.testing.assert_allclose(quartiles(rows), expected, rtol=0.0, atol=1e-15)
