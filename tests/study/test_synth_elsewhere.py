"""Families whose best machine's parts cannot be built: the best of those that can, in its range."""

import itertools

import pytest
from sampling import some
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.design import load
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.motion import Motion
from geneva_cli.study.synth.machine_rows import rows
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search
from geneva_cli.study.synth.synth_table import turned
from geneva_cli.verdict.checks import checks

pytestmark = pytest.mark.usefixtures("few_four_bars")
CURVED = {"external": True, "rollers": 1}


def curved(found):
    """The rows with curved slots, the gentlest first."""
    return [row for row in found.rows if row.cells["law"] and row.cells["drive"] == "crank"]


@pytest.mark.long
@pytest.mark.parametrize("z", [6, 8, 11])
def test_beside_a_row_that_cannot_be_built_is_the_best_that_may_be(z):
    """No motion of a dense sweep between the two has parts that may be built."""
    target = read_target(motion_deg="100..200", z=str(z), **CURVED)
    first, other, *_ = curved(search(target))
    assert first.cells["parts"] == "no: island"
    assert first.cells["motion_deg"] == pytest.approx(200.0)
    assert other.cells["parts"] == "maybe"
    # a 4096th of the range is how near the search goes
    found = other.cells["motion_deg"] + 100.0 / 4096.0
    natural, steps = 180.0 - 360.0 / z, some(300, 60)
    for k in range(steps + 1):
        alpha0 = natural - (found + (200.0 - found) * k / steps)
        spec = other.spec.replace(motion=Motion(ModifiedSine(), alpha0_deg=alpha0, ratio="matched"))
        spec = spec.with_("size.roller_radius_mm", None)
        (row,) = rows(target, [(spec, None)], [])
        assert row.trouble, alpha0


@pytest.mark.long
def test_a_row_that_fails_in_its_turn_gives_way_to_the_best_that_passes(tmp_path):
    """Of two rollers too; under their numbers, the lowest peak first, and written as shown."""
    words = [
        "synth",
        "--motion-deg",
        "100..160",
        "--z",
        "8",
        "--external",
        "--law",
        "modified-sine",
    ]
    target = read_target(motion_deg="100..160", z="8", external=True)
    found = search(target)
    plain = {row.cells["no"]: row for row in turned(found)}
    shown = turned(found, buildable=True)
    peaks = [row.cells["acceleration_max"] for row in shown]
    assert all(b >= a * (1.0 - 1e-11) for a, b in itertools.pairwise(peaks))  # equal in 12 digits
    assert len({row.cells["no"] for row in shown}) == len(shown)
    assert [found.rank(row) for row in found.rows] == sorted(map(found.rank, found.rows))
    moved = [row for row in shown if not row.trouble and plain[row.cells["no"]].trouble]
    assert {row.cells["rollers"] for row in moved} == {1, 2}
    for row in moved:
        wished = found.rows[row.cells["no"] - 1].cells
        assert wished["motion_deg"] == pytest.approx(160.0)
        # between the gentlest and the plain crank's own motion, which is a row of its own
        assert 135.0 < row.cells["motion_deg"] < wished["motion_deg"]
        assert not [c for c in checks(build(row.spec)) if c.passes is False]
    file, row, no = tmp_path / "spec.toml", moved[0], str(moved[0].cells["no"])
    run = CliRunner().invoke(app, [*words, "--buildable", "--write", no, "-o", str(file)])
    assert run.exit_code == 0
    assert "warning: its parts" not in run.stderr
    design = load(str(file))
    assert design.spec.motion == row.spec.motion
    assert design.spec.size == row.spec.size
    assert not [c for c in design.checks if c.passes is False]
