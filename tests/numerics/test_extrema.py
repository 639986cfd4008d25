"""Greatest sizes of a batch: where the search must end."""

import numpy as np
import pytest

from geneva_cli.numerics.extrema import greatest_sizes


def test_rounding_is_not_halved_without_end():
    """A constant with rounding of 1e-11 in value and slope, as the jerk of a law by points."""
    evaluations = 0

    def noisy(x, which, order):
        nonlocal evaluations
        evaluations += x.size
        noise = 1e-11 * np.sin(1e9 * x)
        return [12.0 + noise, 1e4 * noise, noise][: order + 1]

    size, _ = greatest_sizes(noisy, np.array([[0.0]]), np.array([[1.0]]))
    assert size[0] == pytest.approx(12.0, rel=1e-11)
    assert evaluations < 1_000_000
