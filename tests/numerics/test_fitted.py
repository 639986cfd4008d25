"""Functions by polynomials: as exact as the function itself, wherever its formula changes."""

import numpy as np
import pytest

from geneva_cli.numerics.fitted import fitted

UNIT = 2.0**-52
X = np.linspace(-1.3, 2.9, 65536 + 1)
CASES = {
    "a pole near by": (lambda x: 1.0 / (0.01 + x * x), ()),
    "a corner": (lambda x: np.abs(x - 0.7), (0.7,)),
    "a jump": (lambda x: np.where(x > 0.7, np.cos(x), 3.0 + x), (0.7,)),
    "a jump that is no seam": (lambda x: np.where(x > 0.7, np.cos(x), 3.0 + x), ()),
    "a root at the end": (lambda x: np.sqrt(np.abs(x + 1.3)), (-1.3,)),
    "nothing": (lambda x: 0.0 * x, ()),
    "quick waves": (lambda x: np.sin(300.0 * x), ()),
}


@pytest.mark.parametrize("case", CASES)
def test_values_are_the_functions(case):
    function, seams = CASES[case]
    (values,) = fitted(lambda x: [function(x)], X, seams)
    exact = function(X)
    assert abs(values - exact).max() <= 3 * UNIT * abs(exact).max() * (
        100 if "waves" in case else 1
    )


def test_few_values_of_a_smooth_function_are_computed():
    computed = []
    both = fitted(lambda x: computed.append(len(x)) or [np.exp(x), np.sin(x)], X, ())
    assert sum(computed) < len(X) / 30
    for values, exact in zip(both, (np.exp(X), np.sin(X)), strict=True):
        assert abs(values / exact - 1.0)[abs(exact) > 0.1].max() < 4 * UNIT


def test_small_values_next_to_a_seam_keep_their_digits():
    """A velocity that is 0 at entry: polynomials about other places would leave 1e-16 there."""
    x = np.linspace(0.0, 1.0, 65536)
    (values,) = fitted(lambda x: [np.expm1(x)], x, (0.0, 1.0))
    exact = np.expm1(x)
    assert values[0] == 0.0
    assert abs(values[1:] / exact[1:] - 1.0).max() < 8 * UNIT


def test_the_rounding_of_a_function_is_not_taken_for_its_shape():
    """Halving would not end before each place had its own value."""
    computed = []

    def rounded(x):
        computed.append(len(x))
        return [np.cos(x) + 1e-15 * np.sin(1e9 * x)]

    (values,) = fitted(rounded, X, ())
    assert sum(computed) < len(X) / 10
    assert abs(values - np.cos(X)).max() < 2e-15
