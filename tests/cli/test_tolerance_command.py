"""``geneva tolerance`` as it is called: its formats, its bytes, what it refuses."""

import json

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli.cli.app import app

pytestmark = pytest.mark.usefixtures("made_once")
DESIGN = str(repo.DESIGNS / "tolerances.toml")


def run(*arguments):
    return CliRunner().invoke(app, ["tolerance", *arguments])


@pytest.mark.long
def test_the_design_of_the_folder_turns_within_its_tolerances():
    words = [DESIGN, "--samples", "4096", "--radius", "150", "--format", "json"]
    found = run(*words)
    assert run(*words).stdout == found.stdout  # the same seed
    told = json.loads(found.stdout)
    assert list(told)[:2] == ["spec", "title"]
    for name in ("dwell_position", "motion_play"):
        one = told[name]
        assert one["mean_deg"] < one["p997_deg"] < one["rss_deg"] * 1.1 < one["worst_deg"]
        assert one["worst_arcsec"] == pytest.approx(3600.0 * one["worst_deg"], rel=1e-15)
        # 1 degree at 150 mm is 2617.99 um
        assert one["worst_um"] == pytest.approx(2617.993877991494 * one["worst_deg"], rel=1e-14)
    assert {row["dimension"] for row in told["contributions"]} >= {"slot_angle_deg"}
    assert set(told["entry_jump"]) >= {"mean", "std"}
    assert told["clearances"]["turns"] is True
    assert told["warnings"] == []
    assert found.exit_code == 0


@pytest.mark.parametrize(
    "options, words",
    [
        (["--samples", "0"], "--samples 0: it must be from 1 to 10000000"),
        (["--samples", "1000000000000"], "it must be from 1 to 10000000"),
        (["--seed", "-4"], "--seed -4: it must be 0 or more"),
        (["--radius", "inf"], "--radius inf: must be above 0"),
        (["--set", "tolerance.slot_width_mm=-1"], "slot_width_mm = -1"),
        (["--set", "tolerance.slot_width_mm=40"], "below 20.09, the slot's width"),
        (["--set", "size.lock_radius_mm=0"], "this machine has no locking disc; remove it"),
    ],
)
def test_bad_input(options, words):
    found = run(DESIGN, *options)
    assert found.exit_code == 2
    assert words in found.stderr
    assert found.stdout == ""
