"""Chebyshev series: against closed forms, and the same bits for a row alone and among others."""

import mpmath
import numpy as np
import pytest

from geneva_cli.numerics import chebyshev
from geneva_cli.numerics.chebyshev import GRID, POINTS

ROWS = np.stack((np.exp(POINTS), np.sin(POINTS), 1.0 / (3.0 + POINTS), np.cos(2.0 * POINTS)))


def test_terms_of_the_exponential_function_are_bessel_functions():
    """e^t = I_0(1) + 2 sum I_k(1) T_k(t); 1e-15 is a few roundings of 17 values below e."""
    terms = chebyshev.series(ROWS[:1])[:, 0]
    exact = [float((2 if k else 1) * mpmath.besseli(k, 1)) for k in range(len(terms))]
    np.testing.assert_allclose(terms, exact, rtol=0, atol=1e-15)


def test_values_and_slopes_on_the_grid():
    """Rounding of a value is multiplied by n² = 256 in a slope at the ends."""
    value, slope = chebyshev.on_grid(ROWS[:2])
    np.testing.assert_allclose(value, (np.exp(GRID), np.sin(GRID)), rtol=0, atol=1e-14)
    np.testing.assert_allclose(slope, (np.exp(GRID), np.cos(GRID)), rtol=0, atol=2e-12)


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("count", [1, 2, 4])
def test_a_row_has_the_same_bits_among_others(order, count):
    few = np.array(ROWS[:count], order=order)
    many = np.tile(ROWS, (100, 1))
    for function in (chebyshev.series, lambda rows: chebyshev.on_grid(rows)[0].T):
        assert np.array_equal(function(few), function(many)[:, :count])
    assert np.array_equal(chebyshev.on_grid(few)[1], chebyshev.on_grid(many)[1][:count])
    assert np.array_equal(chebyshev.remainder(few), chebyshev.remainder(many)[:count])
