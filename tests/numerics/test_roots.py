"""Roots, minima and boundaries to the last bit."""

import math
from decimal import Context, Decimal, localcontext

import numpy as np
import pytest
from witness import near

from geneva_cli.numerics.roots import boundary, boundary_by_sections, find_roots


def calls(f):
    """f and a list that grows by one with every call."""
    seen = []

    def counted(x):
        seen.append(x)
        return f(x)

    return counted, seen


def test_boundary():
    """To the last number that holds, of whatever kind: neighbours, and the same of arrays."""
    x = boundary(lambda x: x * x <= 2.0, 1.0, 2.0)
    assert x * x <= 2.0 < math.nextafter(x, 2.0) ** 2
    x = boundary(lambda x: x * x > 2.0, 2.0, 1.0)
    assert math.nextafter(x, 1.0) ** 2 <= 2.0 < x * x
    assert boundary(lambda x: True, 1.0, 2.0) == math.nextafter(2.0, 1.0)
    assert boundary(lambda x: False, 1.0, 2.0) == 1.0
    limits = np.array([[2.0], [3.0], [math.nan]])
    many = boundary(lambda x: x * x <= limits, np.ones((3, 1)), limits)
    assert many[:2, 0].tolist() == [
        boundary(lambda x: x * x <= 2.0, 1.0, 2.0),
        boundary(lambda x: x * x <= 3.0, 1.0, 3.0),
    ]
    with localcontext(Context(prec=50)):
        root = boundary(lambda x: x * x <= 2, Decimal(1), Decimal(2))
        assert 0 <= Decimal(2).sqrt() - root < Decimal("1e-48")


@pytest.mark.parametrize(
    ("margin", "good", "bad"),
    [
        (lambda x: 2.0 - x * x, 1.0, 2.0),
        (lambda x: x * x - 2.0, 2.0, 1.0),
        (np.cos, 0.0, 3.0),
        (lambda x: np.exp(-x) - 1e-3, 0.0, 100.0),
        (lambda x: 1e-9 - x**3, 0.0, 5.0),  # flat where it is positive
        (lambda x: np.where(x < 0.7, 1.0, -1.0), 0.0, 1.0),  # a leap
    ],
)
def test_boundary_by_sections(margin, good, bad):
    """The number that halving reaches, in a few calls."""
    counted, seen = calls(margin)
    exact = boundary(lambda x: bool(margin(np.float64(x)) > 0.0), good, bad)
    assert boundary_by_sections(counted, good, bad) == exact
    assert len(seen) <= 12


def test_roots_of_a_batch():
    """Newton, a bend that misleads it, a slope that is none, and no number."""
    rate = np.array([1.0, 50.0, 1e3, math.nan])
    place = np.array([0.3, 0.1, -0.7, 0.0])

    def f(x, which):
        t = rate[which] * (x - place[which])
        return np.arctan(t), rate[which] / (1.0 + t * t)

    found = find_roots(f, np.full(4, -9.0), np.full(4, 9.0))
    assert found[:3] == pytest.approx(place[:3], rel=2.3e-16)
    assert math.isnan(found[3])
    flat = find_roots(lambda x, which: (x - 0.1, 0.0 * x), np.array([0.0]), np.array([1.0]))
    assert flat[0] == near(0.1, 2.3e-16)
    falling = find_roots(lambda x, _: (0.25 - x, 0.0 * x - 1.0), np.zeros(2), np.ones(2))
    assert falling.tolist() == [0.25, 0.25]
