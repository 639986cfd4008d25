"""Roots and stationary points of batches of functions: to the last bit, none stepped over."""

import math

import numpy as np
import pytest
from numpy.polynomial import polynomial

from geneva_cli.numerics import extrema as extrema_module
from geneva_cli.numerics import newton as many
from geneva_cli.numerics.extrema import Rough, greatest_sizes, stationary_points
from geneva_cli.numerics.roots import root

pytestmark = pytest.mark.filterwarnings("error")  # nothing is said of designs that are no numbers


def column(values):
    return np.array(values, dtype=float)[:, None]


def polynomials(c):
    """One polynomial a row of c, by Horner's rule."""

    def f(x, which, order):
        rows, out = c[which], []
        for _ in range(order + 1):
            value = 0.0 * x
            for k in reversed(range(rows.shape[1])):
                value = value * x + rows[:, k : k + 1]
            out.append(value)
            rows = rows[:, 1:] * np.arange(1, rows.shape[1])
        return out

    return f


def lorentzians(middle, width):
    def f(x, which, order):
        t = (x - middle[which]) / width[which]
        d = 1.0 + t * t
        slope = -2.0 * t / (d * d) / width[which]
        return [1.0 / d, slope, (6.0 * t * t - 2.0) / d**3 / width[which] ** 2][: order + 1]

    return f


def extrema(f, a, b):
    """The stationary points of one function: f(x) is its value, slope and bend."""

    def curves(x, which, order):
        return [v + 0.0 * x for v in f(x)[: order + 1]]

    return stationary_points(curves, column([a]), column([b])).x.tolist()


@pytest.fixture(scope="module")
def random_polynomials():
    return np.random.default_rng(3).normal(size=(3000, 8))


def test_stationary_points_of_polynomials(random_polynomials):
    """Against the eigenvalues of companion matrices: those, and nothing else.

    A hill and a hollow beside each other may be missed if their heights are the same within the
    hundredth of the range that the scan lets a cubic miss. Of these polynomials, two such are.
    """
    f = polynomials(random_polynomials)
    n = len(random_polynomials)
    found = stationary_points(f, column([-1.5] * n), column([1.5] * n))
    assert (np.diff(found.which) >= 0).all()
    unseen = 0
    for i, c in enumerate(random_polynomials):
        roots = polynomial.polyroots(polynomial.polyder(c))
        sure = np.sort(roots[(roots.imag == 0.0) & (abs(roots) < 1.5)].real)
        mine = found.x[found.which == i]
        assert (np.diff(mine) > 0.0).all()
        near = [abs(sure - x).argmin() for x in mine]
        # the eigenvalues' own error, which is the greater the nearer two of them are
        assert mine == pytest.approx(sure[near], rel=0.0, abs=1e-9)
        lost = np.delete(sure, near)
        assert len(lost) in (0, 2)
        if len(lost):
            unseen += 1
            span = np.ptp(polynomial.polyval(np.linspace(-1.5, 1.5, 301), c))
            assert np.ptp(polynomial.polyval(lost, c)) < 1e-2 * span
    assert unseen <= 2


def test_greatest_size_of_polynomials(random_polynomials):
    """The greatest of the ends and of the companion matrix's real parts: that of no real root is
    a value of the function as well, so it is never above.
    """
    f = polynomials(random_polynomials)
    n = len(random_polynomials)
    size, x = greatest_sizes(f, column([-1.5] * n), column([1.5] * n))
    for i, c in enumerate(random_polynomials):
        roots = polynomial.polyroots(polynomial.polyder(c)).real
        places = np.concatenate(([-1.5, 1.5], roots[abs(roots) < 1.5]))
        # 2e-14: the rounding of terms that add up to 1.5^7 times the peak and cancel
        assert size[i] == pytest.approx(abs(polynomial.polyval(places, c)).max(), rel=2e-14)
        assert abs(polynomial.polyval(x[i], c)) == pytest.approx(size[i], rel=2e-14)


def test_greatest_size_by_a_rough_scan(random_polynomials):
    """Where a scan's functions are wrong by 1e-10, the sizes told are the functions' own."""
    c = random_polynomials[:500]
    f, n = polynomials(c), len(c)
    wrong = polynomials(c * (1.0 + 1e-10 * np.sin(np.arange(c.size)).reshape(c.shape)))
    pieces = column([-1.5] * n), column([0.1] * n), column([1.5] * n)
    # the terms of one add up to a hundred times its greatest size at most
    size, x = greatest_sizes(f, *pieces, rough=Rough(wrong, 1e-8))
    assert size == pytest.approx(greatest_sizes(f, pieces[0], pieces[2])[0], rel=2e-14)
    own = abs(f(x[:, None], np.arange(n), 0)[0][:, 0])
    assert size == pytest.approx(own, rel=2e-14)


@pytest.mark.parametrize("width", [1e-2, 1e-4, 1e-6, 1e-9])
@pytest.mark.parametrize("middle", [0.3, 0.71828, -0.999])
def test_narrow_peak(width, middle):
    """A peak a billionth of the interval wide, by its tails alone."""
    found = stationary_points(
        lorentzians(column([middle]), column([width])), column([-1]), column([1])
    )
    assert found.x == pytest.approx([middle], rel=0.0, abs=2.3e-16)  # one unit of 1


def test_narrow_peak_beside_a_broad_one():
    """What a scan can see: tails above a hundredth of the range, from half an interval away."""
    peaks = lorentzians(column([0.4321, -0.5]), column([0.005, 0.1]))

    def f(x, which, order):
        both = (peaks(x, np.full(len(x), i), order) for i in (0, 1))
        return [p + q for p, q in zip(*both, strict=True)]

    found = stationary_points(f, column([-1.0]), column([1.0])).x
    assert len(found) == 3  # two peaks and the valley between
    # each moves the other's top by the slope of its tail times width^2/2
    assert found[0] == pytest.approx(-0.5, abs=1e-6)
    assert found[2] == pytest.approx(0.4321, abs=1e-5)


@pytest.mark.parametrize("n", [1, 3, 7, 31])  # two and a half half-waves an interval of the scan
def test_every_wave(n):
    found = extrema(
        lambda x: (np.sin(n * x), n * np.cos(n * x), -n * n * np.sin(n * x)), 0.0, math.pi
    )
    assert found == pytest.approx([(k + 0.5) * math.pi / n for k in range(n)], abs=1e-15)


def test_stationary_points_on_scan_points_are_found_once():
    def f(x):
        return x**4 - 2.0 * x * x, 4.0 * x**3 - 4.0 * x, 12.0 * x * x - 4.0

    # -1, 0 and 1 are places of the scan of [-3, 3]
    assert extrema(f, -3.0, 3.0) == [-1.0, 0.0, 1.0]


def test_stationary_points_in_an_interval_without_a_middle():
    """As of a motion over the least double there is: halves of it are its ends."""
    least = math.ulp(0.0)
    for a, b in ((0.0, least), (1.0, 1.0 + math.ulp(1.0))):
        found = extrema(lambda x, a=a, b=b: (0.0, (x - a) * (b - x), 1.0), a, b)
        assert all(x in (a, b) for x in found)


def test_monotone_and_constant():
    assert extrema(lambda x: (x, 1.0, 0.0), 0.0, 1.0) == []
    assert extrema(lambda x: (np.exp(x), np.exp(x), np.exp(x)), -3.0, 3.0) == []
    assert extrema(lambda x: (2.0, 0.0, 0.0), 0.0, 1.0) == []


@pytest.mark.parametrize("solver", [stationary_points, greatest_sizes])
def test_blocks_and_groups_change_nothing(random_polynomials, monkeypatch, solver):
    f, n = polynomials(random_polynomials), len(random_polynomials)
    whole = solver(f, column([-1.5] * n), column([1.5] * n))
    monkeypatch.setattr(extrema_module, "BLOCK", 7)
    monkeypatch.setattr(extrema_module, "GROUP", 91)
    for a, b in zip(whole, solver(f, column([-1.5] * n), column([1.5] * n)), strict=True):
        assert np.array_equal(a, b)


def test_narrow_peaks_among_broad_ones():
    """Peaks from as broad as the span to a billionth of it: each refined as far as it needs."""
    width = 10.0 ** -np.linspace(0.0, 9.0, 181)[:, None]
    middle = np.linspace(-0.9, 0.7, 181)[:, None]
    calls = []

    def f(x, which, order):
        calls.append(x.size)
        return lorentzians(middle, width)(x, which, order)

    size, x = greatest_sizes(f, column([-1.0] * 181), column([1.0] * 181))
    assert x == pytest.approx(middle[:, 0], rel=0.0, abs=2.3e-16)  # one unit of 1
    assert size == pytest.approx(1.0, rel=2.3e-16)
    assert sum(calls) < 181 * 300  # 30 levels about one place, not 2^30 places


def test_designs_that_are_not_numbers():
    """They have no answer, and the others have the very answers that they have alone."""
    A = column([1.0, math.nan, 3.0, math.inf, 2.0])

    def f(x, which, order):
        a = A[which]
        return [np.sin(a * x), a * np.cos(a * x), -a * a * np.sin(a * x)][: order + 1]

    a, b = np.zeros((5, 1)), np.ones((5, 1))
    size, x = greatest_sizes(f, a, b)
    assert np.isnan(size).tolist() == np.isnan(x).tolist() == [False, True, False, True, False]
    assert size[[0, 2, 4]].tolist() == [math.sin(1.0), 1.0, 1.0]
    assert x[[0, 2, 4]] == pytest.approx([1.0, math.pi / 6.0, math.pi / 4.0], rel=2.3e-16)
    assert stationary_points(f, a, b).which.tolist() == [2, 4]
    assert [found.shape for found in greatest_sizes(f, a[:0], b[:0])] == [(0,), (0,)]
    assert stationary_points(f, a[:0], b[:0]).x.shape == (0,)


def test_the_first_of_equals():
    def f(x, which, order):
        return [np.sin(x), np.cos(x), -np.sin(x)][: order + 1]

    a = column([0.0, 1.0, -0.5 * math.pi, -1.0])
    b = column([7.0, 8.0, 0.5 * math.pi, 1.0])
    size, x = greatest_sizes(f, a, b)
    assert size == pytest.approx([1.0, 1.0, 1.0, math.sin(1.0)], rel=2.3e-16)
    assert x == pytest.approx([math.pi / 2, math.pi / 2, -math.pi / 2, -1.0], rel=2.3e-16)


def test_a_summit_beside_a_break_that_is_as_high():
    """The summit has the place where it is more than rounding away; and 0 that of 1e-47."""
    top = column([1e-8, -1e-8, 0.01, 1e-14, 1e-47, -1e-47])

    def f(x, which, order):
        return [2.0 - (x - top[which]) ** 2, -2.0 * (x - top[which]), 0.0 * x - 2.0][: order + 1]

    ends = [column([end] * len(top)) for end in (-1.0, 0.0, 1.0)]
    size, x = greatest_sizes(f, *ends)
    assert size == pytest.approx(2.0, rel=2.3e-16)
    assert x.tolist() == [pytest.approx(1e-8), pytest.approx(-1e-8), 0.01, 0.0, 0.0, 0.0]


@pytest.mark.parametrize("c", [0.3, 0.01, 1e-3])
def test_a_stationary_end_hides_nothing(c):
    """Top at -c, valley at 0 where the span ends: the slope's sign beside 0 is the bend's."""
    curve = polynomials(np.array([[0.0, 0.0, 2.0 * c * c, 0.0, -1.0]]))
    # c exact, but for the two roundings of the slope's coefficients
    found = stationary_points(curve, column([-1.0]), column([0.0]))
    assert found.x == pytest.approx([-c, 0.0], rel=1e-15)
    found = stationary_points(curve, column([0.0]), column([1.0]))
    assert found.x == pytest.approx([c], rel=1e-15)


def test_newton():
    """Newton, a bend that misleads it, a slope that is none, and no number."""
    rate = np.array([1.0, 50.0, 1e3, math.nan])
    place = np.array([0.3, 0.1, -0.7, 0.0])

    def f(x, which):
        t = rate[which] * (x - place[which])
        return np.arctan(t), rate[which] / (1.0 + t * t)

    found = many.find_roots(f, np.full(4, -9.0), np.full(4, 9.0))
    assert found[:3] == pytest.approx(place[:3], rel=2.3e-16)
    assert math.isnan(found[3])
    flat = many.find_roots(lambda x, which: (x - 0.1, 0.0 * x), np.array([0.0]), np.array([1.0]))
    assert flat[0] == root(lambda x: (x - 0.1, 0.0), 0.0, 1.0)
    falling = many.find_roots(lambda x, _: (0.25 - x, 0.0 * x - 1.0), np.zeros(2), np.ones(2))
    assert falling.tolist() == [0.25, 0.25]
