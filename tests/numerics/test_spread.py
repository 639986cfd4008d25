"""Places spread about 0: there and back, and how many of them a pole beside the axis takes."""

import numpy as np
import pytest

from geneva_cli.numerics.cuts import gathered, spread
from geneva_cli.numerics.quadrature import rule


@pytest.mark.parametrize("w", [1e-3, 0.5, 7.0, 1e9])
def test_there_and_back(w):
    x = np.array([-60.0, -1.0, -1e-9, 0.0, 1e-9, 0.3, 60.0])
    u = spread(x, w)
    assert gathered(u, w) == pytest.approx(x, rel=1e-14, abs=1e-15 * w)  # of an exponential
    assert np.array_equal(spread(-x, w), -u)  # mirrored motions are worked out once


def test_twenty_places_tell_a_pole():
    """The integral of 1/(x² + w²)² from 0 to 1, in closed form."""
    w = 0.26  # as a wheel of three slots
    true = (1.0 / (1.0 + w * w) + np.arctan(1.0 / w) / w) / (2.0 * w * w)
    node, weight = rule(20)

    def total(a, b, places_):
        half = 0.5 * (b - a)
        x, rate = places_(0.5 * (a + b) + half * node)
        return (rate / (x * x + w * w) ** 2) @ weight * half

    even = total(0.0, 1.0, lambda x: (x, np.ones_like(x)))
    gathered_ = total(0.0, spread(1.0, w), lambda u: (gathered(u, w), np.cosh(u / w)))
    assert gathered_ == pytest.approx(true, rel=1e-14)
    assert abs(even / true - 1.0) > 1e-12
