"""Rows of synth turned, and what fails seen early."""

import pytest

import geneva_cli
from geneva_cli.drives.crank import Crank
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.external import External
from geneva_cli.study.synth.suiting import USUAL, with_roller
from geneva_cli.study.synth.synth_table import built
from geneva_cli.verdict.checks import checks

MENDED = [  # what is found to fail with the usual roller, and the roller that mends it, mm
    (lambda: geneva_cli.GearSector(sector_deg=33.0), External(21), "rollers_apart_mm", 3.0),
    (lambda: Crank(rollers=2), External(21, offset_mm=10.0), "gap_mm", 3.0),
]


@pytest.mark.long
@pytest.mark.parametrize("drive, wheel, name, radius", MENDED, ids=["gear-sector", "two rollers"])
def test_the_first_roller_that_passes_every_check_is_taken(drive, wheel, name, radius):
    """As trying one after the other has it, with all their checks."""
    spec = Spec(wheel, drive())
    assert name in [c.name for c in checks(build(spec)) if c.passes is False]
    L = build(spec).center_distance_mm
    sized = (with_roller(spec, 0.01 * percent * L) for percent in USUAL)
    first = next(s for s in sized if all(c.passes is not False for c in checks(build(s))))
    assert built(spec) == (first, "")
    assert first.size.roller_radius_mm == radius
