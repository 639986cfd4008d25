"""Rack, locking sector, arm and guide of a linear Geneva: sizes, area, horns, gaps over a turn.

Its proof and its play are in test_rack_turn.py.
"""

import math

import mpmath
import pytest
import repo
from other_shape import with_shape

from geneva_cli import Design, Linear, Size
from geneva_cli.design import load
from geneva_cli.geometry.plates import moments, solids
from geneva_cli.geometry.shapes import bounds
from geneva_cli.kinds.linear.outlines import turned_rack
from geneva_cli.kinds.linear.rack import locking_sector, rack_contour, rack_sizes
from geneva_cli.parts.turn.full_turn import full_turn

R, r = 50.0, 6.0


def design(**sizes: float) -> Design:
    return Design(Linear(6), size=Size(**{"center_distance_mm": R, "roller_radius_mm": r, **sizes}))


def sizes_of(**sizes: float):
    return rack_sizes(design(**sizes).mechanism)


def smallest_gap(sizes) -> float:
    parts = design().parts
    return full_turn(with_shape(parts, turned_rack(parts.assembly, sizes))).smallest.mm


@pytest.mark.parametrize("count", [3, 4, 7])
def test_area_of_a_rack(count):
    """A rectangle less slots (a rectangle and half a circle) and recesses (half circles)."""
    s = sizes_of(slot_clearance_mm=0.2)
    deep = R - s.behind
    long = 2.0 * R * (count + 1) - 2.0 * s.half_width
    slot = 2.0 * s.half_width * (R + s.guide.bottom) + 0.5 * math.pi * s.half_width**2
    recess = 0.5 * math.pi * s.recess**2
    area = moments(rack_contour(s, count)).area
    assert area == pytest.approx(deep * long - count * slot - (count + 1) * recess, rel=1e-13)


def test_area_of_the_locking_sector():
    s = sizes_of()
    area = moments(locking_sector(s)).area
    assert area == pytest.approx(0.5 * math.pi * (s.lock**2 - s.floor**2), rel=1e-13)


@pytest.mark.sampled(4)
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
    bottom = s.guide.bottom + s.half_width - r
    expected = min(slot, lock, passing, bottom)
    assert smallest_gap(s) == pytest.approx(expected, rel=2.0 * relief / R + 1e-3)


def test_a_ring_that_reaches_the_axis_collides():
    """The horns pass the axis at mid-motion, at R - rho from it on either side."""
    s = sizes_of(slot_clearance_mm=0.5, lock_clearance_mm=0.5)
    assert smallest_gap(s._replace(floor=0.5 * (R - s.recess))) < -0.5


@pytest.mark.long
@pytest.mark.usefixtures("no_advice")
def test_checks():
    rack = design(slot_clearance_mm=0.1)
    rows = {one.name: one for one in rack.checks}
    horn = R - 6.1 - rack_sizes(rack.mechanism).recess
    assert rows["rack_horn_mm"].value == pytest.approx(horn)
    assert rows["gap_mm"].value == 0.0 and rows["gap_proved_mm"].passes
    free = {one.name for one in design(lock_radius_mm=0.0).checks}
    assert "rack_horn_mm" not in free and "gap_mm" in free
    thin = {one.name: one for one in design(lock_radius_mm=43.9).checks}
    assert thin["rack_horn_mm"].passes is False


PARTS = {"slot_clearance_mm": 0.1, "pin_gap_mm": 0.5}


def solids_of(**sizes: float) -> dict:
    """All solids of a machine by their names, each in its own frame."""
    whole = design(**{**PARTS, **sizes}).drawing("assembly").solid
    return {one.name: one for one in solids(whole)}


def span(solid) -> tuple[float, float]:
    """Where a part lies across the travel of the rack."""
    box = bounds(solid.outline)
    return box.x0, box.x1


def test_the_bar_slides_between_rail_and_wall():
    """With the clearance of a slot on either side; the rack lies on the rail, below the cover."""
    s = solids_of()
    bar, rail, wall, cover = (s[f"guide {name}"] for name in ("bar", "rail", "wall", "cover"))
    assert span(rail)[0] - span(bar)[1] == pytest.approx(0.1, abs=1e-12)
    assert span(bar)[0] - span(wall)[1] == pytest.approx(0.1, abs=1e-12)
    assert span(cover)[1] == pytest.approx(span(bar)[1] - 0.5, abs=1e-12)
    assert span(cover)[0] == pytest.approx(span(wall)[0] + 0.5, abs=1e-12)
    assert span(bar)[0] == pytest.approx(span(s["rack"])[0] - 0.5, abs=1e-12)
    assert (rail.high, bar.high, s["rack"].low) == (0.0, 0.0, 0.0)
    assert cover.low == wall.high == s["rack"].high + 0.5
    assert rail.low == wall.low == s["frame"].high == s["arm"].low
    assert bar.low == 0.5 * rail.low


@pytest.mark.parametrize("count", [3, 4, 7])
@pytest.mark.parametrize("lock", [None, 0.0])
def test_the_rack_covers_its_guide_in_each_step(count, lock):
    """A slot at y0 passes mid-motion after a travel of -y0; half a step before and after it R."""
    sizes = {"lock_radius_mm": lock} if lock is not None else {}
    machine = design(**PARTS, **sizes).with_("wheel.z", count)
    s = {one.name: one for one in solids(machine.drawing("assembly").solid)}
    rack, bar, rail = s["rack"], s["guide bar"], s["guide rail"]
    box, half = bounds(rack.outline), bounds(rail.outline).y1
    slots = [2.0 * R * (k - (count - 1) // 2) for k in range(count)]
    for travel in (-slots[-1] - R, -slots[0] + R):
        assert box.y0 + travel <= -half + 1e-9
        assert half <= box.y1 + travel + 1e-9
    assert half == pytest.approx(R - r - 0.1)
    ends = bounds(bar.outline)
    assert (ends.y0, ends.y1) == pytest.approx((box.y0, box.y1), abs=1e-9)


@pytest.mark.long
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("mu", (0.0, 0.63))
def test_a_guide_locks_where_the_loads_lose_their_bound(mu):
    """A percent below that friction the pin's force has a bound, a percent above it has none."""
    feeder = load(str(repo.DESIGNS / "linear.toml"), [f"load.friction={mu}"])
    feeder = feeder.with_("load.guide_friction", 0.1)
    locks = feeder.report.table.to_dict()["guide.locks_at_friction"]
    for guide_friction, bounded in ((0.99 * locks, True), (1.01 * locks, False)):
        slid = feeder.with_("load.guide_friction", guide_friction)
        assert (slid.loads["pin_force_N"].max is not None) is bounded
        rows = {one.name: one for one in slid.checks}
        assert rows["guide_locks"].passes is bounded


def test_the_horn_of_a_rack_is_its_formula():
    """6 F (s - s0)/(b t²), t = h + k - sqrt(k² - s²), greatest with the roller at the mouth.

    1e-9: the search by grids stops where the stress is flat.
    """
    keys = {"slot_clearance_mm": 0.1, "lock_radius_mm": 41.0, "face_width_mm": 12.0}
    rack = design(**keys).with_("load.force_N", 30.0)
    with mpmath.workdps(30):
        k = mpmath.mpf(41)
        h = R - mpmath.mpf(r + 0.1) - k

        def stress(s):
            t = h + k - mpmath.sqrt(k * k - s * s)
            return 6 * 30 * s / (12 * t * t)

        s = mpmath.findroot(lambda s: mpmath.diff(stress, s), 2 * h)
        expected = stress(s)
    values = rack.report.table.to_dict()
    assert values["strength.horn.stress_MPa"] == pytest.approx(float(expected), rel=1e-9)
    assert values["strength.horn.inwards_mm"] == pytest.approx(float(s), rel=1e-4)
    assert values["strength.horn.at_deg"] == pytest.approx(-90.0, abs=1e-6)
    assert values["life.horn_stress_MPa"] == values["strength.horn.stress_MPa"]
    assert "horn_stress_MPa" in {one.name for one in rack.checks}
