"""The rack and the locking sector of a linear Geneva: sizes, area, and gaps over a turn.

Its proof and its play are in test_rack_turn.py.
"""

import math

import numpy as np
import pytest

from geneva_cli import Design, Linear, Size
from geneva_cli.collisions.full_turn import full_turn
from geneva_cli.curves.moments import moments
from geneva_cli.errors import GenevaError
from geneva_cli.layout.assembly import assembled
from geneva_cli.outlines.rack import locking_sector, rack_contour, rack_sizes
from geneva_cli.outlines.rack_outlines import turned_rack

R, r = 50.0, 6.0


def design(**sizes: float) -> Design:
    return Design(Linear(6), size=Size(center_distance_mm=R, roller_radius_mm=r, **sizes))


def sizes_of(**sizes: float):
    return rack_sizes(design(**sizes).mechanism)


def smallest_gap(sizes) -> float:
    return full_turn(turned_rack(assembled(design().mechanism), sizes)).smallest.mm


@pytest.mark.parametrize("count", [3, 4, 7])
def test_area_of_a_rack(count):
    """A rectangle less slots (a rectangle and half a circle) and recesses (half circles)."""
    s = sizes_of(slot_clearance_mm=0.2)
    deep = R + s.slot_bottom + s.half_width + s.back
    long = 2.0 * R * (count + 1) - 2.0 * s.half_width
    slot = 2.0 * s.half_width * (R + s.slot_bottom) + 0.5 * math.pi * s.half_width**2
    recess = 0.5 * math.pi * s.recess**2
    area = moments(rack_contour(s, count)).area
    assert area == pytest.approx(deep * long - count * slot - (count + 1) * recess, rel=1e-13)


def test_area_of_the_locking_sector():
    s = sizes_of()
    area = moments(locking_sector(s)).area
    assert area == pytest.approx(0.5 * math.pi * (s.lock**2 - s.floor**2), rel=1e-13)


@pytest.mark.parametrize(
    ("slot", "lock", "relief"), [(0.05, 0.03, 1.0), (0.03, 0.1, 1.0), (0.4, 0.5, 0.3), (9, 9, 0.01)]
)
def test_smallest_gap(slot, lock, relief):
    """It is the clearance in the slot or in the recess, or that of the ring's end past a horn.

    The corner of the end, f from the axis, passes the corner of a horn, R - rho from it, which
    moves by R d while the end turns by d: the least distance is (f - (R - rho)) f/hypot(f, R), to
    the first order of d, which is at most relief/R.
    """
    keys = {"slot_clearance_mm": slot, "lock_clearance_mm": lock, "relief_clearance_mm": relief}
    s = sizes_of(**keys)
    passing = relief * s.floor / math.hypot(s.floor, R)
    bottom = s.slot_bottom + s.half_width - r
    expected = min(slot, lock, passing, bottom)
    assert smallest_gap(s) == pytest.approx(expected, rel=2.0 * relief / R + 1e-3)


def test_parts_touch_without_clearance():
    assert smallest_gap(sizes_of()) == pytest.approx(0.0, abs=1e-12)


def test_a_ring_that_reaches_the_axis_collides():
    """The horns pass the axis at mid-motion, at R - rho from it on either side."""
    s = sizes_of(slot_clearance_mm=0.5, lock_clearance_mm=0.5)
    assert smallest_gap(s._replace(floor=0.5 * (R - s.recess))) < -0.5
    assert smallest_gap(s._replace(lock=s.recess + 0.1)) == pytest.approx(-0.1, rel=1e-6)


def test_a_rack_beyond_the_axis_meets_the_roller_before_it_enters():
    """At d before entry the roller is R (1 - cos d) off the slot, whose corner is e beyond R.

    There the gap is that to the wall, and further out that to the corner.
    """
    d = np.radians(np.linspace(0.0, 10.0, 1_000_001))
    off, out = R * (1.0 - np.cos(d)), R * np.sin(d)
    for e in (1.0, 3.0):
        s = sizes_of(lock_radius_mm=0.0, wheel_radius_mm=R + e)
        overlap = np.where(out <= e, off, r - np.hypot(out - e, r - off))
        # the turn halves its samples down to 1e-9 mm
        assert smallest_gap(s) == pytest.approx(-overlap.max(), abs=1e-9)


def in_recess(s, q: float, d: float) -> bool:
    """Whether a point of the ring's end, q from the axis, lies in the recess, d after entry."""
    y = R * (1.0 - math.cos(d))
    return q * q - 2.0 * q * y * math.sin(d) + y * y <= s.recess**2 * (1.0 + 1e-12)


def test_the_end_of_the_ring_stays_in_its_recess():
    """From its inner to its outer radius, at every angle up to mid-motion."""
    for lock in (27.0, 35.0, 43.0):
        s = sizes_of(lock_radius_mm=lock, relief_clearance_mm=0.2)
        for d in np.linspace(0.0, 0.5 * math.pi, 91):
            assert all(in_recess(s, q, d) for q in np.linspace(s.floor, s.lock, 21))
    assert not in_recess(s, s.floor - 0.3, 0.5 * math.pi)


@pytest.mark.usefixtures("no_advice")
def test_checks():
    rows = {one.name: one for one in design(slot_clearance_mm=0.1).checks}
    assert rows["rack_horn_mm"].value == pytest.approx(
        R - 6.1 - rack_sizes(design(slot_clearance_mm=0.1).mechanism).recess
    )
    assert rows["gap_mm"].value == 0.0
    assert rows["gap_proved_mm"].passes
    assert rows["parts"].passes is None
    free = {one.name for one in design(lock_radius_mm=0.0).checks}
    assert "rack_horn_mm" not in free
    assert "gap_mm" in free
    thin = {one.name: one for one in design(lock_radius_mm=43.9).checks}
    assert thin["rack_horn_mm"].passes is False


@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize(
    ("size", "text"),
    [
        ({"roller_radius_mm": 30.0}, "the locking sector does not fit"),
        ({"lock_radius_mm": 20.0}, "lock_radius_mm = 20: it must be above 25.125"),
        ({"wheel_radius_mm": 99.0}, "the rack's edge must meet its recesses"),
    ],
)
def test_sizes_that_leave_no_lock_are_refused(size, text):
    made = Design(Linear(6), size=Size(**{"center_distance_mm": R, **size}))
    with pytest.raises(GenevaError, match=text):
        made.drawing("wheel")
    assert not made.passes


@pytest.mark.parametrize(
    "name", ["slot.dxf", "wheel.dxf", "crank.svg", "assembly.step", "wheel.stl", "arm.step"]
)
def test_parts_are_written(name, tmp_path):
    path = tmp_path / name
    design(slot_clearance_mm=0.1).save(str(path))
    assert path.stat().st_size > 500


def test_other_parts_are_refused_with_those_that_there_are():
    with pytest.raises(GenevaError, match="has slot, wheel, crank, arm, assembly"):
        design().drawing("frame")
    with pytest.raises(GenevaError, match="not available for a rack"):
        design().sheet()


def test_the_assembly_has_the_crank_at_mid_motion():
    """The roller is at the origin, and the sector beyond the crank's axis."""
    shapes = design().drawing("assembly").shapes
    roller = next(one for one in shapes if one.layer == "ROLLER")
    assert roller.centre == pytest.approx((0.0, 0.0), abs=1e-13)
    sector = next(one for one in shapes if one.layer == "CRANK")
    assert min(p.start[0] for p in sector.segments) == pytest.approx(R, abs=1e-12)


def test_area_of_the_arm():
    """Two discs, of hub and eye, and the quadrilaterals between their common tangents.

    With c = (hub - eye)/R the tangents touch at acos(c) on both, so the hull has the area
    hub² (pi - acos c) + eye² acos c + R (hub + eye) sqrt(1 - c²).
    """
    s = sizes_of(slot_clearance_mm=0.1)
    shapes = design(slot_clearance_mm=0.1, arm_eye_mm=20.0, lock_bolts=2).drawing("arm").shapes
    hub, eye = s.lock, 10.0
    touch = math.acos((hub - eye) / R)
    area = hub**2 * (math.pi - touch) + eye**2 * touch + R * (hub + eye) * math.sin(touch)
    assert moments(shapes[0]).area == pytest.approx(area, rel=1e-12)
    shaft, pin, *bolts = shapes[1:]
    assert shaft.centre == (0.0, 0.0)
    assert pin.centre == (R, 0.0)
    assert [(one.centre[0] < 0.0, one.radius) for one in bolts] == [(True, 1.25)] * 2


def test_ring_and_roller_stand_on_the_arm():
    """The arm is pin_gap_mm below the rack; its bolts go through arm and ring."""
    machine = design(slot_clearance_mm=0.1, pin_gap_mm=1.0)
    crank, rack = (one.part for one in machine.drawing("assembly").solid.members)
    arm, _, pin, ring = (one.part for one in crank.members)
    assert (rack.low, arm.high, ring.low) == (0.0, -1.0, -1.0)
    assert pin.low == arm.low
    assert set(ring.holes) == set(arm.holes[2:])


@pytest.mark.parametrize(
    ("size", "text"),
    [
        ({"arm_bore_mm": 88.0}, "the least wall around the arm's holes is"),
        ({"arm_eye_mm": 2.0}, "arm_eye_mm = 2: the eye must be above"),
        ({"lock_bolt_mm": 40.0}, "the least wall around the arm's holes is"),
        ({"lock_radius_mm": 0.0, "lock_bolts": 2}, "there is no locking disc to fix"),
    ],
)
def test_sizes_that_leave_no_arm_are_refused(size, text):
    with pytest.raises(GenevaError, match=text):
        design(**size).drawing("arm")
