"""The full turn of spherical machines: gaps by sampled points, plays by the flat wheel's limit."""

import math

import numpy as np
import pytest
from scipy.spatial import cKDTree
from strength_checks import standing_checks
from test_spherical import turned

from geneva_cli import Design, External, Size, Spherical
from geneva_cli.kinds.spherical.regions import at_mid_motion
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.gaps import NEAR
from geneva_cli.verdict.checks import checks

CLEAR = {"slot_clearance_mm": 0.05, "lock_clearance_mm": 0.04}


EACH = 400  # samples of an arc


def sampled(arcs):
    share = np.linspace(0.0, 1.0, EACH)
    every = [arcs.at(np.full(EACH, i), share * arcs.sweep[i]) for i in range(len(arcs))]
    return np.concatenate(every)


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
    for name, gap in flat.gaps.items():
        assert found.gaps[name].mm == pytest.approx(gap.mm, rel=1e-6)
    assert found.hand_over.at_deg == pytest.approx(flat.hand_over.at_deg, abs=0.01)


def least_gap(found, at):
    """The least distance of sampled points of wheel and sectors, mm, at one input angle."""
    gaps, lead = found.gaps, float(found.assembly.wheel(np.array([at]))[0])
    wheel = turned(sampled(gaps.wheel), lead) @ np.array(at_mid_motion(found.ball)).T
    sectors = sampled(gaps.crank)
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
    edges = (found.gaps.wheel, found.gaps.crank)
    step = max(80.0 * float((e.sweep * np.sin(e.angle)).max()) / (EACH - 1) for e in edges)
    wide = NEAR * 80.0
    assert (told < wide).sum() > 6
    for x, gap in zip(at, told, strict=True):
        by_points = least_gap(found, x)
        assert min(by_points - step, wide) <= gap <= min(by_points, wide) + 1e-9


def test_a_sector_is_narrower_where_the_wheel_sweeps_over_its_ends():
    """Shafts at 140 degrees and 16 slots: not all of the way between two rollers is free."""
    design = Design(Spherical(16, axes_deg=140), size=Size(100.0, 5.0))
    (sector,) = parts_of(design.mechanism).shape.crank
    whole = math.radians(360.0 - design.timing.motion_deg)
    assert 0.5 * whole < sector.boundary[0].sweep < 0.95 * whole
    rows = {c.name: c for c in checks(design.mechanism)}
    assert rows["gap_mm"].passes
    assert rows["dwell_hold"].passes


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
