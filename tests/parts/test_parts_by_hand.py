"""Parts whose sizes a designer works out on paper, from the keys of a spec alone.

The parts are compared with their hand calculation, and the sheet's dimensions with the same one.
"""

import copy
import math

import numpy as np
import pytest
import repo
from drawing_witness import vertices
from scipy.spatial import KDTree
from words import Drive, Keys, Motion, Spec, Wheel

from geneva_cli import Design, EllipticalGears, External, Internal, load
from geneva_cli.drawings.sheet.bore_dimensions import bored
from geneva_cli.drawings.sheet.crank_views import draw_arm, draw_disc, draw_roller
from geneva_cli.drawings.sheet.link_views import draw_link
from geneva_cli.drawings.sheet.standing import draw_frame
from geneva_cli.drawings.sheet.view import View
from geneva_cli.drawings.sheet.wheel_views import draw_wheel
from geneva_cli.geometry.measure import bounds
from geneva_cli.geometry.moments import moments
from geneva_cli.geometry.plates import plates, solids
from geneva_cli.geometry.shapes import Arc, Circle
from geneva_cli.geometry.sheet import CENTRE, OUTLINE
from geneva_cli.parts.arm import crank_arm
from geneva_cli.parts.first_pair import first_pair
from geneva_cli.parts.frame import passing_arm
from geneva_cli.parts.gears.gear_pair import gear_shafts
from geneva_cli.parts.links.link_planes import planes
from geneva_cli.parts.links.links import drawn_links
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.cut_outlines import cut_arcs, drawn
from geneva_cli.parts.outlines.reliefs import arc_floor, reliefs, widened
from geneva_cli.parts.shafts.bores import Bore, bore_of
from geneva_cli.parts.shafts.hub_and_shafts import crank_hub
from geneva_cli.parts.shafts.shaft import Ends, Shaft
from geneva_cli.parts.slots.roller_paths import mouth_corners
from geneva_cli.parts.stressed import lock_of, stressed
from geneva_cli.spec.tables import Size

L = 100.0


def of(**size):
    return Design.of(Spec(Wheel(6), size=Size(center_distance_mm=L, roller_radius_mm=6.0, **size)))


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
    quarters of that on. Each has an eye of twice the disc's hole of 3 mm, through which M2.5 passes
    (2.9 mm, ISO 273). In the arm is its thread, of a pitch of 0.45 mm.
    """
    design = of(**ARM, **BOLTS, crank_bore_mm=12.0)
    arm = crank_arm(design.parts.outlines)
    x, y = 15.0 * math.cos(math.radians(120.0)), 15.0 * math.sin(math.radians(120.0))
    eyes = [(x, -y, 3.0), (x, y, 3.0), (0.0, 0.0, 13.0), (50.0, 0.0, 8.0)]
    assert rounds(arm.outline) == [pytest.approx(one) for one in eyes]
    holes = [(*bolt.centre, bolt.radius) for bolt in arm.bolts]
    assert holes == [pytest.approx((x, y, 1.025)), pytest.approx((x, -y, 1.025))]
    (pin,) = arm.pins
    assert (*pin.centre, pin.radius) == pytest.approx((50.0, 0.0, 3.0))
    on_sheet = {"R 8", "R 13", "2× R 3", "50", "Ø 6 P7 (-0.008/-0.02)"}
    on_sheet |= {"Ø 12 H7 (+0.018/0)", "2× Ø 2.05, tapped M2.5 on Ø 30"}
    assert dimensions(draw_arm, design.mechanism, arm) == on_sheet


def test_the_arm_is_drawn_whole_with_its_centre_lines():
    """They are as much longer than the hub as than the eye, and all that is cut is a full line."""
    design, view = of(**ARM, crank_bore_mm=12.0), View("", 1.0)
    draw_arm(view, design.mechanism, crank_arm(design.parts.outlines))
    lines = [
        one.segments[0] for one in view.shapes if one.layer == CENTRE if hasattr(one, "segments")
    ]
    halves = {
        (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])): 0.5 * math.dist(start, end)
        for start, end in lines
    }
    assert halves[0.0, 0.0] - 13.0 == pytest.approx(halves[50.0, 0.0] - 8.0)
    assert halves[0.0, 0.0] > 13.0
    closed = [one for one in view.shapes if getattr(one, "closed", one.layer != CENTRE)]
    assert {one.layer for one in closed} == {OUTLINE} and len(closed) == 5


def test_each_sector_has_its_own_bolts():
    """The rim reaches past the crank's axis, so that two rollers leave two sectors, up and down."""
    size = Size(L, 4.0, wheel_radius_mm=102.0, lock_bolts=1, lock_bolt_circle_mm=110.0)
    drawing = Design.of(Spec(Wheel(4), Drive(rollers=2), size=size)).drawing("crank")
    discs = [plate for plate in plates(drawing.solid) if plate.layer == "CRANK"]
    bolts = [[hole.centre for hole in disc.holes] for disc in discs]
    assert bolts == [[pytest.approx((0.0, side * 55.0))] for side in (1.0, -1.0)]
    heights = [disc.outline.segments[0].start[1] for disc in discs]
    assert heights[0] > 0.0 > heights[1]


def test_a_guide_is_as_long_as_its_block_needs():
    """A crank of 40 on a rod of 100 moves the block from 60 to 140 mm off the crank's axis.

    The block is 1.6 holes wide and half as long again, and a quarter of a hole is left at either
    end of its slot. The guide's screws are two pins beyond the slot, with eyes as on pins of 10 mm,
    and M8 has the largest clearance hole below that, 9 mm.
    """
    keys = Keys("slider-crank", 40.0, 100.0, 80.0, 90.0)
    size = Size(roller_radius_mm=6.0, link_pin_mm=10.0)
    design = Design.of(Spec(Wheel(8), Drive("slider-crank"), keys, size=size))
    links = drawn_links(design.mechanism, design.parts.outlines)
    cut = {plate.name: plate for plate in links.plates}
    near = 2e-4  # the path is sampled each quarter of a degree, and 40 (1 - cos 0.125°) is less
    slot, *screws = cut["guide"].holes
    ends = 60.0 - 4.0 - 1.25, 140.0 + 4.0 + 1.25
    assert rounds(cut["guide's block"].outline) == [(-4.0, 0.0, 8.0), (4.0, 0.0, 8.0)]
    assert rounds(slot) == [pytest.approx((x, 0.0, 8.0), abs=near) for x in ends]
    beyond = ends[0] - 8.0 - 10.0, ends[1] + 8.0 + 10.0
    assert [(*one.centre, one.radius) for one in screws] == [
        pytest.approx((x, 0.0, 4.5), abs=near) for x in beyond
    ]
    eyes = {(x, 0.0, 10.0) for x in beyond} | {(x, 0.0, 13.0) for x in ends}
    outline = {tuple(round(x, 3) for x in one) for one in rounds(cut["guide"].outline)}
    assert outline == eyes
    # from the first screw to the slot, and from end to end of the slot and of the screws
    on_sheet = {"18", "90.5", "126.5", "16 H7 (+0.018/0)", "4× R 13", "2× R 10"}
    on_sheet.add("2× Ø 9 for M8")
    views = [on_sheet, {"24", "16 g6 (-0.006/-0.017)", "Ø 10 H7 (+0.015/0)"}]
    shown = [one for one in links.cut if one.part.name.startswith("guide")]
    assert [dimensions(draw_link, one, links, design.mechanism) for one in shown] == views
    # the default bore of L/10 is 20 mm, and 30 mm is the rounded number below 1.6 of that
    assert rounds(cut["crank"].outline) == [(0.0, 0.0, 15.0), (40.0, 0.0, 10.0)]
    joined = {one.part.name: one.part for one in links.joined}
    spacer, pin = (joined[f"{name} of rod and guide"] for name in ("spacer", "pin"))
    # amid the edges of hole and eye, between the planes of the links that it keeps apart
    assert (spacer.outline.radius, spacer.high, spacer.low) == (7.5, -20.0, -40.0)
    assert (pin.outline.radius, pin.high, pin.low) == (5.0, 0.0, -60.0)


def test_pins_and_rollers_run_with_the_fit():
    """Pins are as thick as their keys say; their holes and rollers' bores are wider by the fit."""
    size = Size(L, 4.0, pin_mm=4.0, shaft_fit_mm=0.2)
    plain, cam = (
        Design.of(Spec(Wheel(6), drive, motion=motion, size=size))
        for drive, motion in ((Drive(), None), (Drive("cam"), Motion("cycloidal")))
    )
    shown = {"Ø 8 g6 (-0.005/-0.014)", "Ø 4.2 H7 (+0.012/0)"}
    assert dimensions(draw_roller, plain.mechanism) == shown
    bores = [one for one in plates(plain.drawing("crank").solid) if one.name == "roller"]
    links = drawn_links(cam.mechanism, cam.parts.outlines)
    bores += [one.part for one in links.joined if one.part.name == "roller in the groove"]
    assert [hole.radius for one in bores for hole in one.holes] == [2.1, 2.1]
    keys = Keys("slider-crank", 40.0, 100.0, 80.0, 90.0)
    size = Size(roller_radius_mm=6.0, link_pin_mm=10.0, shaft_fit_mm=0.2)
    sliding = Design.of(Spec(Wheel(8), Drive("slider-crank"), keys, size=size))
    links = drawn_links(sliding.mechanism, sliding.parts.outlines)
    pins = {one.part.outline.radius for one in links.joined if one.part.name.startswith("pin")}
    assert pins == {5.0}
    (rod,) = (plate for plate in links.plates if plate.name == "rod")
    assert 5.1 in {hole.radius for hole in rod.holes}


def test_heights_above_and_below_the_wheel():
    """The arm is ``pin_gap_mm`` below the wheel, and disc, crank's hub and pin stand on it.

    The wheel's hub reaches as far down as the arm, and the frame is a washer below both.
    """
    thick = {"wheel_thickness_mm": 8.0, "lock_thickness_mm": 7.0, "arm_thickness_mm": 5.0}
    hubs = {"wheel_hub_mm": 24.0, "crank_hub_mm": 14.0, "crank_hub_length_mm": 12.0}
    design = of(**thick, **hubs, pin_gap_mm=0.5, washer_mm=0.25, crank_bore_mm=8.0)
    every = {one.name: (one.low, one.high) for one in plates(design.drawing("assembly").solid)}
    assert every == {
        "wheel": (0.0, 8.0),
        "wheel's hub": (-5.5, 0.0),
        "arm": (-5.5, -0.5),
        "locking disc": (-0.5, 6.5),
        "crank's hub": (6.5, 11.5),
        "roller": (0.0, 8.0),
        "pin": (-5.5, 8.0),
        "wheel's shaft": (-10.75, 8.0),
        "crank's shaft": (-10.75, 11.5),
        "frame": (-10.75, -5.75),
    }


def test_a_groove_plate_has_its_screws_amid_its_rim():
    """The rim is 1.5 rollers wide, with four screws at 45°: M2.5 for half of 6 mm."""
    drive, motion = Drive("cam"), Motion("cycloidal")
    design = Design.of(Spec(Wheel(6), drive, motion=motion, size=Size(L, 4.0, wheel_hub_mm=12.0)))
    base, ring, _ = plates(design.drawing("groove-plate").solid)
    groove, *screws = ring.holes
    # the flank is written within a micrometre, as are its chords
    far = max(math.hypot(*point) for point in vertices(groove, 1e-3))
    assert base.outline.radius - far == pytest.approx(6.0, abs=2e-3)
    at = (base.outline.radius - 3.0) * math.sqrt(0.5)
    corners = [(at, at), (-at, at), (-at, -at), (at, -at)]
    assert [one.centre for one in screws] == [pytest.approx(corner) for corner in corners]
    assert {one.radius for one in screws} == {1.45}
    assert (base.low, base.high, ring.high) == (-30.0, -20.0, -10.0)


def test_a_fixed_gear_is_screwed_to_the_frame_below_the_hub():
    """Three screws, from 45° on; a hub of 60 mm lowers the frame, so rings stand between both.

    The planet of 19.5 mm rolls about the gear of 58.5 mm, and so past the hub of 20 mm. M3 passes
    holes of 4 mm (3.4 mm by ISO 273), and its thread in the frame has a pitch of 0.5 mm.
    """
    sizes = {"wheel_hub_mm": 40, "wheel_hub_length_mm": 60, "gear_bolts": 3}
    sizes |= {"gear_bolt_circle_mm": 66, "gear_bolt_mm": 4}
    own = [f"size.{key}={value}" for key, value in sizes.items()]
    design = load(str(repo.DESIGNS / "epicyclic-soft-z6.toml"), own)
    parts = design.parts.flat
    turns = [math.radians(45.0 + 120.0 * k) for k in range(3)]
    screws = [(160.0 + 33.0 * math.cos(turn), 33.0 * math.sin(turn)) for turn in turns]
    assert [ring.at for ring in parts.spacers] == [pytest.approx(at) for at in screws]
    held = [hole.centre for hole in parts.frame.part.holes if hole.radius == 1.25]
    assert held == [pytest.approx(at) for at in screws]
    for ring in (one.part for one in parts.spacers):
        (bore,) = ring.holes
        assert (ring.outline.radius, bore.radius) == (4.0, 2.0)
        assert (ring.low, ring.high) == (parts.frame.part.high, -48.0) == (-60.0, -48.0)
    gap = planes(design.parts.outlines, parts.links).nearest
    assert gap.gap == pytest.approx(160.0 - 58.5 - 2.0 * 19.5 - 20.0)


def test_keyways_of_a_shaft():
    """DIN 6885-1 for 20 mm: b = 6 and t1 = 3.5, over all but a tenth of the seat at either end.

    The keyway is a rectangle from the shaft's circle down to r - t1, whose area is that of the
    circle's strip of width b beyond that.
    """
    size = Size(wheel_keyway="DIN 6885-1", wheel_bore_mm=20.0, shafts="turned")
    section = bore_of(size, "wheel", 10.0).section("SHAFT", 0.3)
    strip = 3.0 * math.sqrt(91.0) + 100.0 * math.asin(0.3)
    cut = strip - 6.0 * (10.0 - 3.5)
    assert moments(section).area == pytest.approx(100.0 * math.pi - cut, rel=1e-12)
    solid = Design(External(6), size=size).drawing("assembly").solid
    (shaft,) = (one for one in solids(solid) if one.name == "wheel's shaft")
    ends = [one.high for one in shaft.plates if one.name.startswith("seat of wheel")]
    assert ends == pytest.approx([1.0, 9.0, 10.0])


def test_the_relief_of_the_disc():
    """The wheel turns over 120° of the crank. The arc is the triangle of entry, scaled to the disc.

    Its angle at the crank is 60°, so its legs are rho/cos 60° and rho tan 60°. A sector ends half a
    millimetre, L/200, below the rim.
    """
    lock, rim = 50.0 - 6.0 - 0.1 - 6.0, math.hypot(50.0 * math.sqrt(3.0), 6.0)
    shown = {"120°", "Ø 75.8 h6 (0/-0.019)", "Ø 8 H7 (+0.015/0)"}
    radius, away = lock * math.sqrt(3.0), 2.0 * lock
    reliefs = {
        "arc": {f"R {radius:.3f}", f"{away - radius:.3f}"},
        "sector": {f"R {L - rim - 0.5:.3f}".rstrip("0")},
    }
    for relief, own in reliefs.items():
        keys = {"relief": relief, "crank_bore_mm": 8.0, "lock_bolts": 0}
        parts = of(**keys, lock_clearance_mm=0.1).parts.flat
        assert dimensions(draw_disc, parts) == shown | own
    assert arc_floor(parts.outlines.assembly, lock) == pytest.approx(away - radius)


def test_the_dimensions_of_a_wheel():
    """Six slots, 0.1 mm wider than the roller on either side, and recesses as much wider than rho.

    The disc leaves a horn of 6 mm beside half a slot of 6.1 mm. A slot begins where the rim,
    sqrt(L² cos² 30° + r²), meets its wall, half a slot off its axis.
    """
    clearances = {"slot_clearance_mm": 0.1, "lock_clearance_mm": 0.1}
    parts = of(**clearances, wheel_bore_mm=16.0).parts.flat
    rim, end = math.hypot(50.0 * math.sqrt(3.0), 6.0), L - 50.0 - 0.3 - 6.1
    long = math.sqrt(rim**2 - 6.1**2) - end
    shown = {f"Ø {2.0 * rim:.2f}", f"{end:g}", f"6× {long:.3f}", "100", "6× 30°", "6× 60°"}
    shown |= {"6× 12.2 H7 (+0.018/0)", "6× R 6.1", "6× Ø 75.8 H7 (+0.03/0)", "Ø 16 H7 (+0.018/0)"}
    assert dimensions(draw_wheel, parts) == shown


def test_a_coupon_has_its_slots_side_by_side():
    """r = 6: walls of 0.6 r and numbers 0.6 r high; the widest of eight slots has 0.3 mm a side.

    The roller has its own diameter to travel in each. Holes are thinner than the pin by the press.
    """
    drawing = of(pin_mm=6.0).drawing("coupon")
    plate, roller = plates(drawing.solid)
    box = bounds(plate.outline)
    wall, widest = 3.6, 6.3
    # below the slots: the pin's holes, and a number below either row
    high = 2.0 * 3.6 + wall + 2.0 * (wall + 3.0) + 2.0 * (wall + widest + 6.0)
    assert (box.x1, box.y1) == pytest.approx((wall + 8.0 * (2.0 * widest + wall), high))
    holes = [hole for hole in plate.holes if isinstance(hole, Circle)]
    presses = (0.0, 0.01, 0.02, 0.03, 0.05, 0.08, 0.1, 0.15)
    assert [6.0 - 2.0 * hole.radius for hole in holes] == pytest.approx(presses, abs=1e-12)
    boxes = [bounds(hole) for hole in plate.holes[len(holes) :]]
    clearances = (0.0, 0.02, 0.04, 0.06, 0.1, 0.15, 0.2, 0.3)
    assert [one.x1 - one.x0 for one in boxes] == pytest.approx([12.0 + 2.0 * c for c in clearances])
    assert [one.y1 - one.y0 for one in boxes] == pytest.approx([24.0 + 2.0 * c for c in clearances])
    assert (roller.outline.radius, roller.holes[0].radius) == (6.0, 3.0)


def test_set_screws_are_amid_their_hubs():
    """A quarter of a turn after the keyway, which points away from the crank's roller."""
    keys = {"crank_bore_mm": 10.0, "crank_hub_mm": 20.0, "crank_hub_length_mm": 22.0}
    parts = of(**keys, crank_keyway="DIN 6885-1", crank_screw_mm=3.0, lock_bolts=0).parts.outlines
    hub = crank_hub(parts)
    (hole,) = hub.cross
    # amid the hub's wall, from the keyway's corner at 5 + 1.4 mm and 1.5 mm aside, to 10 mm
    assert hole.at == pytest.approx((0.0, -0.5 * (10.0 + math.hypot(6.4, 1.5))), abs=1e-9)
    assert (hole.height, hole.radius) == (pytest.approx(16.0), 1.25)
    keys |= {"crank_hub_mm": 30.0}
    holes = crank_hub(of(**keys, crank_clamp_mm=3.0, lock_bolts=0).parts.outlines).cross
    assert [one.height for one in holes] == pytest.approx([16.0, 16.0])


def test_a_frame_leaves_three_corners_about_its_holes():
    """Corners of L/20 have holes of up to 0.8 of that, three corners beyond the others: M3.

    The shafts of 16 and 8 mm are at 0 and L: the frame is L + 8 + 4 + 8 (L/20) long.
    """
    parts = of(wheel_bore_mm=16.0, crank_bore_mm=8.0).parts.flat
    shown = {f"{L + 12.0 + 40.0:g}", "56", "28", "100", "23", "119", "4× R 5"}
    shown |= {"Ø 16 H7 (+0.018/0)", "Ø 8 H7 (+0.015/0)", "4× Ø 3.4 for M3"}
    assert dimensions(draw_frame, parts.frame.part) == shown


def test_holes_of_a_frame_are_bores_for_its_shafts():
    """They are ``shaft_fit_mm`` wider than a shaft, and L/10 for a wheel of one piece with its own.

    Corners are at least three walls wide. M4 has a clearance hole below 0.8 of 6 mm: 4.5 mm.
    """
    fit = {"shaft_fit_mm": 0.2, "wall_min_mm": 2.0}
    for bore, hole in ((16.0, 8.1), (0.0, 5.0)):
        parts = of(wheel_bore_mm=bore, crank_bore_mm=8.0, **fit).parts.flat
        wheel, crank, *mounts = parts.frame.part.holes
        assert (wheel.radius, crank.radius) == (pytest.approx(hole), pytest.approx(4.1))
        assert {one.radius for one in mounts} == {2.25}
        assert {radius for *_, radius in rounds(parts.frame.part.outline)} == {6.0}
        shafts = {one.part.name: one.part.outline.radius for one in parts.shafts}
        assert shafts["crank's shaft"] == 4.0


def test_a_ring_gear_is_as_wide_as_two_eyes():
    """A link's pin is L/20 wide, and an eye twice that; M2 for L/40 is amid the rim, at 45°."""
    keys = Keys("epicyclic", "shockless", fixed="ring")
    design = Design.of(Spec(Wheel(4), Drive("epicyclic"), keys, size=Size(L)))
    (ring,) = (one for one in design.parts.flat.links.gears if one.teeth.inside)
    assert ring.plate.outline.radius == pytest.approx(ring.radius + 10.0)
    at = (ring.radius + 5.0) * math.sqrt(0.5)
    assert [one.centre for one in ring.bolts] == [
        pytest.approx(corner) for corner in ((at, at), (-at, at), (-at, -at), (at, -at))
    ]
    assert {one.radius for one in ring.bolts} == {1.2}


def test_a_first_crank_is_as_wide_as_its_link():
    """The first of two wheels has a machine of its own, whose arm is the drawn link."""
    design = load(str(repo.DESIGNS / "geneva-pair.toml"))
    (link,) = drawn_links(design.mechanism, design.parts.outlines).plates
    (_, _, eye), (_, _, hub) = sorted(rounds(link.outline), key=lambda one: one[2])
    size = first_pair(design.mechanism, design.parts.outlines).spec.size
    assert (size.arm_eye_mm, size.arm_hub_mm) == pytest.approx((2.0 * eye, 2.0 * hub))


def test_a_driver_gear_has_the_usual_bore():
    """Up to L/10: of a standard bearing, so 10 or 9 mm."""
    gears = EllipticalGears(eccentricity=0.2, gear_distance_mm=60.0)
    for distance, bore in ((100.0, 5.0), (99.9, 4.5)):
        mechanism = Design(External(6), gears, size=Size(center_distance_mm=distance)).mechanism
        ends = Ends(-20.0, 10.0, crank_has_one=True)
        (driver,) = gear_shafts(mechanism, None, ends, 5.0)
        assert (driver.name, driver.bore.radius) == ("driver gear's shaft", bore)


def test_an_eye_about_a_rollers_pin_passes_the_wheels_hub():
    """The hub is three quarters of the way from the axis to a slot of 1.05 rollers.

    The roller comes as near to that as L less carrier and planet's arm, in line.
    """
    keys = Keys("epicyclic", "shockless")
    size = Size(L, 8.0, pin_mm=15.0)
    design = Design.of(Spec(Wheel(4), Drive("epicyclic"), keys, size=size))
    links = design.parts.flat.links
    arms = (max(abs(hole.centre[0]) for hole in plate.holes) for plate in links.plates)
    near = L - sum(arms)
    eye = near - 0.75 * (near - 1.05 * 8.0)
    assert links.sizes.roller_eye == pytest.approx(eye)


def test_the_end_of_an_arm_passes_a_shoulder():
    """Its end is R + eye from the crank's axis; a shoulder is 1.25 bores wide."""
    shaft = Shaft("wheel's shaft", "wheel", Bore(8.0), (), -20.0, 10.0, (0.0, 0.0))
    for eye, near in ((40.1, [("arm", -10.0, 0.0)]), (39.9, [])):
        parts = of(arm_eye_mm=2.0 * eye).parts.outlines
        assert [seat[:3] for seat in passing_arm(parts, [shaft])] == near


def test_levers_of_the_pin_and_of_the_shafts():
    """The force is amid the wheel's 8 mm; levers are from there to the middle of arm or frame.

    Between wheel and frame are a gap of 0.5 mm, the arm's 5 mm and a washer; the frame is as thick
    as the arm, and bears a shaft in its middle.
    """
    thick = {"wheel_thickness_mm": 8.0, "arm_thickness_mm": 5.0, "pin_gap_mm": 0.5}
    design = of(**thick, washer_mm=0.25, crank_bore_mm=8.0)
    parts = stressed(*machine_sizes(design.mechanism))
    assert parts.arm.offset == pytest.approx(4.0 + 0.5 + 2.5)
    assert parts.arm.length == pytest.approx(50.0)
    for shaft in (parts.crank_shaft, parts.wheel_shaft):
        assert shaft.overhang == pytest.approx(4.0 + 0.5 + 5.0 + 0.25 + 2.5)


def test_teeth_leave_the_backlash_between_them():
    """Along the pitch circles at work both teeth and the backlash fill the pitch."""
    keys = ["size.gear_module_mm=2", "size.gear_backlash_mm=0.2"]
    design = load(str(repo.DESIGNS / "gear-sector.toml"), keys)
    gears = design.parts.flat.links.gears
    thick = sum(one.cut.teeth.thickness(one.radius) for one in gears)
    for one in gears:
        assert thick == pytest.approx(one.radius * one.cut.teeth.step - 0.2, rel=1e-9)


def test_a_low_mouth_is_raised_by_a_fifth():
    """Steps of 90° and 30° have two cranks' radii, L sin 45° and L sin 15°, and two rims.

    The recess is that of the shorter arm, less a roller and a horn. It ends L - rho from the
    wheel's axis, and the lower mouths are raised to a fifth of the way from there to the rim.
    """
    spec = Spec(Wheel(6, steps_deg=(90.0, 30.0)), size=Size(L, 4.0, wheel_bore_mm=6.0))
    arcs = [one for one in Design.of(spec).parts.outlines.wheel.segments if isinstance(one, Arc)]
    about_axis = {one.radius for one in arcs if math.hypot(*one.centre) < 1e-9}
    short = math.radians(15.0)
    rim, reach = math.hypot(L * math.cos(short), 4.0), L - (L * math.sin(short) - 8.0)
    raised = reach + 0.2 * (rim - reach)
    assert sorted({round(one, 6) for one in about_axis}) == [
        pytest.approx(one, abs=1e-6) for one in (raised, rim)
    ]


@pytest.mark.sampled(5)
@pytest.mark.parametrize(
    ("wheel", "passed"),
    [
        (External(3, steps_deg=(131.9, 84.5, 143.6)), {2}),
        (External(4, steps_deg=(48.3, 131.7)), {1}),
        (External(8, steps_deg=(63.4, 26.6)), set()),
        (External(6, offset_mm=12.0), set()),
        (External(24), {0}),  # many horns, which come deep into the disc
    ],
)
def test_a_relief_is_as_wide_as_the_wheel_reaches(wheel, passed):
    """All points of the wheel's outline, turned in steps of 0.002 degrees of the crank.

    In a step the wheel turns up to 20 times as far, by 0.04 degrees. A horn reaches farthest where
    it leaves the disc, so that its last point inside comes less far by about half of that.
    """
    parts = drawn(*machine_sizes(Design(wheel, size=Size(100.0, 4.0)).mechanism))
    assembly, sizes = parts.assembly, parts.sizes
    mouths = mouth_corners(assembly, sizes.roller, sizes.recess, sizes.rim)
    wide = {one.motion: one for one in widened(assembly, sizes, mouths)}
    for one in reliefs(assembly):
        middle = 0.5 * (one.start + one.end)
        x, y = parts.gaps.swept(one.motion, 0.002)
        off = np.abs(np.remainder(np.arctan2(y, x) - middle + math.pi, math.tau) - math.pi).max()
        assert (off > one.half + 1e-6) == (one.motion in passed)
        reach = off + sizes.relief / sizes.lock if one.motion in passed else one.half
        assert wide[one.motion].half == pytest.approx(reach, abs=math.radians(0.02))
    cut = [arc.sweep for arc in cut_arcs(parts.crank, sizes.lock, 0.0, 1e-6)]
    assert lock_of(assembly, sizes).half == pytest.approx(0.5 * min(map(abs, cut)), rel=1e-12)


def test_half_of_a_symmetric_motion_shows_where_the_wheel_reaches():
    """Each point that the wheel reaches in the whole motion, or its mirror image, is in the half.

    The crank's only roller is at direction 0 at mid-motion, so that x is the axis of the mirror.
    """
    gaps = drawn(*machine_sizes(Design(Internal(5), size=Size(100.0, 10.0)).mechanism)).gaps
    x, y = gaps.swept(0, 1.0)
    whole = copy.copy(gaps)
    whole.pitch = 0.0  # as of a wheel whose slots differ
    every_x, every_y = whole.swept(0, 1.0)
    assert 1.9 * len(x) < len(every_x) < 2.0 * len(x)
    half = KDTree(np.column_stack((x, np.abs(y))))
    away, _ = half.query(np.column_stack((every_x, np.abs(every_y))))
    assert away.max() < 1e-10  # rounding of angles, times 100 mm


@pytest.mark.parametrize("direction", [0.0, 2.0])
@pytest.mark.parametrize(
    ("keys", "far", "text"),
    [
        # DIN 6885-1: a bore of 20 mm has a keyway 2.8 mm above its circle
        ({"crank_keyway": "DIN 6885-1"}, 12.8, "keyway 6 JS9, 22.8 over bore (DIN 6885-1)"),
        # a flat 2 mm below the circle, which is 18 mm from the far side
        ({"crank_bore": "D", "crank_flat_mm": 2.0}, 8.0, "flat, 18 to the far side"),
        ({"crank_bore": "hex"}, 10.0, "hexagon 20 across flats"),
    ],
)
def test_the_leader_of_a_bore_points_at_the_middle_of_its_shape(keys, far, text, direction):
    """The keyway's top, the flat, or a side: its middle lies in the bore's direction."""
    size, view = Size(crank_bore_mm=20.0, **keys), View("", 0.5)
    bored(view, [bore_of(size, "crank", 10.0).shape("BORE", direction)], size, "crank")
    (leader,) = [one for one in view.measures if one.kind == "note"]
    assert leader.label.text == text
    middle = far * math.cos(direction), far * math.sin(direction)
    assert leader.points == (pytest.approx([0.5 * x for x in middle], abs=1e-12),)
    angle = {0.0: "0", 2.0: "114.59"}[direction]
    first = text.split()[0].rstrip(",")
    assert view.notes == [f"{first} at {angle}°, counterclockwise from the right"]
