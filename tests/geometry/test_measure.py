"""Bounds, lengths and moments of outlines: fine polygons, closed forms and 40 digits."""

import math

import mpmath
import numpy as np
import pytest
from drawing_witness import POINT, contours, vertices
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sampling import some
from shapely.geometry import LineString

from geneva_cli.geometry.plates import moments, total
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Cubic,
    Line,
    about,
    at,
    bounds,
    closed,
    fraction_at,
    segment_length,
)

mp = mpmath.mp.clone()
mp.dps = 40
FINE = 1e-5  # mm, of the witnesses' polygons
# Few examples: the whole file stays within seconds, and each is compared in several ways.
QUICK = settings(max_examples=some(60, 12))


def winding_area(points):
    """The shoelace sum, which also counts what a contour runs round twice or backwards."""
    x, y = np.array(points).T
    x, y = x - x[0], y - y[0]
    return 0.5 * math.fsum(x[:-1] * y[1:] - x[1:] * y[:-1])


@QUICK
@given(st.floats(-15.9, 0.7), st.sampled_from((-1.0, 1.0)), st.floats(0.0, 1.0), st.floats(0, 6.2))
def test_the_fraction_at_a_point(size, sense, fraction, turn):
    """Arcs of a chord of 40 mm, with radii from 20 mm to 1e17 mm, against circles of 50 digits."""
    bulge = sense * 10.0**size
    start, end = (3.0, 4.0), (3.0 + 40.0 * math.cos(turn), 4.0 + 40.0 * math.sin(turn))
    with mpmath.workdps(50):
        # the circle through both ends: its centre is on the chord's normal through the middle
        chord, b = mpmath.mpc(*end) - mpmath.mpc(*start), mpmath.mpf(bulge)
        sweep = 4 * mpmath.atan(b)
        centre = mpmath.mpc(*start) + chord / 2 * (1 + 1j * (1 - b * b) / (2 * b))
        there = centre + (mpmath.mpc(*start) - centre) * mpmath.expjpi(sweep * fraction / mpmath.pi)
        point = float(there.real), float(there.imag)
    # coordinates are rounded by 4e-15 mm, of at least 40 mm of length
    assert fraction_at(Arc(start, end, bulge), point) == pytest.approx(fraction, abs=4e-15)


@QUICK
@given(POINT, st.floats(0.1, 500.0), st.floats(-7.0, 7.0), st.floats(-6.2, 6.2), st.floats(0, 1))
def test_an_arc_of_any_sweep(centre, radius, start, sweep, share):
    assume(abs(sweep) > 1e-3)
    arc = about(centre, radius, start, sweep)
    # 1e-9: the shortest chord, 1e-3 radius, carries the coordinates' rounding of 1e-14 into the
    # centre a thousandfold twice over
    angle = start + share * sweep
    expected = centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)
    assert math.dist(at(arc, share), expected) < 1e-9
    assert segment_length(arc) == pytest.approx(radius * abs(sweep), rel=1e-9)
    contour = Contour("WHEEL", (arc,), closed=False)
    # the box against points on the circle: no point outside it, and a point near each side
    box = bounds(contour)
    turns = start + sweep * np.linspace(0.0, 1.0, 4001)
    x, y = centre[0] + radius * np.cos(turns), centre[1] + radius * np.sin(turns)
    seen = x.min(), y.min(), x.max(), y.max()
    step = radius * (sweep / 4000.0) ** 2  # more than a chord's height, which is an eighth of it
    for found, known, outward in zip(box, seen, (-1, -1, 1, 1), strict=True):
        assert -1e-9 < outward * (found - known) < step + 1e-9


@pytest.mark.long
@QUICK
@given(contours())
def test_areas_and_bounds_are_those_of_fine_polygons(contour):
    points = vertices(contour, FINE)
    line = LineString(points)
    # a chord is at most FINE off, over the whole length: so is the area
    assert moments(contour).area == pytest.approx(
        winding_area(points), abs=FINE * line.length + 1e-9
    )
    box, seen = bounds(contour), line.bounds
    for found, known, outward in zip(box, seen, (-1, -1, 1, 1), strict=True):
        assert -1e-9 < outward * (found - known) < FINE + 1e-9


def round_outline(x, y, r, pieces):
    """A circle as so many arcs."""
    step = 2 * math.pi / pieces
    return closed("WHEEL", [about((x, y), r, k * step, step) for k in range(pieces)])


@pytest.mark.parametrize("pieces", [2, 3, 7, 360])
def test_a_disc_with_bores_is_its_closed_form(pieces):
    """theory-loads.md 1: the sum over contours, to 1e-14."""
    D, d, e = 120.0, 18.0, 41.0
    bores = [(e * math.cos(a), e * math.sin(a), d / 2) for a in (0.0, 2.0, 3.7)]
    whole = moments(round_outline(0.0, 0.0, D / 2, pieces))
    holes = [np.negative(moments(round_outline(*b, pieces))) for b in bores]
    found = total((whole, *holes))
    m, b = math.pi * D**2 / 4, math.pi * d**2 / 4
    assert found.area == pytest.approx(m - 3 * b, rel=1e-14)
    assert found.polar == pytest.approx(m * D**2 / 8 - 3 * b * (d**2 / 8 + e**2), rel=1e-14)
    cut = total(moments(Circle("BORE", (x, y), r)) for x, y, r in bores)
    assert found.polar == pytest.approx(whole.polar - cut.polar, rel=1e-14)
    away = -b * sum(x for x, _, _ in bores) / (m - 3 * b)
    assert found.centroid[0] == pytest.approx(away, rel=1e-12)  # the disc's own 0 is a difference


def of_cap(start, end, bulge):
    """The cap between an arc and its chord, by the centre and the angles, in 40 digits."""
    p, q = mp.mpc(*start), mp.mpc(*end)
    sweep = 4 * mp.atan(mp.mpf(bulge))
    centre = (p + q) / 2 + mp.mpc(0, 1) * (q - p) / 2 / mp.tan(sweep / 2)
    r, first = abs(p - centre), mp.arg(p - centre)

    def integral(f):
        return mp.quad(
            lambda t: f(centre + r * mp.expj(first + t), r * mp.expj(first + t)), [0, sweep]
        )

    def green(power):  # of |z|^power by Green: |z|^power (x dy - y dx) / (power + 2)
        arc = integral(lambda z, v: abs(z) ** power * (mp.conj(z) * v).real)
        line = mp.quad(
            lambda t: abs(p + t * (q - p)) ** power * (mp.conj(p + t * (q - p)) * (q - p)).imag,
            [0, 1],
        )
        return (arc - line) / (power + 2)

    return green(0), green(2)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("bulge", [1e-9, -1e-4, 0.01, 0.2, -0.41, 1.0, 3.0])
def test_an_arc_however_flat(bulge):
    start, end = (3.0, -1.0), (4.5, 2.0)
    outline = Contour("W", (Arc(start, end, bulge), Line(end, start)))
    exact = of_cap(start, end, bulge)
    got = moments(outline)
    # 1e-15 of the triangles to the chord, of which the cap is the difference where it is flat
    assert got.area == pytest.approx(float(exact[0]), rel=1e-14, abs=1e-14)
    assert got.polar == pytest.approx(float(exact[1]), rel=1e-14, abs=1e-13)


@pytest.mark.long
def test_a_cubic_is_its_polynomial():
    cubic = Cubic((1.0, 0.0), (2.0, 3.0), (-1.0, 2.5), (0.5, 1.0))
    outline = Contour("W", (cubic, Line(cubic.end, cubic.start)))
    c = [mp.mpc(*p) for p in cubic]

    def z(t):
        return sum(mp.binomial(3, k) * (1 - t) ** (3 - k) * t**k * c[k] for k in range(4))

    arc = mp.quad(lambda t: abs(z(t)) ** 2 * (mp.conj(z(t)) * mp.diff(z, t)).imag, [0, 1])
    line = mp.quad(
        lambda t: abs(c[3] + t * (c[0] - c[3])) ** 2 * (mp.conj(c[3]) * c[0]).imag, [0, 1]
    )
    assert moments(outline).polar == pytest.approx(float(arc + line) / 4, rel=1e-13)
    chord = mp.quad(lambda t: (mp.conj(c[3]) * (c[0] - c[3])).imag, [0, 1])
    under = mp.quad(lambda t: (mp.conj(z(t)) * mp.diff(z, t)).imag, [0, 1])
    assert moments(outline).area == pytest.approx(float(under + chord) / 2, rel=1e-13)
