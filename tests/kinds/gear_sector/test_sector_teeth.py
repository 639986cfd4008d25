"""Teeth of gear sectors, turned as crank and wheel turn."""

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate, translate
from test_gear_teeth import gears

from geneva_cli import Design, External, GearSector
from geneva_cli.errors import GenevaError
from geneva_cli.parts.assembly import assembly
from geneva_cli.spec.tables import Size


@pytest.mark.sampled(12)
@pytest.mark.parametrize("backlash", [0.0, 0.1])
@pytest.mark.parametrize(
    ("z", "sector", "module"),
    [
        (3, 60.0, 2.0),
        (4, 150.0, 2.0),
        (8, 4.0, 1.0),
        (3, 60.0, 5.0),
        (3, 67.0, 4.0),
        (6, 20.0, 3.0),
    ],
)
def test_sectors_drive_the_whole_arc_and_are_free_beyond(z, sector, module, backlash):
    """Turned as crank and wheel turn: in contact while gears drive, and no overlap at any time."""
    drive = GearSector(sector_deg=sector)
    design, ((crank, on_crank), (wheel, _)) = gears(
        drive, z, gear_module_mm=module, gear_backlash_mm=backlash
    )
    where, half = assembly(design.mechanism), 0.5 * sector
    near = shapely.box(on_crank.at[0] - on_crank.cut.teeth.tip, -60.0, 70.0 + on_crank.at[0], 60.0)
    assert on_crank.cut.last_tip <= on_crank.cut.teeth.tip
    gaps = {}
    inner = np.linspace(-half + 0.01, half - 0.01, 41)
    for x in (*inner, *np.linspace(half, half + 40.0, 60), *np.linspace(-half - 40.0, -half, 60)):
        turns = [
            float((angle(np.array([x])) - angle(np.zeros(1)))[0])
            for angle in (where.crank, where.wheel)
        ]
        one = translate(rotate(crank, turns[0], (0.0, 0.0), use_radians=True), *on_crank.at)
        other = rotate(wheel, turns[1], (0.0, 0.0), use_radians=True).intersection(near)
        assert one.intersection(other).area < 1e-6
        gaps[x] = one.distance(other)
    # chords of the outlines' arcs lie below them by up to 1e-4 mm
    assert max(gaps[x] for x in inner) < 3e-4
    assert not gaps[half + 40.0] < 1e-3  # NaN: no tooth is near


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"gear_module_mm": 2.0, "gear_teeth": 9}, "on sectors"),
        # a gear of 100 mm has 1000 teeth at 0.1 mm, to rounding
        ({"gear_module_mm": 0.01}, "gear_module_mm = 0.1.* is large"),
        ({"gear_module_mm": 1.0, "gear_shift": -0.9}, "more than 0.86 modules; remove gear_shift"),
        ({"gear_module_mm": 1.0, "gear_backlash_mm": 9.0}, "pointed; reduce gear_backlash_mm"),
        ({"arm_bore_mm": 70.0}, "crank gear.*hub reaches .*smaller crank_bore_mm or arm_bore_mm"),
        ({"link_bore_mm": 7.0}, "it applies to no link"),
    ],
)
def test_refusals(keys, said):
    sector = GearSector(sector_deg=60.0)
    with pytest.raises(GenevaError, match=said) as error:
        Design(External(3), sector, size=Size(**keys)).drawing("gears")
    assert error.value.key[0] == "size"
