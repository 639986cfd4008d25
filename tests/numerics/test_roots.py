"""Roots to the last bit, and no stationary point stepped over."""

import math
from decimal import Context, Decimal, localcontext

import numpy as np
import pytest
from witness import near

from geneva_cli.numerics.roots import Falsi, boundary, extrema, least, root


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


def test_root_without_a_slope_is_bisected():
    g, seen = calls(lambda x: (x - 0.1, 0.0))
    assert root(g, 0.0, 1.0) == near(0.1, 2.3e-16)
    assert len(seen) < 70  # 53 halvings and a few


def test_root_with_a_misleading_slope():
    """A slope that always throws Newton out of the bracket costs bisection, no more."""
    g, seen = calls(lambda x: (x - 0.1, 1e-9))
    assert root(g, -1.0, 1.0) == near(0.1, 2.3e-16)
    assert len(seen) < 120


def test_root_exactly_hit():
    assert root(lambda x: (x, 1.0), -1.0, 1.0) == 0.0


def test_triple_root_at_zero_ends():
    """0 has no last place to stop at: the bracket shrinks towards it until the steps run out."""
    g, seen = calls(lambda x: (x**3, 3.0 * x * x))
    assert abs(root(g, -1.0, 1.5)) < 1e-30
    assert len(seen) <= 201


def lorentzian(middle, width):
    def f(x):
        t = (x - middle) / width
        d = 1.0 + t * t
        return 1.0 / d, -2.0 * t / (d * d) / width, (6.0 * t * t - 2.0) / d**3 / width**2

    return f


@pytest.mark.parametrize("width", [1e-2, 1e-4, 1e-6, 1e-9])
@pytest.mark.parametrize("middle", [0.3, 0.71828, -0.999])
def test_narrow_peak(width, middle):
    """A peak a billionth of the interval wide, by its tails alone."""
    found = extrema(lorentzian(middle, width), -1.0, 1.0)
    assert len(found) == 1
    assert found[0] == pytest.approx(middle, rel=0.0, abs=2.3e-16)  # one unit of 1


def test_narrow_peak_beside_a_broad_one():
    """What a scan can see: tails above a hundredth of the range, from half an interval away."""
    narrow, broad = lorentzian(0.4321, 0.005), lorentzian(-0.5, 0.1)

    def f(x):
        a, b = narrow(x), broad(x)
        return tuple(p + q for p, q in zip(a, b, strict=True))

    found = extrema(f, -1.0, 1.0)
    assert len(found) == 3  # two peaks and the valley between
    assert found == sorted(found)
    # each moves the other's top by the slope of its tail times width^2/2
    assert found[0] == pytest.approx(-0.5, abs=1e-6)
    assert found[2] == pytest.approx(0.4321, abs=1e-5)


def sine(n):
    def f(x):
        return math.sin(n * x), n * math.cos(n * x), -n * n * math.sin(n * x)

    return f


@pytest.mark.parametrize("n", [1, 3, 7, 40])
def test_every_wave(n):
    found = extrema(sine(n), 0.0, math.pi)
    assert found == pytest.approx([(k + 0.5) * math.pi / n for k in range(n)], abs=1e-15)


def test_stationary_points_on_scan_points_are_found_once():
    def f(x):
        return x**4 - 2.0 * x * x, 4.0 * x**3 - 4.0 * x, 12.0 * x * x - 4.0

    # -1, 0 and 1 are knots of the scan of [-2, 2]
    assert extrema(f, -2.0, 2.0) == [-1.0, 0.0, 1.0]


def test_stationary_points_in_an_interval_without_a_middle():
    """As of a motion over the least double there is: halves of it are its ends."""
    least = math.ulp(0.0)
    for a, b in ((0.0, least), (1.0, 1.0 + math.ulp(1.0))):
        found = extrema(lambda x, a=a, b=b: (0.0, (x - a) * (b - x), 1.0), a, b)
        assert all(x in (a, b) for x in found)


def test_monotone_and_constant():
    assert extrema(lambda x: (x, 1.0, 0.0), 0.0, 1.0) == []
    assert extrema(lambda x: (math.exp(x), math.exp(x), math.exp(x)), -3.0, 3.0) == []


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


def test_least():
    at, low = least(lambda x: (x - 0.3) ** 2 + 1.0, -2.0, 5.0)
    assert at == pytest.approx(0.3, abs=7e-8)  # a hundred-millionth of the interval
    assert low == 1.0


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
