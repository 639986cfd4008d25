"""The rule by which loads of many designs are summed up."""

import numpy as np
import pytest

from geneva_cli.numerics.quadrature_many import NODE, WEIGHT, integrals_many


@pytest.mark.parametrize("power", [0, 2, 20, 60])
def test_kronrod_is_exact_to_its_degree(power):
    """3 n + 1 of n = 20 places of Gauss; odd powers vanish by symmetry."""
    assert WEIGHT @ NODE**power == pytest.approx(2.0 / (power + 1), rel=4e-15)


def test_every_other_place_is_a_place_of_gauss():
    assert NODE[1::2] == pytest.approx(np.polynomial.legendre.leggauss(20)[0], abs=2e-15)


@pytest.mark.parametrize("ends", [False, True])
def test_designs_that_need_more_are_halved(ends):
    """∫ dx/(x² + s²) over [0, 1] is atan(1/s)/s: of a narrow peak the rule sees nothing."""
    s = np.array([1.0, 1e-4])

    def peaks(x, which):
        return (1.0 / (x * x + s[which, None] ** 2))[None]

    every, asked = np.arange(2), np.full((1, 2), True)
    found = integrals_many(peaks, 0.0 * s, 1.0 + 0.0 * s, every, asked, ends)
    assert found[0] == pytest.approx(np.arctan(1.0 / s) / s, rel=4e-15)
