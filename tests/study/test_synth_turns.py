"""Rows of synth turned, and what fails seen early."""

import numpy as np
import pytest

import geneva_cli
from geneva_cli.drives.crank import Crank
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.external import External
from geneva_cli.parts.parts import parts_of
from geneva_cli.study.synth.built import built
from geneva_cli.study.synth.fast_parts import USUAL, exact, with_roller
from geneva_cli.study.synth.parts_data import distances_at_rest, parts_data
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search
from geneva_cli.verdict.checks import checks


@pytest.fixture(scope="module")
def four_bar():
    """A four-bar, whose roller comes past the wheel at rest."""
    rows = search(read_target(motion_deg="180", z="6", external=True, rollers=1)).rows
    (spec,) = [row.spec for row in rows if row.candidate.drive == "four-bar"]
    return spec


@pytest.mark.sampled(3)
@pytest.mark.parametrize("share", [0.05, 0.03, 0.02])
def test_the_gap_of_a_wheel_at_rest(four_bar, share):
    """Against the drawn wheel, at the same places of the roller."""
    L = build(four_bar).center_distance_mm
    parts = parts_of(build(with_roller(four_bar, share * L)))
    (engagement,) = parts.assembly.kinds
    rest = engagement.exit_deg + (360.0 - engagement.motion_deg) * np.arange(720) / 720
    at = parts.assembly.start_deg + (rest - parts.assembly.start_deg) % 360.0
    drawn = parts.gaps.rollers(parts.gaps.pose(at)).min()
    sizes = parts.sizes
    back = parts_data(four_bar).back
    seen = distances_at_rest(*back, sizes.rim, sizes.half_width).min() - sizes.roller
    assert seen == pytest.approx(drawn, abs=1e-9 * L)


MENDED = [  # what is found to fail with the usual roller, and the roller that mends it, mm
    (lambda: geneva_cli.GearSector(sector_deg=33.0), External(21), "rollers_apart_mm", 3.0),
    (lambda: Crank(rollers=2), External(21, offset_mm=10.0), "gap_mm", 3.0),
]


@pytest.mark.long
@pytest.mark.sampled(2)
@pytest.mark.parametrize("drive, wheel, name, radius", MENDED, ids=["gear-sector", "two rollers"])
def test_the_first_roller_that_passes_every_check_is_taken(drive, wheel, name, radius):
    """As trying one after the other has it, with all their checks."""
    spec = Spec(wheel, drive())
    assert name in [c.name for c in checks(build(spec)) if c.passes is False]
    L = build(spec).center_distance_mm
    sized = (with_roller(spec, exact(0.01 * percent * L)) for percent in USUAL)
    first = next(s for s in sized if all(c.passes is not False for c in checks(build(s))))
    assert built(spec) == (first, "")
    assert first.size.roller_radius_mm == radius
