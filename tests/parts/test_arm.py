"""The crank arm: its outline, its holes, and what fixes the locking disc to it."""

import math

import numpy as np
import pytest
from drawing_witness import polygon
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry import Point
from words import Drive, Spec, Wheel

from geneva_cli.design import Design
from geneva_cli.geometry.shapes import Arc, Circle, convex_hull, segment_length
from geneva_cli.parts.shafts.arm_and_shafts import bolts, crank_arm, walls
from geneva_cli.spec.tables import Size


def of(wheel, motion=None, drive=None, **size):
    return Design.of(Spec(wheel, drive, None, motion, size=Size(**size)))


CIRCLE = st.builds(
    lambda x, y, r: Circle("ARM", (round(x, 2), round(y, 2)), round(r, 2)),
    st.floats(-9, 9),
    st.floats(-9, 9),
    st.floats(0.1, 4),
)


@pytest.mark.long
@settings(max_examples=150)
@given(st.lists(CIRCLE, min_size=1, max_size=7, unique=True))
def test_the_belt_is_the_convex_hull(circles):
    """Its length is the mean of its width times pi (Cauchy), the width from the circles alone."""
    found = convex_hull("ARM", circles)
    turn = np.arange(20000) * (math.tau / 20000)
    reach = [c.centre[0] * np.cos(turn) + c.centre[1] * np.sin(turn) + c.radius for c in circles]
    length = math.tau * np.max(reach, axis=0).mean()
    # the mean of a function with corners over n points misses by about its bend / n²
    assert math.fsum(map(segment_length, found.segments)) == pytest.approx(length, rel=1e-6)
    assert math.fsum(s.sweep for s in found.segments if isinstance(s, Arc)) == pytest.approx(
        math.tau, abs=1e-9
    )
    ends = [*found.segments[1:], found.segments[0]]
    assert all(a.end == b.start for a, b in zip(found.segments, ends, strict=True))


def crews():
    """Wheels of 3 to 24 slots, each with the rollers that leave it a dwell, up to three."""
    for z in (3, 4, 5, 6, 8, 12, 24):
        for gearing, motion in (("external", 180 - 360 / z), ("internal", 180 + 360 / z)):
            yield from (
                (z, gearing, m) for m in (1, 2, 3) if m * motion < 360 and (m < 2 or z < 24)
            )


@pytest.mark.sampled(24)
@pytest.mark.parametrize(("z", "gearing", "rollers"), [*crews()])
def test_defaults_work(z, gearing, rollers):
    """Walls all round, and clear of the wheel's hub, below the wheel."""
    found = of(Wheel(z, gearing), drive=Drive(rollers=rollers)).parts.outlines
    made = crank_arm(found)
    outline, holes = polygon(made.outline), [polygon(h) for h in (made.bore, *made.pins)]
    wall = found.sizes.wall_min
    assert outline.is_valid and len(made.pins) == rollers
    for i, hole in enumerate(holes):
        assert outline.contains(hole)
        assert hole.distance(outline.exterior) > 0.999 * wall
        assert all(hole.distance(other) > wall for other in holes[:i])
    # chords of the witness's polygons lie inside their arcs by less than 1e-4 of the radius
    least = min(hole.distance(outline.exterior) for hole in holes)
    assert walls(made, found) <= least + 1e-3 * found.assembly.L
    if gearing == "external":
        axis = Point(-found.assembly.L, 0.0)  # of the wheel, seen from the crank, in any position
        reach = max(math.hypot(*c.centre) for c in made.pins) + made.eye
        assert found.assembly.L - reach - found.sizes.wheel_bore == pytest.approx(made.hub_gap)
        assert made.hub_gap > -1e-9
        assert outline.distance(axis) > found.sizes.wheel_hub - 1e-9


@pytest.mark.long
def test_an_arm_that_meets_the_hub_is_told():
    design = of(Wheel(6), arm_eye_mm=90.0)
    (check,) = [c for c in design.checks if c.name == "arm_to_hub_mm"]
    found = design.parts.outlines
    free = found.assembly.L * (1.0 - 0.5) - 45.0 - found.sizes.wheel_bore  # without a hub
    assert check.value == pytest.approx(free) and not check.passes
    name, value = check.nearest.split(" = ")
    fixed = design.with_(f"size.{name}", float(value))
    assert name == "arm_eye_mm" and all(c.passes for c in fixed.checks)


@pytest.mark.parametrize(("more_mm", "count"), [(-1e-6, 0), (1e-6, 2)])
def test_bolts_leave_a_wall_to_the_shaft(more_mm, count):
    """Their circle is as large as the shaft's hole, a bolt's and the least wall; or there are none.

    The disc has a wall about them in any case.
    """
    shaft, bolt, wall = 17.5, 3.0, 0.5
    across = 2.0 * (shaft + wall + bolt + more_mm)
    parts = of(Wheel(3, "external"), lock_bolt_mm=2.0 * bolt, lock_bolt_circle_mm=across)
    outlines = parts.parts.outlines
    assert (outlines.sizes.arm_bore, outlines.sizes.wall_min) == (shaft, wall)
    assert len(bolts(outlines)) == count
