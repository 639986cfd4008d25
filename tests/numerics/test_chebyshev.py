"""Chebyshev series: against closed forms, and the same bits for a row alone and among others."""

import mpmath
import numpy as np
import pytest

from geneva_cli.numerics import chebyshev
from geneva_cli.numerics.chebyshev import GRID, POINTS

COLUMNS = np.stack(
    (np.exp(POINTS), np.sin(POINTS), 1.0 / (3.0 + POINTS), np.cos(2.0 * POINTS)), axis=1
)


def test_terms_of_the_exponential_function_are_bessel_functions():
    """e^t = I_0(1) + 2 sum I_k(1) T_k(t); 1e-15 is a few roundings of 17 values below e."""
    terms = chebyshev.series(COLUMNS[:, :1])[:, 0]
    exact = [float((2 if k else 1) * mpmath.besseli(k, 1)) for k in range(len(terms))]
    np.testing.assert_allclose(terms, exact, rtol=0, atol=1e-15)


def test_values_and_slopes_on_the_grid():
    """Rounding of a value is multiplied by n² = 256 in a slope at the ends."""
    value, slope = chebyshev.on_grid(COLUMNS[:, :2])
    np.testing.assert_allclose(value.T, (np.exp(GRID), np.sin(GRID)), rtol=0, atol=1e-14)
    np.testing.assert_allclose(slope.T, (np.exp(GRID), np.cos(GRID)), rtol=0, atol=2e-12)


@pytest.mark.parametrize("count", [1, 4])
def test_a_column_has_the_same_bits_among_others(count):
    few, many = COLUMNS[:, :count].copy(), np.tile(COLUMNS, 100)
    for of in (chebyshev.series, chebyshev.remainder, lambda v: np.stack(chebyshev.on_grid(v))):
        assert np.array_equal(of(few), of(many)[..., :count])
