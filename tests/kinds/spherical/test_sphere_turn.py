"""The full turn of spherical machines: gaps by sampled points, plays by the flat wheel's limit."""

import math

import numpy as np
import pytest
from scipy.spatial import cKDTree

from geneva_cli import Crank, Design, External, Size, Spherical
from geneva_cli.errors import GenevaError
from geneva_cli.kinds.spherical.crank import at_mid_motion, sectors
from geneva_cli.kinds.spherical.gaps import BallGaps
from geneva_cli.kinds.spherical.shaft_gap import shaft_gap
from geneva_cli.kinds.spherical.sizes import ball
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.gaps import NEAR
from geneva_cli.verdict.checks import all_pass, checks
from geneva_cli.verdict.checks.all_checks import standing_checks

CLEAR = {"slot_clearance_mm": 0.05, "lock_clearance_mm": 0.04}


def turned(u, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack((u[:, 0] * c - u[:, 1] * s, u[:, 0] * s + u[:, 1] * c, u[:, 2]))


EACH = 400  # samples of an arc


def sampled(arcs):
    share = np.linspace(0.0, 1.0, EACH)
    every = [arcs.at(np.full(EACH, i), share * arcs.sweep[i]) for i in range(len(arcs))]
    return np.concatenate(every)


def angles(a, b):
    return 2.0 * np.arcsin(np.minimum(0.5 * np.linalg.norm(a[:, None] - b[None], axis=2), 1.0))


def test_distances_are_those_of_sampled_points():
    """Within half a step of the samples, squared, over twice the distance; nearest points too."""
    found = parts_of(Design(Spherical(5, axes_deg=70), size=Size(80.0, 5.0, **CLEAR)).mechanism)
    for arcs in (found.gaps.wheel, *found.gaps.sectors):
        edge = sampled(arcs)
        rng = np.random.default_rng(1)
        points = np.concatenate((rng.normal(size=(60, 3)), edge[::97] + 0.02))
        points /= np.linalg.norm(points, axis=1)[:, None]
        away, foot = arcs.signed(points)
        least = angles(points, edge).min(axis=1)
        step = (arcs.sweep * np.sin(arcs.angle)).max() / (EACH - 1)
        assert (np.abs(away) <= least + 1e-12).all()
        assert (least - np.abs(away) <= step).all()
        assert np.abs(angles(points, foot).diagonal() - np.abs(away)).max() < 1e-12


def test_nearly_parallel_shafts_are_a_flat_machine():
    """At 0.2 degrees the sphere's radius is 287 L; what is left is of the order of L/R, squared
    for curvature, and of the first order where the deepest roller is 3e-3 L farther in."""
    size = {**CLEAR, "slot_bottom_clearance_mm": 0.3}
    far = 100.0 / math.radians(0.2)
    flat = parts_of(Design(External(6), size=Size(100.0, 5.0, **size)).mechanism).turn
    ball = Design(Spherical(6, axes_deg=0.2), size=Size(far, 5.0, wheel_bore_mm=10.0, **size))
    found = parts_of(ball.mechanism).turn
    for name in ("dwell", "hand_over", "motion", "push"):
        assert getattr(found, name).deg == pytest.approx(getattr(flat, name).deg, rel=2e-3)
    for name in ("driving", "lock"):
        assert getattr(found, name).mm == pytest.approx(getattr(flat, name).mm, rel=1e-6)
    assert found.hand_over.at_deg == pytest.approx(flat.hand_over.at_deg, abs=0.01)


def least_gap(found, at):
    """The least distance of sampled points of wheel and sectors, mm, at one input angle."""
    gaps, lead = found.gaps, float(found.assembly.wheel(np.array([at]))[0])
    wheel = turned(sampled(gaps.wheel), lead) @ np.array(at_mid_motion(found.ball)).T
    sectors = np.concatenate([sampled(sector) for sector in gaps.sectors])
    chord, _ = cKDTree(sectors).query(turned(wheel, math.radians(at)))
    return found.ball.radius_mm * 2.0 * math.asin(0.5 * chord.min())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("axes", "z"), [(60.0, 5), (90.0, 6), (120.0, 7)])
def test_gaps_are_those_of_sampled_edges(axes, z):
    """Through a turn: of points nearest to each other, each is half a step off at most."""
    size = Size(80.0, 4.0, lock_clearance_mm=0.5, slot_clearance_mm=0.1)
    found = parts_of(Design(Spherical(z, axes_deg=axes), size=size).mechanism)
    at = found.assembly.start_deg + np.linspace(1.0, 350.0, 13)
    told = found.gaps.locking(found.gaps.pose(at))
    edges = (found.gaps.wheel, *found.gaps.sectors)
    step = max(80.0 * float((e.sweep * np.sin(e.angle)).max()) / (EACH - 1) for e in edges)
    wide = NEAR * 80.0
    assert (told < wide).sum() > 6
    for x, gap in zip(at, told, strict=True):
        by_points = least_gap(found, x)
        assert min(by_points - step, wide) <= gap <= min(by_points, wide) + 1e-9


@pytest.mark.parametrize("design", [
    Design(Spherical(6), size=Size(80.0, 5.0)),
    Design(Spherical(5, axes_deg=60), Crank(rollers=2), size=Size(80.0, 5.0, **CLEAR)),
    Design(Spherical(8, axes_deg=120), size=Size(80.0, 3.0, **CLEAR)),
])  # fmt: skip
def test_machines_of_default_sizes_pass(design):
    rows = {c.name: c for c in checks(design.mechanism)}
    assert all_pass(rows.values())
    assert rows["gap_mm"].value == pytest.approx(
        design.spec.size.lock_clearance_mm or 0.0, abs=1e-9
    )
    assert rows["dwell_hold"].value == 1.0


def spoilt(**sizes):
    """The least gaps of rollers and lock in a turn, of which some angles are larger by so much."""
    found = parts_of(Design(Spherical(6, axes_deg=100), size=Size(80.0, 5.0, **CLEAR)).mechanism)
    ball = found.ball._replace(**{k: getattr(found.ball, k) + v / 80.0 for k, v in sizes.items()})
    gaps = BallGaps(found.assembly, ball, found.shells.crank)
    at = found.assembly.start_deg + np.linspace(0.0, 360.0, 721)[:-1]
    return gaps.rollers(gaps.pose(at)).min(), gaps.locking(gaps.pose(at)).min()


def test_spoilt_machines_overlap_by_as_much():
    assert spoilt() == pytest.approx((0.05, 0.04), abs=1e-9)
    assert spoilt(roller=0.15)[0] == pytest.approx(-0.10, abs=1e-9)
    assert spoilt(recess=-0.10)[1] == pytest.approx(-0.06, abs=1e-9)
    assert min(spoilt(rim=0.5)) < -0.01


def test_a_sector_is_narrower_where_the_wheel_sweeps_over_its_ends():
    """Shafts at 140 degrees and 16 slots: not all of the way between two rollers is free."""
    design = Design(Spherical(16, axes_deg=140), size=Size(100.0, 5.0))
    (sector,) = parts_of(design.mechanism).shells.crank
    whole = math.radians(360.0 - design.timing.motion_deg)
    assert 0.5 * whole < sector.boundary[0].sweep < 0.95 * whole
    rows = {c.name: c for c in checks(design.mechanism)}
    assert rows["gap_mm"].passes
    assert rows["dwell_hold"].passes


def test_a_roller_that_leaves_room_is_named():
    design = Design(Spherical(6, axes_deg=170), size=Size(80.0, 5.0))
    with pytest.raises(GenevaError, match="whole locking sector") as error:
        _ = parts_of(design.mechanism).turned
    most = float(str(error.value).rpartition("a roller of ")[2].partition(" mm")[0])
    assert parts_of(design.with_("size.roller_radius_mm", most).mechanism).shells.crank
    with pytest.raises(GenevaError, match="whole locking sector"):
        sectors(ball(design.with_("size.roller_radius_mm", 1.2 * most).mechanism))


def test_a_shaft_that_takes_all_of_the_locking_sector_is_named():
    design = Design(Spherical(6), size=Size(80.0, 5.0, crank_bore_mm=60.0))
    with pytest.raises(GenevaError, match="leave nothing of the locking sector") as error:
        sectors(ball(design.mechanism))
    most = float(str(error.value).rpartition("must be below ")[2].partition(",")[0])
    # it is told in four digits
    assert sectors(ball(design.with_("size.crank_bore_mm", most - 0.01).mechanism))
    with pytest.raises(GenevaError, match="leave nothing"):
        sectors(ball(design.with_("size.crank_bore_mm", most + 0.01).mechanism))


def test_shafts_and_arm_have_room_or_not():
    """Arcs between cones: at the sphere where both are, a hub's surface is at an arc sine."""
    given = Size(80.0, 5.0, wheel_hub_mm=30.0, arm_eye_mm=20.0, wheel_bore_mm=20.0)
    design = Design(Spherical(6, axes_deg=75), size=given)

    def row(name, of=design):
        return next(c for c in standing_checks(parts_of(of.mechanism)) if c.name == name)

    ball = parts_of(design.mechanism).ball
    # the arm is a shell from 84 mm on, and the wheel's one from 76
    eye = math.radians(75.0) - ball.arm - 10.0 / 80.0 - math.asin(15.0 / 84.0)
    assert row("beside_shafts_mm").value == pytest.approx(84.0 * eye, rel=1e-12)
    assert row("wheel_bore_wall_mm").value == 5.0  # of the hub around its bore
    bare = design.with_("size.wheel_hub_mm", 0.0)
    deepest = ball.bottom - ball.half_width - math.asin(10.0 / 76.0)
    assert row("wheel_bore_wall_mm", bare).value == pytest.approx(80.0 * deepest, rel=1e-12)
    assert row("beside_shafts_mm", design.with_("size.arm_eye_mm", 110.0)).passes is False
    # without an arm one check says why
    thin = parts_of(design.with_("size.arm_hub_mm", 3.0).mechanism)
    failing = [c for c in standing_checks(thin) if not c.passes]
    assert [c.name for c in failing] == ["arm_wall_mm"]
    assert failing[0].why.startswith("arm_hub_mm = 3: the hub must be above")
    # round the pin: the eye is 10/80 wide, its hole 2.5 mm at 84; more than the hub's wall
    assert row("arm_wall_mm").value == pytest.approx(2.0, rel=1e-12)


def least_beside(**given):
    axes = given.pop("axes")
    found = parts_of(Design(Spherical(6, axes_deg=axes), size=Size(80.0, 3.0, **given)).mechanism)
    return found.ball, shaft_gap(found)


def test_a_shaft_through_the_centre_to_where_the_crank_comes_round():
    """The rollers are nearest to the centre, from 76 mm on, where the shaft is widest."""
    ball, least = least_beside(axes=168.0, wheel_shaft_high_mm=200.0)
    apart = math.radians(12.0) - ball.arm - ball.roller - math.asin(0.5 * 12.0 / 76.0)
    assert ball.bore_mm == 6.0
    assert (least.shaft, least.part) == ("wheel's shaft", "roller")
    assert least.gap == pytest.approx(76.0 * apart, rel=1e-12)
    assert least.gap < 0.0
    # both shafts through the centre: they meet where nothing else is
    _, least = least_beside(axes=60.0, wheel_shaft_high_mm=90.0, crank_shaft_high_mm=90.0)
    assert (least.shaft, least.part) == ("wheel's shaft", "crank's shaft")
    assert least.gap < -8.0


def test_a_crank_shaft_through_the_wheels_shell():
    """At a right angle the rim passes over the crank's axis, and half of the shaft is within."""
    ball, least = least_beside(axes=90.0, crank_bore_mm=8.0)
    assert ball.rim == pytest.approx(math.pi / 2.0, abs=1e-12)
    assert (least.shaft, least.part) == ("crank's shaft", "wheel")
    assert least.gap == pytest.approx(-76.0 * math.asin(4.0 / 76.0), rel=1e-2)


def test_by_default_all_has_its_room():
    """Hubs, shafts, arm and walls of machines all over the family."""
    for z in (3, 12):
        for axes in (10.0, 60.0, 120.0, 165.0):
            design = Design(Spherical(z, axes_deg=axes), size=Size(100.0, 1.0))
            rows = list(standing_checks(parts_of(design.mechanism)))
            assert all(c.passes for c in rows), rows
            assert {"beside_shafts_mm", "arm_wall_mm"} <= {c.name for c in rows}
