"""Parts of a spherical machine, by hand: crank, bores and shafts."""

import math

import pytest
from test_parts_by_hand import L

from geneva_cli import Design, Size, Spherical
from geneva_cli.geometry.plates import moments, solids
from geneva_cli.parts.parts import parts_of
from geneva_cli.verdict.checks import single_check


def test_the_crank_of_a_sphere():
    """Its arm is outside of the wheel, and locks over 180°: two bolts are at 135° and 225°.

    Their circle's diameter is across the sphere of the machine, whose radius is L. Half of the
    wheel's thickness is inside of that sphere.
    """
    bolts = {"lock_bolts": 2, "lock_bolt_circle_mm": 60.0, "lock_bolt_mm": 2.0}
    pins = {"shaft_fit_mm": 0.2, "pin_mm": 6.0, "press_fit_mm": 0.1, "pin_gap_mm": 0.5}
    size = Size(L, 6.0, washer_mm=0.25, **pins, **bolts)
    parts = parts_of(Design(Spherical(6), size=size).mechanism)
    far, height = 30.0 * math.sqrt(0.5), math.sqrt(L**2 - 30.0**2)
    places = [(hole.axis[0] * L, hole.axis[1] * L, hole.axis[2] * L) for hole in parts.arm.bolts]
    assert places == [pytest.approx((-far, side * far, height)) for side in (1.0, -1.0)]
    assert {hole.radius for hole in parts.arm.bolts} == {1.0}
    # slots end R/L = 30° off the crank's axis, which is 90° off, less a roller and r/20
    assert parts.ball.slot_end == pytest.approx(math.pi / 3.0 - 0.06 - 0.003)
    every = {one.name: one for one in solids(parts.crank.part)}
    assert (every["pin"].outline.radius, parts.arm.pins[0].radius) == (3.0, pytest.approx(2.95))
    assert [hole.radius for hole in every["roller"].holes] == [pytest.approx(3.1)]
    spans = {name: (one.inner, one.outer) for name, one in every.items() if hasattr(one, "inner")}
    assert spans["roller"] == (95.0, 105.0)
    assert spans["arm"] == (105.5, 115.5)
    assert parts.ball.shafts_end_mm(size) == 115.75
    # a cap about a hub leaves a wall as thick as the hub's, or the least one
    hub = size.replace(arm_hub_mm=120.0, wall_min_mm=2.0)
    for bore, edge in ((49.9, 70.0), (58.9, 62.0)):
        *_, cap = parts.ball._replace(arm_bore_mm=bore).arm_radii(hub)
        assert cap == pytest.approx(math.asin(edge / 105.5))


def test_the_keyways_of_a_shaft_and_its_hub_face_each_other():
    keys = dict.fromkeys(("wheel_keyway", "crank_keyway"), "DIN 6885-1")
    size = Size(L, wheel_bore_mm=16.0, wheel_hub_mm=34.0, arm_bore_mm=12.0, **keys)
    members = parts_of(Design(Spherical(6), size=size).mechanism).members
    every = {one.name: one for member in members for one in solids(member.part)}
    for part, hub, way in (("wheel", "wheel's", math.pi / 6.0), ("crank", "arm's", math.pi)):
        ahead = moments(every[f"{hub} hub"].holes[0]).centroid
        behind = moments(every[f"{part}'s shaft"].outline).centroid  # its slot takes some away
        away = [math.remainder(math.atan2(y, x) - way, math.tau) for x, y in (ahead, behind)]
        assert [abs(one) for one in away] == pytest.approx([0.0, math.pi])


@pytest.mark.parametrize(
    ("size", "wall"),
    [
        ({"wheel_bore_mm": 20.0, "wheel_hub_mm": 20.4}, 0.2),
        # DIN 6885-1: the keyway of a bore of 20 mm is 2.8 mm deep
        ({"wheel_bore_mm": 20.0, "wheel_hub_mm": 27.0, "wheel_keyway": "DIN 6885-1"}, 0.7),
    ],
)
def test_the_wall_of_a_spherical_hub_is_checked_around_its_bore(size, wall):
    design = Design(Spherical(5, axes_deg=75.0), size=Size(100.0, 5.0, **size))
    check = single_check(design.parts, "wheel_bore_wall_mm")
    assert check.value == pytest.approx(wall, rel=1e-12)  # halves of the numbers above
    assert check.limit == 0.5  # L/200
    assert check.passes is (wall >= 0.5)
