"""Parts of the machines that a search finds: which rollers suit, what fails early or in a turn."""

import pytest
from sampling import some
from typer.testing import CliRunner

from geneva_cli import GearSector
from geneva_cli.cli.app import app
from geneva_cli.drives.crank import Crank
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.external import External
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.suiting import USUAL, with_roller
from geneva_cli.study.synth.synth_search import rows, search
from geneva_cli.study.synth.synth_table import built
from geneva_cli.verdict.checks import checks

pytestmark = pytest.mark.usefixtures("few_four_bars")
CURVED = {"external": True, "rollers": 1}


def curved(found):
    """The rows with curved slots, the gentlest first."""
    return [row for row in found.rows if row.cells["law"] and row.cells["drive"] == "crank"]


@pytest.mark.long
@pytest.mark.parametrize("z", [6, 8, 11])
def test_the_longest_motion_is_the_longest_that_may_be_built(z):
    """No longer motion of a dense sweep has parts that may be built."""
    target = read_target(motion_deg="100..200", z=str(z), **CURVED)
    other = curved(search(target))[0]
    assert other.cells["parts"] == "maybe"
    assert other.cells["motion_deg"] < 199.0
    # a 1024th of the range is how near the search goes
    found = other.cells["motion_deg"] + 100.0 / 1024.0
    natural, steps = 180.0 - 360.0 / z, some(300, 60)
    for k in range(steps + 1):
        alpha0 = natural - (found + (200.0 - found) * k / steps)
        spec = other.spec.replace(motion=Motion(ModifiedSine(), alpha0_deg=alpha0, ratio="matched"))
        spec = spec.with_("size.roller_radius_mm", None)
        (row,) = rows(target, [spec], [])
        assert row.trouble, alpha0


MENDED = [  # what is found to fail with the usual roller, and the roller that mends it, mm
    (lambda: GearSector(sector_deg=33.0), External(21), "rollers_apart_mm", 3.0),
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


DIAL = """[wheel]
z = 8
[drive]
n_rpm = 40
[load]
inertia_kgm2 = 0.8
torque_Nm = 12
"""


def listed(tmp_path, *options):
    spec = tmp_path / "dial.toml"
    spec.write_text(DIAL)
    wanted = ["--from", str(spec), "--dwell-s", "1.2..", "--rollers", "1", "--external"]
    said = CliRunner().invoke(app, ["synth", *wanted, *options, "--format", "csv"])
    assert said.exit_code == 0
    head, *lines = [line.split(",") for line in said.stdout.splitlines()]
    places = [head.index(name) for name in ("drive", "law", "parts")]
    return [tuple(line[i] for i in places) for line in lines]


@pytest.mark.long
def test_a_search_marks_a_machine_that_is_not_driven(tmp_path):
    """The curved slots of a modified sine over 72 degrees drive during 15.7 % of the motion."""
    found = listed(tmp_path, "--check", "5")
    assert ("crank", "modified-sine", "no: driven_fraction") in found
    assert ("cam", "modified-sine", "yes") in found  # straight slots drive any law


@pytest.mark.long
def test_buildable_rows_are_driven(tmp_path):
    found = listed(tmp_path, "--buildable", "--check", "1")
    assert found == [("cam", "modified-sine", "yes")]
