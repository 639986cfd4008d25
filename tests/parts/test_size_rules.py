"""Sizes that make no machine are refused by every command, whatever it prints."""

import math

import pytest
from words import Motion, Spec, Wheel

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Arc
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.spec.tables import Size


@pytest.mark.parametrize(
    ("wheel", "motion", "largest"),
    [
        (Wheel(6), Motion(), 50.0),  # as far to the crank's axis as to the wheel's
        (Wheel(4), Motion(), 29.2893),  # L - L sin 45 deg
        (Wheel(12), Motion(), 25.8819),  # L sin 15 deg
        (Wheel(4, "internal"), Motion(), 70.7107),  # only the crank's arm is short
        (Wheel(6, steps_deg=(90.0, 30.0)), Motion(), 25.8819),  # of the shorter arm
        (Wheel(6), Motion("cycloidal", ratio=0.3), 30.0),
    ],
)
def test_the_largest_roller(wheel: Wheel, motion: Motion, largest: float) -> None:
    build(Spec(wheel, motion=motion, size=Size(roller_radius_mm=0.999 * largest)))
    with pytest.raises(GenevaError, match=f"below {largest:g}"):
        build(Spec(wheel, motion=motion, size=Size(roller_radius_mm=1.001 * largest)))


@pytest.mark.parametrize("offset", [-12.0, 0.0, 12.0])
@pytest.mark.parametrize("gap", [0.0, 0.35, 8.0])
def test_slots_end_where_the_outline_does(offset: float, gap: float) -> None:
    """The round's centre is as far along the slot as the deepest roller, and the gap: its nearest
    point to the axis, whatever the slot misses that by, is where bores and hubs have to stay."""
    size = Size(slot_bottom_clearance_mm=gap)
    found = drawn(*machine_sizes(build(Spec(Wheel(6, offset_mm=offset), size=size))))
    (round_end,) = {
        round(math.hypot(*arc.centre) - arc.radius, 9)
        for arc in found.wheel.segments
        if isinstance(arc, Arc) and abs(abs(arc.bulge) - 1.0) < 1e-12
    }
    assert found.sizes.slot_end == pytest.approx(round_end, abs=2e-9)
