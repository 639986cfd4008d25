"""Noncircular gears: pitch curves, convexity, a ratio from a file; and the cam's groove."""

import math

import numpy as np
import pytest
from shapely.affinity import rotate, translate
from shapely.geometry import LineString, Point, Polygon
from words import Drive, Keys, Motion, Spec, Wheel

from geneva_cli import Design, External, Internal, NoncircularGears
from geneva_cli.motion.groove_path import distances
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.assembly import assembly
from geneva_cli.parts.gears.gear_pair import convexity, gears_table, pitch_curve
from geneva_cli.parts.slots.groove import groove_table
from geneva_cli.spec.tables import Limits
from geneva_cli.verdict.checks import checks

TOL = 0.001


def gears(A):
    keys = Keys("noncircular-gears", A, 120.0)
    return build(Spec(Wheel(6), Drive("noncircular-gears"), keys))


def columns(table):
    return dict(zip(table.names, (np.asarray(c) for c in table.columns), strict=True))


def test_the_side_cranks_gears_are_convex_at_06_and_not_at_08():
    """Published analysis of the law as gears."""
    assert min(convexity(gears(0.6).spec.drive.gears)) > 0.0
    assert min(convexity(gears(0.8).spec.drive.gears)) < 0.0


def test_they_move_the_wheel_as_the_side_crank_does():
    ours = gears(0.6).engagements[0]
    theirs = build(Spec(Wheel(6), Drive("side-crank"), Keys("side-crank", 0.6))).engagements[0]
    assert ours.motion(-30.0).derivatives() == theirs.motion(-30.0).derivatives()


def test_pitch_curves_roll_on_each_other():
    at = columns(gears_table(gears(0.6), TOL, 2001))
    assert at["driver_radius_mm"] + at["driven_radius_mm"] == pytest.approx(120.0, rel=1e-15)
    arcs = []
    for name in ("driver", "driven"):
        x, y = at[f"{name}_x_mm"], at[f"{name}_y_mm"]
        arcs.append(np.hypot(np.diff(x), np.diff(y)))
    # equal arcs, to the chords' own error of (1/2000 turn)² relative
    assert arcs[0] == pytest.approx(arcs[1], rel=1e-5)


def test_elliptical_gears_are_ellipses():
    """Equal ellipses about their foci: r = C (1-e²)/2 / (1 -+ e cos), and always convex."""
    keys = Keys("elliptical-gears", 0.3)
    mechanism = build(Spec(Wheel(6), Drive("elliptical-gears"), keys))
    at = columns(gears_table(mechanism, TOL, 101))
    expected = 100.0 * 0.5 * (1.0 - 0.09) / (1.0 + 0.3 * np.cos(np.radians(at["input_deg"])))
    assert at["driver_radius_mm"] == pytest.approx(expected, rel=1e-14)
    assert min(convexity(mechanism.spec.drive.gears)) > 0.0


@pytest.mark.parametrize("gearing", ["external", "internal"])
def test_drawn_gears_mesh_as_the_crank_turns(gearing):
    """Turned as the machine turns them, both curves touch all the way."""
    drive = NoncircularGears(A=0.3)
    wheel = External(6) if gearing == "external" else Internal(6)
    where, C = assembly(Design(wheel, drive).mechanism), drive.gear_distance_mm
    sense = math.copysign(1.0, float(np.diff(where.crank(np.array([0.0, 1.0])))[0]))
    every = np.linspace(-np.pi, np.pi, 4000, endpoint=False)  # chords are off by 2e-5 mm
    curves = (pitch_curve(drive.gears, sense, driver, every) for driver in (False, True))
    driven, driver = (Polygon(points) for points, _ in curves)
    for input_deg in (0.0, 111.0, 301.0):
        x = math.radians(input_deg)
        turn = math.atan2(math.sin(x), 0.3 + math.cos(x))
        one = rotate(driven, sense * turn, (0, 0), use_radians=True)
        other = translate(rotate(driver, -sense * x, (0, 0), use_radians=True), C)
        assert one.distance(other) < 5e-5
        assert one.intersection(other).area < 1e-4


def missed(x, y, true: np.ndarray) -> float:
    """The greatest distance of true places x + iy from the chords between rows of a table."""
    chords = LineString(np.column_stack((x, y)))
    return max(chords.distance(Point(z.real, z.imag)) for z in true)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_the_groove_table_keeps_its_tolerance(tolerance):
    """Pitch curve and flanks by the law of sines, its slope by a complex step."""
    spec = Spec(Wheel(6), Drive("cam"), Keys("cam"), Motion("cycloidal"))
    at = columns(groove_table(build(spec), tolerance, None))

    def distance(phi):
        u = phi / math.radians(120.0) + 0.5
        psi = math.pi / 3.0 * (u - np.sin(2.0 * math.pi * u) / (2.0 * math.pi) - 0.5)
        return 100.0 * np.sin(psi) / np.sin(phi + psi)

    phi = np.radians(np.linspace(-59.999, 59.999, 5000))  # without 0, where that is 0/0
    R, slope = distance(phi), distance(phi + 1e-30j).imag / 1e-30
    # x points away from the wheel; the roller runs by phi about the crank's axis
    pitch = -R * np.exp(-1j * phi)
    along = -(slope - 1j * R) * np.exp(-1j * phi)
    normal = 1j * along / np.abs(along)
    worst = [
        missed(at[f"{side}x_mm"], at[f"{side}y_mm"], pitch + off * normal)
        for side, off in (("", 0.0), ("left_", 5.0), ("right_", -5.0))
    ]
    assert 0.5 * tolerance < max(worst) <= 1.005 * tolerance
    turned = np.radians(at["input_deg"])
    off = np.abs(turned) > 1e-9  # at 0 it is L V/(1+V), V = 1
    assert at["radius_mm"][off] == pytest.approx(distance(turned[off]), rel=1e-13)
    assert at["radius_mm"][~off] == pytest.approx(50.0, rel=1e-15)
    assert at["curvature_radius_mm"][0] == math.inf  # entering along a slot at rest


@pytest.mark.parametrize(("z", "law", "alpha0"), [(6, "cycloidal", 0.0), (4, "3-4-5", -20.0)])
def test_the_grooves_greatest_pressure_angle(z, law, alpha0):
    """All round, dwell too, against differences of the logarithm of the roller's distance.

    Central differences over 1e-4 deg are good to 1e-9 rad here, and a grid of 1/100 deg misses a
    smooth greatest by less than that.
    """
    motion = Motion(law, alpha0_deg=alpha0)
    mechanism = build(Spec(Wheel(z), Drive("cam"), Keys("cam"), motion))
    groove = mechanism.engagements[0].groove
    x = groove.motion.entry_deg + np.arange(0.0, 360.0, 0.01)
    h = 1e-4
    ahead, behind = (np.log(distances(groove, x + side * h)[0]) for side in (0.5, -0.5))
    angle = np.degrees(np.arctan(np.abs(ahead - behind) / np.radians(h)))
    row = next(c for c in checks(mechanism, parts=False) if c.name == "groove_pressure_deg")
    assert row.value == pytest.approx(angle.max(), abs=1e-6)
    turned = x[angle > angle.max() - 1e-6] - row.at_deg
    assert min(abs(np.remainder(turned + 180.0, 360.0) - 180.0)) < 0.1
    assert row.passes
    limits = Limits(pressure_angle_max_deg=0.5 * row.value)
    held = build(Spec(Wheel(z), Drive("cam"), Keys("cam"), motion, limits=limits))
    names = {c.name: c.passes for c in checks(held, parts=False)}
    assert names["groove_pressure_deg"] is False
