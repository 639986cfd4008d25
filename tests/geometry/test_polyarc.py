"""Exact distances to outlines, against fine polygons and 30 digits of the textbook's formulas."""

import math

import mpmath
import numpy as np
import pytest
import shapely
from drawing_witness import contours, polygon, vertices
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sampling import some
from shapely.geometry import Polygon

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import Arc, Contour, Line, backwards, closed

FINE = 1e-5  # mm, how far the witnesses' polygons stray from the arcs
QUICK = settings(max_examples=some(40, 12))
SIDE = np.linspace(-150, 150, some(37, 19))
GRID = np.stack(np.meshgrid(SIDE, SIDE), -1)
GRID = GRID.reshape(-1, 2) + np.array([0.0371, 0.0129])  # off the corners' own coordinates


def polygon_distances(polygons: list[Polygon], points: np.ndarray) -> np.ndarray:
    """Signed by what shapely says is inside; of several polygons the first is the outside."""
    whole = Polygon(polygons[0].exterior, [p.exterior for p in polygons[1:]])
    where = shapely.points(points)
    away = shapely.distance(whole.boundary, where)
    return np.where(shapely.contains(whole, where), -away, away)


def counterclockwise(contour: Contour) -> Contour:
    """The contour so directed. That arcs cross at a narrow tip only a fine polygon sees."""
    fine = polygon(contour, FINE)
    assume(fine.is_valid)
    return contour if fine.exterior.is_ccw else backwards(contour)


@pytest.mark.long
@QUICK
@given(contours("la"))
def test_random_contours_against_polygons(contour: Contour) -> None:
    assume(polygon(contour, 1e-3).is_valid)
    contour = counterclockwise(contour)
    found = Polyarc([contour]).signed(GRID)
    wanted = polygon_distances([polygon(contour, FINE)], GRID)
    # A point nearer to the outline than the polygon strays may be on either side of it.
    assert np.abs(np.abs(found) - np.abs(wanted)).max() < FINE
    assert np.array_equal(found < 0.0, wanted < 0.0) or np.abs(found - wanted).max() < 2.0 * FINE


@QUICK
@given(contours("la"), st.floats(1e-3, 1.0), st.floats(0.5, 40.0))
def test_samples_are_on_the_outline_and_dense(
    contour: Contour, sagitta: float, longest: float
) -> None:
    boundary = Polyarc([contour])
    points = boundary.samples(sagitta, longest)
    corners = {segment.start for segment in contour.segments}
    assert corners <= {(x, y) for x, y in points}
    # 200 mm, and arcs of some metres: a few units in the last place of 1e4 mm
    assert np.abs(boundary.signed(points)).max() < 1e-11
    steps = np.hypot(*np.diff(np.vstack((points, points[:1])), axis=0).T)
    assert steps.max() <= longest * (1.0 + 1e-9)
    # Between the samples the outline strays from their chords by no more than the sagitta.
    chords = shapely.linestrings(np.vstack((points, points[:1])))
    fine = shapely.points(np.array(vertices(contour, 1e-3 * sagitta)))
    assert shapely.distance(chords, fine).max() <= sagitta * (1.0 + 1e-6)


@pytest.mark.parametrize("flip", [1.0, -1.0])
@pytest.mark.parametrize("turn_deg", [1e-3, 1.0, 60.0, 90.0, 150.0, 179.0, 179.999])
@pytest.mark.parametrize("bend", [0.0, 0.2, -0.2])
def test_corners(flip: float, turn_deg: float, bend: float) -> None:
    """Straight and arced edges that meet in a corner, convex (flip = 1) and hollow: all around it
    the sign is right. The witness is the angle from the outgoing edge to the incoming one."""
    turn = math.radians(turn_deg)
    before, after = (-5.0, 0.0), (5.0 * math.cos(turn), 5.0 * math.sin(turn))
    # The edges' own tangents at the corner are those of the straight ones.
    ways = [(math.pi, before), (turn, after)]
    tips = [
        (d * math.cos(a + s * 2.0 * math.atan(bend)), d * math.sin(a + s * 2.0 * math.atan(bend)))
        for (a, _), d, s in zip(ways, (5.0, 5.0), (-1.0, 1.0), strict=True)
    ]
    edges = [_edge(tips[0], (0.0, 0.0), bend), _edge((0.0, 0.0), tips[1], bend)]
    far = (30.0, -100.0)  # what closes the contour passes the corner at millimetres
    contour = closed("X", [*edges, Line(tips[1], far), Line(far, tips[0])])
    boundary = Polyarc([contour if flip > 0.0 else backwards(contour)])
    angles = np.linspace(0.0, math.tau, 720, endpoint=False) + 1e-3
    small = 1e-6  # mm, where the arcs turn by 1e-7; directions near an edge are left out
    points = small * np.column_stack((np.cos(angles), np.sin(angles)))
    inside = (angles > turn) & (angles < math.pi)
    clear = np.minimum.reduce([np.abs(angles - a) for a in (turn, math.pi, turn + math.tau)]) > 1e-3
    found = boundary.signed(points) < 0.0
    assert np.array_equal(found[clear], (inside if flip > 0.0 else ~inside)[clear])


def _edge(start: tuple[float, float], end: tuple[float, float], bend: float) -> Line | Arc:
    return Arc(start, end, bend) if bend else Line(start, end)


@pytest.mark.sampled(16)
@pytest.mark.parametrize("sagitta", [9.3, 2.5, 0.22, *[10.0**-n for n in range(1, 14, 3)]])
@pytest.mark.parametrize("flip", [1.0, -1.0])
def test_arcs_of_any_bend(sagitta: float, flip: float) -> None:
    """Also a fitted wall at an inflection: radii up to 31 million km, against 50 digits."""
    arc = Arc((3.0, 1.0), (7.0, 4.0), flip * 2.0 * sagitta / 5.0)
    boundary = Polyarc([closed("X", [arc, Line((7.0, 4.0), (3.0, 1.0))])])
    wall = boundary.subset(np.array([0]))
    share = np.linspace(-0.3, 1.3, 81)[:, None]
    points = np.concatenate(
        [(3.0, 1.0) + share * (4.0, 3.0) + off * np.array((-0.6, 0.8)) for off in (-4.0, 0.3, 1e-3)]
    )
    with mpmath.workdps(50):
        wanted = [exact_side(arc, x, y) for x, y in points.tolist()]
    distance, side, on_piece, _ = wall.distances(points[:, 0], points[:, 1])
    # the sector of the centre: at its ends rounding decides
    clear = np.abs(np.array([inside for _, _, inside in wanted])) > 1e-12
    facing = np.array([inside > 0.0 for _, _, inside in wanted])
    assert np.array_equal(on_piece[clear], facing[clear])
    # 10 mm: a few units in the last place
    assert np.abs(side - [float(exact) for exact, _, _ in wanted]).max() < 1e-14
    assert np.abs(distance - [float(away) for _, away, _ in wanted]).max() < 1e-14
    on = wall.samples(1e-4, 0.1)
    assert np.abs(wall.signed(on)).max() < 1e-14


def exact_side(arc: Arc, x: float, y: float) -> tuple[mpmath.mpf, mpmath.mpf, float]:
    """The distance from the circle, positive at the left, that from the arc, and how far inside its
    sector a point is, mm along the arc."""
    z, a, b = mpmath.mpc(x, y), mpmath.mpc(*arc.start), mpmath.mpc(*arc.end)
    half = 2 * mpmath.atan(abs(mpmath.mpf(arc.bulge)))
    left = 1j * mpmath.sign(arc.bulge) * (b - a) / abs(b - a)
    radius = abs(b - a) / 2 / mpmath.sin(half)
    centre = (a + b) / 2 + left * radius * mpmath.cos(half)
    off = abs(mpmath.arg((z - centre) / -left))
    side = radius - abs(z - centre)
    away = abs(side) if off <= half else min(abs(z - a), abs(z - b))
    return mpmath.sign(arc.bulge) * side, away, float(radius * (half - off))
