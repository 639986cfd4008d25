"""Parts whose sizes a designer works out on paper, from the keys of a spec alone.

The parts are compared with their hand calculation, and the sheet's dimensions with the same one.
"""

import math

import numpy as np
import pytest
from words import Drive, Keys, Spec, Wheel

from geneva_cli import Design, External
from geneva_cli.drawings.sheet.crank_views import draw_arm, draw_disc, draw_link
from geneva_cli.drawings.sheet.sized import Fits
from geneva_cli.drawings.sheet.view import View
from geneva_cli.drawings.sheet.wheel_views import draw_wheel
from geneva_cli.geometry.plates import plates
from geneva_cli.geometry.shapes import Arc
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.crank_outline import arc_floor, reliefs, widened
from geneva_cli.parts.outlines.cut_outlines import cut_arcs, cut_lock, drawn, horn_corners
from geneva_cli.parts.shafts.arm_and_shafts import crank_arm
from geneva_cli.spec.tables import Size

L = 100.0


def of(**size):
    return Design.of(Spec(Wheel(6), size=Size(center_distance_mm=L, roller_radius_mm=6.0, **size)))


def dimensions(draw, *shown):
    """The texts of the dimensions in one view of a sheet, at 1:1."""
    of_machine = getattr(shown[0], "mechanism", shown[-1])
    view = View("", 1.0, Fits(of_machine.spec))
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
    assert dimensions(draw_arm, design.parts, arm) == on_sheet


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


@pytest.mark.long
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
    mouths = horn_corners(assembly, sizes)
    wide = {motion: end - start for start, end, motion in widened(assembly, sizes, mouths)}
    for start, end, motion in reliefs(assembly):
        middle, half = 0.5 * (start + end), 0.5 * (end - start)
        x, y = parts.gaps.swept(motion, 0.002)
        off = np.abs(np.remainder(np.arctan2(y, x) - middle + math.pi, math.tau) - math.pi).max()
        assert (off > half + 1e-6) == (motion in passed)
        reach = off + sizes.relief / sizes.lock if motion in passed else half
        assert 0.5 * wide[motion] == pytest.approx(reach, abs=math.radians(0.02))
    cut = [arc.sweep for arc in cut_arcs(parts.crank, sizes.lock, 0.0, 1e-6)]
    assert cut_lock(assembly, sizes).half == pytest.approx(0.5 * min(map(abs, cut)), rel=1e-12)
