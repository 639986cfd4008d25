"""Parts whose sizes a designer works out on paper, from the keys of a spec alone.

The parts are compared with their hand calculation, and the sheet's dimensions with the same one.
"""

import math

import pytest
from words import Drive, Keys, Spec, Wheel

from geneva_cli import Design, Linear
from geneva_cli.curves.plates import plates
from geneva_cli.curves.shapes import Arc
from geneva_cli.drawings.sheet.crank import draw_arm
from geneva_cli.drawings.sheet.view import View
from geneva_cli.layout.sizes import machine_sizes
from geneva_cli.parts.arm import crank_arm
from geneva_cli.parts.links import drawn_links
from geneva_cli.parts.rack_arm import crank_arm as rack_arm
from geneva_cli.spec.tables import Size

L = 100.0


def of(**size):
    return Design.of(Spec(Wheel(6), size=Size(center_distance_mm=L, roller_radius_mm=6.0, **size)))


def sizes_of(spec):
    """The sizes of a machine's parts, without the parts."""
    return machine_sizes(Design.of(spec).mechanism)[1]


def dimensions(draw, *shown):
    """The texts of the dimensions in one view of a sheet, at 1:1."""
    view = View("", 1.0)
    draw(view, *shown)
    return {measure.label.text for measure in view.measures}


def rounds(outline):
    """The radius of each arc of an outline, and its centre, from left to right."""
    arcs = (piece for piece in outline.segments if isinstance(piece, Arc))
    return sorted((*(round(x, 9) + 0.0 for x in arc.centre), round(arc.radius, 9)) for arc in arcs)


ARM = {"pin_mm": 6.0, "arm_bore_mm": 12.0, "arm_hub_mm": 26.0, "arm_eye_mm": 16.0}
BOLTS = {"lock_bolts": 2, "lock_bolt_mm": 3.0, "lock_bolt_circle_mm": 30.0}


def test_the_arm_is_the_hull_of_hub_and_eyes():
    """The pin is at L sin 30°, and the bolts at 120° and 240°.

    The disc locks over 240°, from 60° after the roller: its two bolts are a quarter and three
    quarters of that on. Each has an eye of twice its hole.
    """
    design = of(**ARM, **BOLTS, crank_bore_mm=12.0)
    arm = crank_arm(design.parts)
    x, y = 15.0 * math.cos(math.radians(120.0)), 15.0 * math.sin(math.radians(120.0))
    eyes = [(x, -y, 3.0), (x, y, 3.0), (0.0, 0.0, 13.0), (50.0, 0.0, 8.0)]
    assert rounds(arm.outline) == [pytest.approx(one) for one in eyes]
    holes = [(*bolt.centre, bolt.radius) for bolt in arm.bolts]
    assert holes == [pytest.approx((x, y, 1.5)), pytest.approx((x, -y, 1.5))]
    (pin,) = arm.pins
    assert (*pin.centre, pin.radius) == pytest.approx((50.0, 0.0, 3.0))
    on_sheet = {"R 8", "R 13", "2× R 3", "50", "Ø 6 P7 (-0.008/-0.02)"}
    on_sheet |= {"Ø 12 H7 (+0.018/0)", "2× Ø 3 H7 (+0.01/0) on Ø 30"}
    assert dimensions(draw_arm, design.mechanism, arm) == on_sheet


def test_default_sizes_are_those_of_the_reference_page():
    """L = 150 mm, six slots: r = L/20 and R = L/2, whose keys are left out.

    The bore of the wheel is up to L/6, which is 25 mm, the bore of a standard bearing. The next
    smaller one has 20 mm. The hub is 1.6 bores wide, which is a rounded number too.
    """
    sizes = sizes_of(Spec(Wheel(6), size=Size(150.0)))
    assert sizes.roller == 7.5
    assert sizes.rim == pytest.approx(math.hypot(75.0 * math.sqrt(3.0), 7.5))
    assert sizes.slot_bottom == pytest.approx(7.5 / 20.0)
    assert sizes.slot_end == pytest.approx(150.0 - 75.0 - 7.5 - 7.5 / 20.0)
    assert sizes.lock == pytest.approx(75.0 - 7.5 - 7.5)  # the horn is as thick as r
    assert sizes.relief == sizes.wall_min == pytest.approx(150.0 / 200.0)
    assert (sizes.wheel_bore, sizes.wheel_hub, sizes.pin) == (12.5, 20.0, 3.5)
    assert sizes_of(Spec(Wheel(6), size=Size(149.9))).wheel_bore == 10.0


def test_default_sizes_of_an_internal_wheel():
    """Its slots end at L + R + r and their clearance; a roller's width is left, at least L/20."""
    for r, left in ((4.0, 5.0), (8.0, 8.0)):
        sizes = sizes_of(Spec(Wheel(6, "internal"), size=Size(L, r)))
        assert sizes.slot_end == pytest.approx(L + 50.0 + r + r / 20.0)
        assert sizes.outer == pytest.approx(sizes.slot_end + left)


def test_default_sizes_of_the_arm():
    """An eye is twice as wide as its hole, up to what passes the wheel's hub; a hub is 1.6 bores.

    The bolts' holes are at most L/40 wide, and at most half as wide as the ring that they are in.
    """
    parts = of(arm_bore_mm=25.0, crank_bore_mm=0.0).parts
    arm = crank_arm(parts)
    assert (arm.hub, arm.eye) == (20.0, 6.0)
    assert {bolt.radius for bolt in arm.bolts} == {L / 80.0}
    wide = crank_arm(of(wheel_hub_mm=90.0, pin_mm=6.0).parts)
    # from the pin, at R = L/2, to the hub are 5 mm
    assert (wide.eye, wide.hub_gap) == (pytest.approx(5.0), pytest.approx(0.0, abs=1e-12))
    ring = crank_arm(of(lock_bolts=1, lock_bolt_circle_mm=74.0, crank_bore_mm=8.0).parts)
    (bolt,) = ring.bolts
    # the disc's radius is R - 2 r, so that 1 mm is left outside of the bolts' circle
    assert (*bolt.centre, bolt.radius) == pytest.approx((-37.0, 0.0, 0.5))


def test_each_sector_has_its_own_bolts():
    """The rim reaches past the crank's axis, so that two rollers leave two sectors, up and down."""
    size = Size(L, 4.0, wheel_radius_mm=102.0, lock_bolts=1, lock_bolt_circle_mm=110.0)
    drawing = Design.of(Spec(Wheel(4), Drive(rollers=2), size=size)).drawing("crank")
    discs = [plate for plate in plates(drawing.solid) if plate.layer == "CRANK"]
    bolts = [[hole.centre for hole in disc.holes] for disc in discs]
    assert bolts == [[pytest.approx((0.0, side * 55.0))] for side in (1.0, -1.0)]
    heights = [disc.outline.segments[0].start[1] for disc in discs]
    assert heights[0] > 0.0 > heights[1]


def test_the_bolts_of_a_racks_arm_are_amid_its_locking_sector():
    """R = 50, r = 6: the sector reaches from R - rho + R/200 to rho = R - 2 r.

    It lies over half a turn opposite the roller, so the bolts are at 135° and 225°.
    """
    design = Design(Linear(6), size=Size(center_distance_mm=50.0, roller_radius_mm=6.0))
    far = 0.5 * (50.0 - 38.0 + 0.25 + 38.0)
    arm, at = rack_arm(design.mechanism), far * math.sqrt(0.5)
    holes = [(*bolt.centre, bolt.radius) for bolt in arm.bolts]
    assert holes == [pytest.approx((-at, at, 1.25)), pytest.approx((-at, -at, 1.25))]
    on_sheet = {"50", "Ø 6 P7 (-0.008/-0.02)", "R 38", "R 6", "Ø 10 H7 (+0.015/0)"}
    on_sheet.add(f"2× Ø 2.5 H7 (+0.01/0) on Ø {2.0 * far:g}")
    assert dimensions(draw_arm, design.mechanism, arm) == on_sheet


def test_a_guide_is_as_long_as_its_block_needs():
    """A crank of 40 on a rod of 100 moves the block from 60 to 140 mm off the crank's axis.

    The block is 1.6 holes wide and half as long again, and a quarter of a hole is left at either
    end of its slot. The guide's screws are two holes beyond the slot, with eyes as on pins.
    """
    keys = Keys("slider-crank", 40.0, 100.0, 80.0, 90.0)
    size = Size(roller_radius_mm=6.0, link_pin_mm=10.0)
    design = Design.of(Spec(Wheel(8), Drive("slider-crank"), keys, size=size))
    links = drawn_links(design.mechanism, design.parts)
    cut = {plate.name: plate for plate in links.plates}
    near = 2e-4  # the path is sampled each quarter of a degree, and 40 (1 - cos 0.125°) is less
    slot, *screws = cut["guide"].holes
    ends = 60.0 - 4.0 - 1.25, 140.0 + 4.0 + 1.25
    assert rounds(cut["guide's block"].outline) == [(-4.0, 0.0, 8.0), (4.0, 0.0, 8.0)]
    assert rounds(slot) == [pytest.approx((x, 0.0, 8.0), abs=near) for x in ends]
    beyond = ends[0] - 8.0 - 10.0, ends[1] + 8.0 + 10.0
    assert [(*one.centre, one.radius) for one in screws] == [
        pytest.approx((x, 0.0, 5.0), abs=near) for x in beyond
    ]
    eyes = {(x, 0.0, 10.0) for x in beyond} | {(x, 0.0, 13.0) for x in ends}
    outline = {tuple(round(x, 3) for x in one) for one in rounds(cut["guide"].outline)}
    assert outline == eyes
    (spacer,) = (one.part for one in links.joined if one.part.name.startswith("spacer"))
    # amid the edges of hole and eye, between the planes of the links that it keeps apart
    assert (spacer.outline.radius, spacer.high, spacer.low) == (7.5, -20.0, -40.0)
