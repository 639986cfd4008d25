"""The usual values of samples of which some are near a pole."""

import math

import numpy as np

from geneva_cli.numerics.greatest import usual


def test_values_near_a_pole_are_left_out():
    """Quartiles of 1 to 15 and 1e9 are 4 and 12 (the fourth and the twelfth of sixteen)."""
    rows = np.array([[*range(1, 16), 1e9, math.inf], [*range(1, 18)]], dtype=float)
    low, high = usual(rows)
    assert low.tolist() == [1.0, 1.0]
    assert high.tolist() == [12.0 + 3.0 * (12.0 - 4.0), 17.0]


def test_all_finite_values_are_usual():
    low, high = usual(np.array([[[3.0, -1.0], [1e9, 0.0]]]))
    assert (low.tolist(), high.tolist()) == ([[-1.0, 0.0]], [[3.0, 1e9]])
