"""Curves as pieces: counts, tangents, ends and errors, measured by other means than the fit's."""

import math

import numpy as np
import pytest
import shapely
from scipy.special import fresnel

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.fit import arcs, cubics
from geneva_cli.geometry.shapes import Arc, Cubic, Line

KINDS = [arcs, cubics]
SEEN = 200  # the polylines that errors are measured with stray by the tolerance over this


def directed(points, ways):
    return points, ways / np.hypot(*ways.T)[:, None]


def ellipse(a, b):
    def curve(t):
        c, s = np.cos(t), np.sin(t)
        return directed(np.column_stack((a * c, b * s)), np.column_stack((-a * s, b * c)))

    return curve


def line(t):
    return 100.0 + t[:, None] * [0.6, 0.8], np.tile([0.6, 0.8], (len(t), 1))


def involute(t):
    """Of a circle of 30 mm: at t = 0 it starts with infinite curvature and without speed."""
    c, s = np.cos(t), np.sin(t)
    return 30.0 * np.column_stack((c + t * s, s - t * c)), np.column_stack((c, s))


def clothoid(t):
    """By Fresnel's integrals; straight in the middle, where it has its inflection."""
    s, c = fresnel(t / (40.0 * math.sqrt(math.pi)))
    angle = t * t / 3200.0
    along = np.column_stack((np.cos(angle), np.sin(angle)))
    return 40.0 * math.sqrt(math.pi) * np.column_stack((c, s)), along


def wave(t):
    points = np.column_stack((t, 5.0 * np.sin(t / 5.0)))
    return directed(points, np.column_stack((np.ones(len(t)), np.cos(t / 5.0))))


def cusp(t):
    """Half of a semicubical parabola: one cubic with a handle of no length."""
    ways = np.column_stack((np.full(len(t), 2.0), 3.0 * t))
    return directed(np.column_stack((t * t, t**3)), ways)


def bend(t):
    """A straight line that goes over into a cubic, with continuous curvature."""
    y = np.where(t > 0.0, t, 0.0)
    ways = np.column_stack((np.ones(len(t)), 3e-3 * y * y))
    return directed(np.column_stack((t, 1e-3 * y**3)), ways)


CURVES = {
    "ellipse": (ellipse(50.0, 20.0), 0.0, 2.0 * math.pi),
    "involute": (involute, 0.0, 2.0),
    "clothoid": (clothoid, -60.0, 90.0),
    "wave": (wave, 0.0, 60.0),
    "cusp": (cusp, 0.0, 3.0),
    "bend": (bend, -20.0, 20.0),
}


def places(piece, count):
    """Points of a piece by its definition, complex."""
    u = np.linspace(0.0, 1.0, count)
    if isinstance(piece, Cubic):
        knots = [complex(*p) for p in piece]
        while len(knots) > 1:  # de Casteljau
            knots = [(1.0 - u) * p + u * q for p, q in zip(knots, knots[1:], strict=False)]
        return knots[0]
    start, end = complex(*piece.start), complex(*piece.end)
    half = 0.5 * piece.sweep if isinstance(piece, Arc) else 0.0
    if half == 0.0:
        return start + (end - start) * u
    # The chord to a share u of the arc: its length by the sine, its direction by the angle
    return start + (end - start) * np.exp(1j * half * (u - 1.0)) * np.sin(half * u) / math.sin(half)


def ways(piece):
    """The tangents at both ends, complex, and how far rounding may turn them, radians."""
    start, end = complex(*piece.start), complex(*piece.end)
    half = 0.5 * piece.sweep if isinstance(piece, Arc) else 0.0
    first, last = (end - start) * np.exp(-1j * half), (end - start) * np.exp(1j * half)
    if isinstance(piece, Cubic):
        first, last = complex(*piece.first) - start, end - complex(*piece.second)
    # An ulp or two in each end, and the angle's own
    size = max(abs(start), abs(end), 1.0)
    return first, last, 8.0 * math.ulp(size) / min(abs(first), abs(last)) + 4e-15


def farthest(points, others):
    """The greatest distance from points to a polyline through others, by shapely."""
    corners = np.column_stack((others.real, others.imag))
    chords = shapely.STRtree(shapely.linestrings(np.stack((corners[:-1], corners[1:]), axis=1)))
    where = shapely.points(points.real, points.imag)
    return float(chords.query_nearest(where, return_distance=True, all_matches=False)[1].max())


def stray(curve, a, b, pieces, tolerance):
    """The greatest distance between curve and pieces, both ways, to the tolerance over SEEN."""
    coarse, tangents = (v @ [1, 1j] for v in curve(np.linspace(a, b, 4001)))
    steps, turns = np.abs(np.diff(coarse)), np.abs(np.angle(tangents[1:] / tangents[:-1]))
    # Chords in even steps of the parameter; one of length h that turns by k misses by h k / 8.
    count = 4000 * math.sqrt(float((steps * turns).max()) * SEEN / (8.0 * tolerance))
    assert count < 4e6
    z = curve(np.linspace(a, b, max(4001, math.ceil(count))))[0] @ [1, 1j]
    z = z[np.concatenate(([True], np.diff(z) != 0))]
    runs = []
    for piece in pieces:
        first, last, _ = ways(piece)
        bow = abs(np.angle(last / first)) * abs(complex(*piece.end) - complex(*piece.start))
        # Twice as many, as a cubic neither bends nor runs evenly
        each = math.ceil(2.0 * math.sqrt(2.0 * bow * SEEN / (8.0 * tolerance)))
        runs.append(places(piece, 2 if isinstance(piece, Line) else each + 10)[:-1])
    found = np.concatenate(runs)
    found = np.append(found, complex(*pieces[-1].end))
    return max(farthest(z, found), farthest(found, z))


def check(curve, a, b, pieces, tolerance, kind):
    """Ends to the last bit, tangents, and the error."""
    assert pieces[0].start == tuple(curve(np.array([a]))[0][0])
    assert pieces[-1].end == tuple(curve(np.array([b]))[0][0])
    for one, other in zip(pieces, pieces[1:], strict=False):
        assert one.end == other.start
    directions = [ways(piece) for piece in pieces]
    for one, other in zip(directions, directions[1:], strict=False):
        assert abs(np.angle(other[0] / one[1])) <= one[2] + other[2]
    start, end = curve(np.array([a, b]))[1] @ [1, 1j]
    assert abs(np.angle(directions[0][0] / start)) <= directions[0][2]
    assert abs(np.angle(directions[-1][1] / end)) <= directions[-1][2]
    # SEEN both ways
    assert stray(curve, a, b, pieces, tolerance) <= tolerance * (1.0 + 2.0 / SEEN)


@pytest.mark.parametrize("kind", KINDS)
def test_a_straight_stretch_is_one_piece(kind):
    found = kind(line, 0.0, 70.0, 1e-3)
    assert [type(piece) for piece in found] == [Cubic if kind is cubics else Line]
    check(line, 0.0, 70.0, found, 1e-3, kind)


@pytest.mark.parametrize("kind", KINDS)
def test_a_curve_that_leaps_is_refused_at_once(kind):
    """As the wall of a groove does whose roller is too large: it was tried with 200,000 pieces."""

    def leaping(t):
        points = np.stack((t, np.where(t < math.e, 0.0, 0.1)), 1)
        return points, np.stack((np.ones_like(t), np.zeros_like(t)), 1)

    with pytest.raises(GenevaError, match="leaps"):
        kind(leaping, 0.0, 10.0, 1e-3)
    kind(leaping, 0.0, 2.7, 1e-3)


@pytest.mark.sampled(32)
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", CURVES)
def test_ends_tangents_and_errors(name, kind, tolerance):
    curve, a, b = CURVES[name]
    check(curve, a, b, kind(curve, a, b, tolerance), tolerance, kind)
