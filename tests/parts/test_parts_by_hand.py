"""Parts whose sizes a designer works out on paper, from the keys of a spec alone.

The parts are compared with their hand calculation, and the sheet's dimensions with the same one.
"""

import math

import pytest
import repo
from drawing_witness import vertices
from words import Drive, Keys, Motion, Spec, Wheel

from geneva_cli import Counter, Design, External, Linear, load
from geneva_cli.curves.measure import bounds
from geneva_cli.curves.moments import moments
from geneva_cli.curves.plates import plates, solids
from geneva_cli.curves.shapes import Arc
from geneva_cli.curves.sheet import CENTRE, OUTLINE
from geneva_cli.drawings.sheet.crank import draw_arm, draw_disc, draw_roller
from geneva_cli.drawings.sheet.links import draw_link
from geneva_cli.drawings.sheet.standing import draw_frame
from geneva_cli.drawings.sheet.view import View
from geneva_cli.layout.bores import bore_of
from geneva_cli.parts.arm import crank_arm
from geneva_cli.parts.counter_parts import CounterParts
from geneva_cli.parts.links import drawn_links
from geneva_cli.parts.planes import planes
from geneva_cli.parts.rack_arm import crank_arm as rack_arm
from geneva_cli.parts.rack_frame import guide
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


def test_the_arm_is_drawn_whole_with_its_centre_lines():
    """They are as much longer than the hub as than the eye, and all that is cut is a full line."""
    design, view = of(**ARM, crank_bore_mm=12.0), View("", 1.0)
    draw_arm(view, design.mechanism, crank_arm(design.parts))
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
    # from the first screw to the slot, and from end to end of the slot and of the screws
    on_sheet = {"18", "90.5", "126.5", "16 H7 (+0.018/0)", "4× R 13", "2× R 10"}
    on_sheet.add("2× Ø 10 H7 (+0.015/0)")
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
    """A pin in links is thinner than its hole by ``shaft_fit_mm``, and a roller's bore wider."""
    size = Size(L, 4.0, pin_mm=4.0, shaft_fit_mm=0.2)
    plain, cam = (
        Design.of(Spec(Wheel(6), drive, motion=motion, size=size))
        for drive, motion in ((Drive(), None), (Drive("cam"), Motion("cycloidal")))
    )
    shown = {"Ø 8 g6 (-0.005/-0.014)", "Ø 4.2 H7 (+0.012/0)"}
    assert dimensions(draw_roller, plain.mechanism) == shown
    bores = [one for one in plates(plain.drawing("crank").solid) if one.name == "roller"]
    links = drawn_links(cam.mechanism, cam.parts)
    bores += [one.part for one in links.joined if one.part.name == "roller in the groove"]
    assert [hole.radius for one in bores for hole in one.holes] == [2.1, 2.1]
    keys = Keys("slider-crank", 40.0, 100.0, 80.0, 90.0)
    size = Size(roller_radius_mm=6.0, link_pin_mm=10.0, shaft_fit_mm=0.2)
    sliding = Design.of(Spec(Wheel(8), Drive("slider-crank"), keys, size=size))
    joined = drawn_links(sliding.mechanism, sliding.parts).joined
    assert {one.part.outline.radius for one in joined if one.part.name.startswith("pin")} == {4.9}


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
    """The rim is 1.5 rollers wide, with four screws at 45°, each half as wide as the rim."""
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
    assert {one.radius for one in screws} == {1.5}
    assert (base.low, base.high, ring.high) == (-30.0, -20.0, -10.0)


def test_a_counters_heights():
    """Gears of 10 mm and gaps of 0.5 mm: a pinion's wide teeth lie beside the driver's rim."""
    size = Size(center_distance_mm=L, wheel_thickness_mm=10.0, pin_gap_mm=0.5)
    parts = CounterParts(Design(Counter(4, driver_teeth=20), size=size).mechanism, 0.1)
    pinion, wheel, driver = (
        [(one.low, one.high) for one in plates(member.part)]
        for member in (*parts.pinions, *parts.number_wheels, parts.driver)
    )
    assert pinion == [(0.0, 20.5), (20.5, 31.0)]
    assert wheel == [(0.0, 10.0)]
    assert driver == [(10.5, 21.0), (21.0, 31.0)]


def test_screws_are_amid_the_guides_bars():
    """R = 50, half a slot 6.1: bars of R/10, whose screws are half a bar from their ends."""
    keys = {"roller_radius_mm": 6.0, "slot_clearance_mm": 0.1}
    design = Design(Linear(6), size=Size(center_distance_mm=50.0, **keys))
    for bar in guide(design.mechanism)[:2]:
        box = bounds(bar.outline)
        middle, far = 0.5 * (box.x0 + box.x1), 50.0 - 6.1 - 2.5
        places = [pytest.approx((middle, y)) for y in (-far, 0.0, far)]
        assert [one.centre for one in bar.holes] == places


def test_a_fixed_gear_is_screwed_to_the_frame_below_the_hub():
    """Three screws, from 45° on; a hub of 60 mm lowers the frame, so rings stand between both.

    The planet of 19.5 mm rolls about the gear of 58.5 mm, and so past the hub of 20 mm.
    """
    sizes = {"wheel_hub_mm": 40, "wheel_hub_length_mm": 60, "gear_bolts": 3}
    sizes |= {"gear_bolt_circle_mm": 66, "gear_bolt_mm": 4}
    own = [f"size.{key}={value}" for key, value in sizes.items()]
    design = load(str(repo.DESIGNS / "epicyclic-soft-z6.toml"), own)
    parts = design.parts_model.flat
    turns = [math.radians(45.0 + 120.0 * k) for k in range(3)]
    screws = [(160.0 + 33.0 * math.cos(turn), 33.0 * math.sin(turn)) for turn in turns]
    assert [ring.at for ring in parts.spacers] == [pytest.approx(at) for at in screws]
    held = [hole.centre for hole in parts.frame.part.holes if hole.radius == 2.0]
    assert held == [pytest.approx(at) for at in screws]
    for ring in (one.part for one in parts.spacers):
        (bore,) = ring.holes
        assert (ring.outline.radius, bore.radius) == (4.0, 2.0)
        assert (ring.low, ring.high) == (parts.frame.part.high, -48.0) == (-60.0, -48.0)
    gap = planes(design.parts, parts.links).nearest
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
    lock, rim = 50.0 - 6.0 - 6.0, math.hypot(50.0 * math.sqrt(3.0), 6.0)
    shown = {"120°", "Ø 76 g6 (-0.01/-0.029)", "Ø 8 H7 (+0.015/0)"}
    radius, away = lock * math.sqrt(3.0), 2.0 * lock
    reliefs = {
        "arc": {f"R {radius:.3f}", f"{away - radius:.3f}"},
        "sector": {f"R {L - rim - 0.5:.3f}".rstrip("0")},
    }
    for relief, own in reliefs.items():
        parts = of(relief=relief, crank_bore_mm=8.0, lock_bolts=0).parts_model.flat
        assert dimensions(draw_disc, parts) == shown | own


def test_a_frame_leaves_three_corners_about_its_holes():
    """Corners of L/20 have screws of 0.8 of that; their centres are three corners beyond the holes.

    The shafts of 16 and 8 mm are at 0 and L: the frame is L + 8 + 4 + 8 (L/20) long.
    """
    parts = of(wheel_bore_mm=16.0, crank_bore_mm=8.0).parts_model.flat
    shown = {f"{L + 12.0 + 40.0:g}", "56", "28", "100", "23", "119", "4× R 5"}
    shown |= {"Ø 16 H7 (+0.018/0)", "Ø 8 H7 (+0.015/0)", "4× Ø 4 H7 (+0.012/0)"}
    assert dimensions(draw_frame, parts.frame.part) == shown


def test_a_low_mouth_is_raised_by_a_fifth():
    """Steps of 90° and 30° have two cranks' radii, L sin 45° and L sin 15°, and two rims.

    The recess is that of the shorter arm, less a roller and a horn. It ends L - rho from the
    wheel's axis, and the lower mouths are raised to a fifth of the way from there to the rim.
    """
    spec = Spec(Wheel(6, steps_deg=(90.0, 30.0)), size=Size(L, 4.0, wheel_bore_mm=6.0))
    arcs = [one for one in Design.of(spec).parts.wheel.segments if isinstance(one, Arc)]
    about_axis = {one.radius for one in arcs if math.hypot(*one.centre) < 1e-9}
    short = math.radians(15.0)
    rim, reach = math.hypot(L * math.cos(short), 4.0), L - (L * math.sin(short) - 8.0)
    raised = reach + 0.2 * (rim - reach)
    assert sorted({round(one, 6) for one in about_axis}) == [
        pytest.approx(one, abs=1e-6) for one in (raised, rim)
    ]
