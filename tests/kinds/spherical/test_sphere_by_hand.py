"""Parts of a spherical machine, by hand: crank, bores and shafts."""

import math

import pytest
from test_parts_by_hand import L
from test_turned_shafts import steps
from words import Spec, Wheel

from geneva_cli import Design, Size, Spherical
from geneva_cli.geometry.plates import solids
from geneva_cli.parts.parts import parts_of


def test_the_crank_of_a_sphere():
    """Its arm is outside of the wheel, and locks over 180°: two bolts are at 135° and 225°.

    Their circle's diameter is across the sphere of the machine, whose radius is L. Half of the
    wheel's thickness is inside of that sphere.
    """

    bolts = {"lock_bolts": 2, "lock_bolt_circle_mm": 60.0, "lock_bolt_mm": 2.0}
    size = Size(
        L,
        6.0,
        shaft_fit_mm=0.2,
        pin_mm=6.0,
        press_fit_mm=0.1,
        pin_gap_mm=0.5,
        washer_mm=0.25,
        **bolts,
    )
    mechanism = Design.of(Spec(Wheel(6, "spherical"), size=size)).mechanism
    parts = parts_of(mechanism)
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
    for bore, edge in ((50.0, 70.0), (59.0, 62.0)):
        assert parts.ball.cap(60.0, bore, 2.0) == pytest.approx(math.asin(edge / 105.5))


def test_steps_on_a_sphere():
    """Seen from its axis each shaft is one of a plane: the sphere's outside is the height 0."""

    size = Size(80.0, 5.0, shafts="turned", wheel_bore_mm=16.0, wheel_hub_mm=24.0, arm_bore_mm=10.0)
    parts = parts_of(Design(Spherical(6), size=size).mechanism)
    wheel, crank = (m.part for m in parts.shafts)
    (inside, _), (under, over) = parts.ball.span_mm, parts.ball.arm_span_mm
    n, m = 1.5 * (15.0 - 14.3), 1.1
    bearing = over + 80.0 / 50.0  # the hub ends at the arm's outside
    wanted = [
        ("end", 16.0, inside - 2.3, inside - 1.1),
        ("circlip groove, DIN 471", 15.2, inside - 1.1, inside),
        ("seat of wheel", 16.0, inside, over),
        ("shoulder", 20.0, over, bearing),
        ("seat of bearing 6002", 15.0, bearing, bearing + 9.0),
        ("circlip groove, DIN 471", 14.3, bearing + 9.0, bearing + 9.0 + m),
        ("end", 15.0, bearing + 9.0 + m, bearing + 9.0 + m + n),
    ]
    for step, (name, wide, low, high) in zip(steps(wheel), wanted, strict=True):
        assert step == (name, wide, pytest.approx(low), pytest.approx(high))
    # the wheel turns inside the arm: no circlip there
    assert steps(crank)[0] == ("seat of crank", 10.0, pytest.approx(under), pytest.approx(over))
