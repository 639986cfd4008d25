"""Parts of a rack, by hand."""

import math

import pytest
from test_parts_by_hand import dimensions

from geneva_cli import Design, Linear
from geneva_cli.drawings.sheet.crank_views import draw_arm
from geneva_cli.geometry.measure import bounds
from geneva_cli.kinds.linear.frame import guide
from geneva_cli.kinds.linear.rack import crank_arm as rack_arm
from geneva_cli.spec.tables import Size


def test_the_bolts_of_a_racks_arm_are_amid_its_locking_sector():
    """R = 50, r = 6: the sector reaches from R - rho + R/200 to rho = R - 2 r.

    It lies over half a turn opposite the roller, so the bolts are at 135° and 225°. A hole of up to
    2 R/40 = 2.5 mm is one of 2.4 mm for M2, whose pitch is 0.4 mm.
    """

    design = Design(Linear(6), size=Size(center_distance_mm=50.0, roller_radius_mm=6.0))
    far = 0.5 * (50.0 - 38.0 + 0.25 + 38.0)
    arm, at = rack_arm(design.mechanism), far * math.sqrt(0.5)
    holes = [(*bolt.centre, bolt.radius) for bolt in arm.bolts]
    assert holes == [pytest.approx((-at, at, 0.8)), pytest.approx((-at, -at, 0.8))]
    on_sheet = {"50", "Ø 6 P7 (-0.008/-0.02)", "R 38", "R 6", "Ø 10 H7 (+0.015/0)"}
    on_sheet.add(f"2× Ø 1.6, tapped M2 on Ø {2.0 * far:g}")
    assert dimensions(draw_arm, design.mechanism, arm) == on_sheet


def test_screws_are_amid_the_guides_bars():
    """R = 50, half a slot 6.1: bars of R/10, whose screws are half a bar from their ends."""

    keys = {"roller_radius_mm": 6.0, "slot_clearance_mm": 0.1}
    design = Design(Linear(6), size=Size(center_distance_mm=50.0, **keys))
    for bar in guide(design.mechanism)[:2]:
        box = bounds(bar.outline)
        middle, far = 0.5 * (box.x0 + box.x1), 50.0 - 6.1 - 2.5
        places = [pytest.approx((middle, y)) for y in (-far, 0.0, far)]
        assert [one.centre for one in bar.holes] == places
