"""Curves as pieces: counts, tangents, ends and errors, measured by other means than the fit's."""

import math
import subprocess
import sys

import numpy as np
import pytest
import repo
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import some
from scipy.spatial import cKDTree
from scipy.special import fresnel
from words import load

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.fit import arcs, cubics
from geneva_cli.geometry.shapes import Arc, Cubic, Line
from geneva_cli.motion.pitch_curve import pitch, pitch_at_retrace, retraces

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
    "flat ellipse": (ellipse(50.0, 1.0), 0.0, 2.0 * math.pi),
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


def farthest(points, others, tolerance):
    """The greatest distance from points to a polyline through others.

    The chords at the nearest corner come first, being the nearest nearly always. Where they are
    farther than the tolerance, all the chords are asked: beside long ones another's corner may be
    nearer.
    """
    corners = np.column_stack((others.real, others.imag))
    _, near = cKDTree(corners).query(np.column_stack((points.real, points.imag)))
    best = np.full(len(points), np.inf)
    for i in (near - 1, near):
        i = np.clip(i, 0, len(others) - 2)
        chord, way = others[i + 1] - others[i], points - others[i]
        share = np.clip((way / chord).real, 0.0, 1.0)
        best = np.minimum(best, np.abs(way - share * chord))
    if (far := best > tolerance).any():
        chords = shapely.linestrings(np.stack((corners[:-1], corners[1:]), axis=1))
        asked = shapely.points(points.real[far], points.imag[far])
        best[far] = shapely.STRtree(chords).query_nearest(
            asked, return_distance=True, all_matches=False
        )[1]
    return float(best.max())


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
    return max(farthest(z, found, tolerance), farthest(found, z, tolerance))


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


@pytest.mark.parametrize("turn", [0.3, 1.0, 3.0, 4.5, 6.28, 2.0 * math.pi])
def test_a_circle_is_an_arc_or_two(turn):
    found = arcs(ellipse(25.0, 25.0), 0.5, 0.5 + turn, 1e-6)
    assert len(found) == (1 if turn < math.pi else 2)
    # The fit's arcs are joined where they agree to 16 ulp of 25 mm.
    assert sum(arc.sweep for arc in found) == pytest.approx(turn, abs=1e-13)
    for arc in found:
        assert arc.radius == pytest.approx(25.0, abs=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_a_straight_stretch_is_one_piece(kind):
    found = kind(line, 0.0, 70.0, 1e-3)
    assert [type(piece) for piece in found] == [Cubic if kind is cubics else Line]
    check(line, 0.0, 70.0, found, 1e-3, kind)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("tolerance", [1e-14, 1e-13, 0.0, -1.0, math.nan])
def test_a_tolerance_beyond_double_precision_is_refused(kind, tolerance):
    with pytest.raises(GenevaError, match="finer than double precision can show"):
        kind(ellipse(25.0, 20.0), 0.0, 1.0, tolerance)


@pytest.mark.parametrize("kind", KINDS)
def test_a_curve_that_leaps_is_refused_at_once(kind):
    """As the wall of a groove does whose roller is too large: it was tried with 200,000 pieces."""

    def leaping(t):
        points = np.stack((t, np.where(t < math.e, 0.0, 0.1)), 1)
        return points, np.stack((np.ones_like(t), np.zeros_like(t)), 1)

    with pytest.raises(GenevaError, match="leaps"):
        kind(leaping, 0.0, 10.0, 1e-3)
    kind(leaping, 0.0, 2.7, 1e-3)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", CURVES)
def test_ends_tangents_and_errors(name, kind, tolerance):
    curve, a, b = CURVES[name]
    check(curve, a, b, kind(curve, a, b, tolerance), tolerance, kind)


@settings(max_examples=some(25, 10))
@given(
    st.lists(st.floats(-1.0, 1.0), min_size=10, max_size=10),
    st.sampled_from([1e-1, 1e-2, 1e-3, 1e-4]),
    st.sampled_from(KINDS),
)
def test_random_smooth_curves(amounts, tolerance, kind):
    order = np.arange(1.0, 6.0)
    x, y = np.array(amounts[:5]) / order**2, np.array(amounts[5:]) / order

    def curve(t):
        # x' stays above 10 - 10 * 0.4 * (1 + 1/2 + ... + 1/5) > 0
        sines, cosines = np.sin(np.outer(t, order)), np.cos(np.outer(t, order))
        points = 10.0 * np.column_stack((t + 0.4 * sines @ x, cosines @ y))
        rates = (1.0 + 0.4 * cosines @ (x * order), -sines @ (y * order))
        return directed(points, np.column_stack(rates))

    check(curve, 0.0, 4.0, kind(curve, 0.0, 4.0, tolerance), tolerance, kind)


def test_asymptotic_counts_on_a_clothoid():
    """Its curvature rises evenly, k' = 1 / A²: arcs of length h miss by k' h³ / (72 sqrt 3) at
    best, which is the peak of the third Bernoulli polynomial over 6; biarcs that meet the
    curve at their ends by k' h³ / 40.5. The held ends cost an arc or two."""
    for tolerance in (1e-3, 1e-4, 1e-5):
        best = 150.0 / (72.0 * math.sqrt(3.0) * tolerance * 1600.0) ** (1.0 / 3.0)
        assert best < len(arcs(clothoid, -60.0, 90.0, tolerance)) <= 1.03 * best + 3.0


def test_cubics_converge_with_the_sixth_power():
    counts = [len(cubics(involute, 0.0, 2.0, 10.0**-n)) for n in (4, 7, 10)]
    # A thousandth of the error takes sqrt(10) times as many, and rounding to whole ones.
    assert counts[1] <= 3.2 * counts[0] + 1
    assert counts[2] <= 3.2 * counts[1] + 1


DESIGNS = repo.DESIGNS
CURVED = [
    "internal-curved-z8",
    "modified-sine-matched",
    "modified-trapezoid-z5",
    "press-345",
    "press-curved",
    "sine-group",
    "table-law",
]


def sides(mechanism):
    """Pitch curve and flanks of a curved slot, span by span: curve, a, b.

    From the pitch curve M and its left normal N in the pin's travel: M + o N has the derivative
    (speed - o turning) T, and a corner where that changes its sign. Where the pin retraces its
    way, travel turns round at mid-motion, and the flanks keep their sides.
    """
    engagement, size = mechanism.engagements[0].through, mechanism.spec.size
    L, back = size.center_distance_mm, retraces(engagement)

    def pieces(t):
        at = pitch(engagement, np.where(t == 0.0, 0.5 * engagement.entry_deg, t) if back else t)
        rows = [np.array(row) for row in at[:6]]
        if back:
            for row, value in zip(rows, pitch_at_retrace(engagement), strict=False):
                row[t == 0.0] = value
        return rows

    for side in (-1.0, 0.0, 1.0):
        offset = side * (mechanism.roller_radius_mm + size.allowances.slot_clearance_mm) / L

        def along(t, outwards, offset=offset):
            *_, speed, turning = pieces(t)
            return speed - (-offset if outwards else offset) * turning

        ends = [engagement.entry_deg, 0.0] + (
            [] if engagement.motion.symmetric else [engagement.exit_deg]
        )
        for a, b in zip(ends, ends[1:], strict=False):
            outwards = back and a >= 0.0
            grid = np.linspace(a, b, 2049)[1:-1]
            sign = np.sign(along(grid, outwards))
            cuts = [a]
            for i in np.flatnonzero(sign[1:] != sign[:-1]):
                low, high = grid[i], grid[i + 1]
                for _ in range(60):
                    middle = 0.5 * (low + high)
                    same = np.sign(along(np.array([middle]), outwards))[0] == sign[i]
                    low, high = (middle, high) if same else (low, middle)
                cuts.append(float(low))
            for c, d in zip(cuts, [*cuts[1:], b], strict=True):
                ahead = float(np.sign(along(np.array([0.5 * (c + d)]), outwards))[0])

                def curve(t, o=-offset if outwards else offset, ahead=ahead, outwards=outwards):
                    x, y, tx, ty, _, _ = pieces(t)
                    turned = np.where((t == 0.0) & outwards, -1.0, 1.0)
                    tx, ty = turned * tx, turned * ty
                    points = L * np.column_stack((x - o * ty, y + o * tx))
                    return points, ahead * np.column_stack((tx, ty))

                yield curve, c, d


def greedy(curve, a, b, tolerance):
    """How many of the longest chords that stay within the tolerance cover the curve."""
    z = curve(np.linspace(a, b, 20001))[0] @ [1, 1j]

    def good(i, j):
        way, chord = z[i + 1 : j : max(1, (j - i) // 200)] - z[i], z[j] - z[i]
        share = np.clip((way / chord).real, 0.0, 1.0)
        return len(way) == 0 or np.abs(way - share * chord).max() <= tolerance

    count, i = 0, 0
    while i < len(z) - 1:
        low, high = i + 1, len(z)
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if good(i, middle) else (low, middle)
        count, i = count + 1, low
    return count


@pytest.mark.sampled(7)
@pytest.mark.parametrize("name", CURVED)
def test_few_pieces_on_the_curved_slots(name):
    """At 1e-3 mm: half as many arcs as the fewest chords, a tenth of cubics.

    A span that takes one chord takes a biarc, as the ends' tangents are the curve's.
    """
    for curve, a, b in sides(load(str(DESIGNS / f"{name}.toml"))):
        fewest = greedy(curve, a, b, 1e-3)
        for kind, most in ((arcs, max(0.5 * fewest, 2)), (cubics, math.ceil(0.1 * fewest))):
            found = kind(curve, a, b, 1e-3)
            assert len(found) <= most
            check(curve, a, b, found, 1e-3, kind)


def test_no_design_with_a_curved_slot_is_left_out():
    curved = []
    for path in sorted(DESIGNS.glob("*.toml")):
        mechanism = load(str(path))
        size = mechanism.spec.size
        if mechanism.spec.motion is not None and size is not None:
            engagement = mechanism.engagements[0].through
            if (
                engagement.slot.axis(engagement.entry_deg) is None
                and size.roller_radius_mm is not None
            ):
                curved.append(path.stem)
    assert curved == CURVED


def test_it_does_not_load_scipy():
    said = "import sys, geneva_cli.geometry.fit;print([m for m in sys.modules if 'scipy' in m])"
    run = subprocess.run([sys.executable, "-c", said], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
