"""Parts of a spherical machine, by hand: crank, bores and shafts."""

import math

import pytest
from test_parts_by_hand import L
from words import Spec, Wheel

from geneva_cli import Design, Size
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
