"""``geneva vibration`` and ``geneva tolerance`` as a user meets them, and what they refuse."""

import csv
import io
import json

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli import load
from geneva_cli.cli.app import app

PRESS = str(repo.DESIGNS / "press-straight.toml")
RACK = str(repo.DESIGNS / "linear.toml")
DESIGN = str(repo.DESIGNS / "tolerances.toml")
UNLOADED = str(repo.DESIGNS / "side-crank-z6.toml")
NAMES = [
    *("spec", "title", "period_ratio", "damping_ratio", "natural_Hz", "residual_share"),
    *("residual_deg", "dynamic_factor", "windup_deg", "speeds_to_avoid_rpm", "avoid"),
    "warnings",
]


def run(*words, command="vibration"):
    return CliRunner().invoke(app, [command, *words])


def record(*words):
    result = run(*words, "--format", "json")
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("path", sorted(repo.DESIGNS.glob("*.toml")), ids=lambda p: p.stem)
def test_the_names_are_the_same_for_every_machine(path):
    found = record(str(path), "--period-ratio", "3.7", "--damping", "0.01")
    assert list(found) == NAMES
    spec = load(str(path)).spec
    lacks = spec.output.lacks  # a rack has no angle
    unknown = [name for name in NAMES if found[name] is None and name not in lacks]
    assert not unknown
    assert not found["warnings"]


def test_a_motion_shorter_than_a_natural_period_is_said():
    found = record(PRESS, "--period-ratio", "0.5", "--damping", "0.1")
    assert "too few to follow" in found["warnings"][0]


PATHS = {"PRESS": PRESS, "RACK": RACK, "UNLOADED": UNLOADED}
REFUSED = {
    "PRESS": "no natural period: set stiffness_Nm_rad in [shaft]",
    "RACK": f"{RACK}:8: a rack has no shaft: use --period-ratio",
    "PRESS --period-ratio 3 --damping 1": "--damping 1: must be at least 0, below",
    "PRESS --period-ratio nan": "of nan: must be 1e-06 to",
    "PRESS --set shaft.stiffness_Nm_rad=1e12 --set load.inertia_kgm2=1e-9": "a period ratio",
    "PRESS --period-ratio 3 --format csv --samples 1": "--samples 1: must",
    "UNLOADED --set shaft.stiffness_Nm_rad=100 --format csv": "no natural period: set",
}


@pytest.mark.parametrize("line", REFUSED)
def test_what_is_refused(line):
    result = run(*(PATHS.get(word, word) for word in line.split()))
    assert result.exit_code == 2
    assert REFUSED[line] in result.stderr
    assert result.stdout == ""


def test_csv_is_the_spectrum(tmp_path):
    file = tmp_path / "spectrum.csv"
    words = ("--period-ratio", "6", "--damping", "0.02", "--samples", "5")
    assert run(PRESS, *words, "-o", str(file)).exit_code == 0
    text = file.read_text(encoding="utf-8")
    assert run(PRESS, *words, "--format", "csv").stdout == text
    rows = list(csv.DictReader(io.StringIO(text)))
    assert list(rows[0]) == ["n_rpm", "period_ratio", "residual_share", "residual_deg"]
    # the middle row is the design's own speed, where the record is
    found = record(PRESS, "--period-ratio", "6", "--damping", "0.02")
    for name in rows[0].keys() - {"n_rpm"}:
        assert float(rows[2][name]) == pytest.approx(found[name], rel=1e-12)
    assert float(rows[2]["n_rpm"]) == pytest.approx(60.0)


@pytest.mark.long
def test_the_design_of_the_folder_turns_within_its_tolerances():
    words = [DESIGN, "--samples", "4096", "--radius", "150", "--format", "json"]
    found = run(*words, command="tolerance")
    assert run(*words, command="tolerance").stdout == found.stdout  # the same seed
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
@pytest.mark.usefixtures("made_once")
def test_bad_input(options, words):
    found = run(DESIGN, *options, command="tolerance")
    assert found.exit_code == 2
    assert words in found.stderr
    assert found.stdout == ""
