"""Hubs and shafts: where they end, what they weigh, and what passes beside them."""

import math

import pytest

from geneva_cli import Design, External, Internal, SideCrank, Size
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import plates
from geneva_cli.parts.shafts.arm_and_shafts import crank_arm
from geneva_cli.verdict.shaft_gap import shaft_gaps

STEEL = 7850e-9  # kg/mm³
HUBS = Size(
    wheel_hub_mm=24.0,
    wheel_bore_mm=16.0,
    crank_hub_mm=16.0,
    crank_bore_mm=9.0,
    wheel_thickness_mm=10.0,
    lock_thickness_mm=6.0,
    arm_thickness_mm=8.0,
    pin_gap_mm=1.0,
)


def with_(**keys):
    return Design(External(6), size=HUBS.replace(**keys))


def part(design, name):
    (found,) = [p for p in plates(design.drawing("assembly").solid) if p.name == name]
    return found


def row(design, name):
    return next((c for c in design.checks if c.name == name), None)


def gap_of(design):
    return min(shaft_gaps(design.parts), default=None)


def test_a_hub_is_a_ring():
    """In the list of parts, and in the wheel's own inertia: m (R² + r²) / 2."""
    design = with_()
    ring = part(design, "wheel's hub")
    mass = STEEL * 9.0 * math.pi * (12.0**2 - 8.0**2)
    inertia = mass * (12.0**2 + 8.0**2) / 2.0 * 1e-6
    parts = {one["name"]: one for one in design.part_table("parts").to_rows()}
    assert parts[ring.name]["mass_kg"] == pytest.approx(mass, rel=1e-12)
    assert parts[ring.name]["inertia_kgm2"] == pytest.approx(inertia, rel=1e-12)
    whole, bare = design.wheel_plate, with_(wheel_hub_mm=0.0).wheel_plate
    assert whole.mass_kg - bare.mass_kg == pytest.approx(mass, rel=1e-10)
    assert whole.inertia_kgm2 - bare.inertia_kgm2 == pytest.approx(inertia, rel=1e-8)
    assert whole.centroid_mm == pytest.approx((0.0, 0.0), abs=1e-9)
    # it is drawn where it stands, apart from what is cut
    drawn = design.drawing("wheel")
    assert [s.radius for s in drawn.shapes if s.layer == "HUB"] == [12.0]
    keyed = with_(wheel_keyway="DIN 6885-1").drawing("wheel")
    wheel, hub = plates(keyed.solid)
    assert hub.holes == wheel.holes


def test_an_arm_beside_the_wheels_hub():
    """With a hub as wide as that it is the arm that comes nearest, not the wheel to the crank."""
    design = with_(wheel_hub_mm=82.0)
    room = crank_arm(design.parts.outlines).hub_gap
    found = row(design, "beside_shafts_mm")
    assert found.value == pytest.approx(room, abs=1e-9) and found.value > 0.0
    wide = with_(wheel_hub_mm=88.0, arm_eye_mm=16.0)
    found = gap_of(wide)
    assert found == pytest.approx(100.0 - 50.0 - 8.0 - 44.0)  # of the arm
    # a hub that ends above the arm lets it pass, but for the pin
    short = gap_of(wide.with_("size.wheel_hub_length_mm", 1.0))
    assert short == pytest.approx(100.0 - 50.0 - 2.5 - 44.0)


def test_a_crank_shaft_through_an_internal_wheel():
    """Its horns come as near to the wheel's axis as the rim, and the crank's axis is beyond."""
    design = Design(Internal(6), size=Size(crank_shaft_high_mm=4.0))
    sizes = design.parts.sizes
    found = gap_of(design)
    radius = part(design, "crank's shaft").outline.radius
    assert found == pytest.approx(sizes.rim - 100.0 - radius, abs=1e-6)
    assert gap_of(Design(Internal(6))) is None


@pytest.mark.sampled(3)
@pytest.mark.parametrize("low", [-20.0, -20.5, -36.0])
def test_a_shaft_that_the_spec_takes_through_a_link(low):
    """A side-crank's input crank turns in -30..-20 mm, and the coulisse above it.

    Its axis is 0.6 R from the crank's. There the belt round its hub and the eye of its pin, R away,
    is as wide as a share of 0.6 of the way from the one to the other.
    """
    size = Size(crank_shaft_low_mm=low)
    found = row(Design(External(6), SideCrank(A=0.6), size=size), "link_gap_mm")
    hub, eye, shaft = 8.0, 5.0, 4.5  # radii: 1.6 bores of 5, 2 pins of 2.5, the crank's bore
    if low == -20.0:
        assert found.passes
    else:
        assert found.value == pytest.approx(-(hub + 0.6 * (eye - hub)) - shaft, abs=1e-9)
        assert found.passes is False and found.nearest == "leaving out crank_shaft_low_mm"


def test_a_keyway_leaves_a_wall_of_its_hub():
    """DIN 6885-1, t2: 1.0 mm on shafts above 6 mm, 1.8 above 10 mm, 2.3 above 12 mm."""
    keyed = Size(wheel_hub_mm=20.0, wheel_keyway="DIN 6885-1")
    design = Design(External(6), size=keyed)
    assert design.parts.sizes.wheel_bore == 6.0  # of a hub of 20 mm without a keyway it is 8
    assert row(design, "wheel_bore_wall_mm").value == pytest.approx(10.0 - 6.0 - 1.8)
    given = Design(External(6), size=keyed.replace(wheel_bore_mm=15.0))
    assert row(given, "wheel_bore_wall_mm").value == pytest.approx(10.0 - 7.5 - 2.3)
    assert row(given, "wheel_bore_wall_mm").passes is False
    for part in ("wheel", "crank"):
        cut = {f"{part}_hub_mm": 20.0, f"{part}_bore_mm": 16.0, f"{part}_keyway": "DIN 6885-1"}
        with pytest.raises(GenevaError, match=rf"{part}_hub_mm = 20: it must be above 20.6, the"):
            Design(External(4), size=Size(**cut)).drawing("crank")
    # the default hub has its wall too
    wide = Size(wheel_bore_mm=6.5, wheel_keyway="DIN 6885-1", wall_min_mm=3.0)
    assert Design(External(6), size=wide).parts.sizes.wheel_hub == pytest.approx(3.25 + 1.0 + 3.0)
