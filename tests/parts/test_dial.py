"""The wheel's own holes: a keyway in its bore, bolts for the dial."""

import math

import pytest
from drawing_witness import polygon
from shapely.geometry import Polygon
from words import Spec, Wheel

from geneva_cli.design import Design
from geneva_cli.geometry.shapes import Contour, Line
from geneva_cli.spec.tables import Size

DIN = "DIN 6885-1"


def of(z=6, gearing="external", **size):
    return Design.of(Spec(Wheel(z, gearing), size=Size(**size)))


def test_the_wheels_keyway():
    """DIN 6885-1: 8 x 7 for a shaft of 25 mm, 3.3 into the hub; it points between two slots."""
    design = of(center_distance_mm=200.0, wheel_bore_mm=25.0, wheel_keyway=DIN)
    _, bore = design.drawing("wheel").shapes
    assert isinstance(bore, Contour) and bore.layer == "BORE"
    top = max((p for s in bore.segments for p in (s.start, s.end)), key=lambda p: math.hypot(*p))
    assert math.hypot(*top) == pytest.approx(math.hypot(12.5 + 3.3, 4.0))
    low, high = (math.atan2(*reversed(s.start)) for s in bore.segments[:2])
    lines = [s for s in bore.segments if isinstance(s, Line)]
    assert sorted(round(math.dist(*s), 9) for s in lines)[-1] == 8.0
    assert 0.5 * (low + high) % (math.pi / 3.0) == pytest.approx(math.pi / 6.0)
    (row,) = [c for c in design.checks if c.name == "dial_wall_mm"]
    assert row.passes


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("z", "gearing"), [(3, "external"), (6, "external"), (8, "internal")])
def test_bolts_for_the_dial(z, gearing):
    """Evenly on their circle, in the plate, with the wall that ``check`` gives."""
    design = of(z, gearing, dial_bolts=5)
    outline, *holes = design.drawing("wheel").shapes
    bolts = [h for h in holes if h.layer == "BORE" and h.centre != (0.0, 0.0)]
    assert len(bolts) == 5 and len({round(math.hypot(*b.centre), 9) for b in bolts}) == 1
    angles = sorted(math.atan2(b.centre[1], b.centre[0]) % math.tau for b in bolts)
    assert all(
        b - a == pytest.approx(math.tau / 5) for a, b in zip(angles, angles[1:], strict=False)
    )
    plate = polygon(outline, 1e-5)
    if gearing == "internal":
        plate = Polygon(polygon(holes[0], 1e-7).exterior.coords, [plate.exterior.coords])
    least = []
    for bolt in bolts:
        hole = polygon(bolt)
        assert plate.contains(hole)
        others = [o for o in holes if o is not bolt and o.layer == "BORE"]
        least += [hole.distance(plate.boundary), *(hole.distance(polygon(o)) for o in others)]
    (row,) = [c for c in design.checks if c.name == "dial_wall_mm"]
    # chords of the witness lie within its arcs, by 1e-3 mm here
    if gearing == "external":
        bore = next(h for h in holes if h.centre == (0.0, 0.0))
        least.append(polygon(bore).distance(plate.boundary))
    assert row.value == pytest.approx(min(least), abs=3e-3) and row.passes
