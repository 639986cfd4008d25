"""Roots, minima and boundaries to the last bit."""

import math
from decimal import Context, Decimal, localcontext

import numpy as np
import pytest
from witness import near

from geneva_cli.numerics.roots import Falsi, boundary, boundary_by_sections, find_roots, root


def calls(f):
    """f and a list that grows by one with every call."""
    seen = []

    def counted(x):
        seen.append(x)
        return f(x)

    return counted, seen


@pytest.mark.parametrize(
    ("f", "a", "b", "exact"),
    [
        (lambda x: (x * x - 2.0, 2.0 * x), 0.0, 2.0, math.sqrt(2.0)),
        (lambda x: (math.cos(x), -math.sin(x)), 0.0, 3.0, math.pi / 2.0),
        (lambda x: (2.0 - x * x, -2.0 * x), 0.0, 2.0, math.sqrt(2.0)),
        (lambda x: (math.atan(50.0 * (x - 0.3)), 50.0 / (1 + 2500.0 * (x - 0.3) ** 2)), -9, 9, 0.3),
    ],
)
def test_root(f, a, b, exact):
    g, seen = calls(f)
    x = root(g, a, b)
    # one unit in the last place; where cos x passes zero its own rounding decides
    assert x == near(exact, 2.3e-16)
    assert len(seen) < 120


def test_root_with_a_misleading_slope():
    """A slope that always throws Newton out of the bracket costs bisection, no more."""
    g, seen = calls(lambda x: (x - 0.1, 1e-9))
    assert root(g, -1.0, 1.0) == near(0.1, 2.3e-16)
    assert len(seen) < 120


def test_triple_root_at_zero_ends():
    """0 has no last place to stop at: the bracket shrinks towards it until the steps run out."""
    g, seen = calls(lambda x: (x**3, 3.0 * x * x))
    assert abs(root(g, -1.0, 1.5)) < 1e-30
    assert len(seen) <= 201


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
    ("margin", "good", "bad", "most"),
    [
        (lambda x: 2.0 - x * x, 1.0, 2.0, 5),
        (lambda x: x * x - 2.0, 2.0, 1.0, 5),
        (np.cos, 0.0, 3.0, 5),
        (lambda x: np.exp(-x) - 1e-3, 0.0, 100.0, 7),
        (lambda x: 1e-9 - x**3, 0.0, 5.0, 8),  # flat where it is positive
        (lambda x: np.where(x < 0.7, 1.0, -1.0), 0.0, 1.0, 12),  # a leap: 1/32 of it each time
    ],
)
def test_boundary_by_sections(margin, good, bad, most):
    """The number that halving reaches, in a few calls."""
    counted, seen = calls(margin)
    exact = boundary(lambda x: bool(margin(np.float64(x)) > 0.0), good, bad)
    assert boundary_by_sections(counted, good, bad) == exact
    assert len(seen) <= most


def test_boundary_by_sections_without_a_good_end():
    """Where no number is good, the first end is returned."""
    assert boundary_by_sections(lambda x: -1.0 - x, 1.0, 2.0) == 1.0


@pytest.mark.parametrize("short", [-1.0, -math.inf])
def test_falsi(short):
    """Where what is left is known, some steps; where it is without bound, by halving."""
    found = Falsi(1.0, 1.0, 2.0, short)
    steps = 0
    while (x := found.middle()) not in (found.good, found.bad):
        steps += 1
        left = 2.0 - x * x
        found.add(x, left if left >= 0.0 or math.isfinite(short) else -math.inf)
    assert found.good == near(math.sqrt(2.0), 2.3e-16)
    assert found.good**2 <= 2.0
    assert steps < (12 if math.isfinite(short) else 60)
    assert Falsi(1.0, 1e-300, 2.0, -1.0).middle(0.02) == 1.02


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
    assert flat[0] == root(lambda x: (x - 0.1, 0.0), 0.0, 1.0)
    falling = find_roots(lambda x, _: (0.25 - x, 0.0 * x - 1.0), np.zeros(2), np.ones(2))
    assert falling.tolist() == [0.25, 0.25]
