"""``geneva vibration`` as a user meets it: its record, its spectrum, and what it refuses."""

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
UNLOADED = str(repo.DESIGNS / "side-crank-z6.toml")
NAMES = [
    *("spec", "title", "period_ratio", "damping_ratio", "natural_Hz", "residual_share"),
    *("residual_deg", "dynamic_factor", "windup_deg", "speeds_to_avoid_rpm", "avoid", "stations"),
    "warnings",
]


def run(*words):
    return CliRunner().invoke(app, ["vibration", *words])


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
    assert unknown in ([], ["stations"])
    assert not found["warnings"]


def test_a_motion_shorter_than_a_natural_period_is_said():
    found = record(PRESS, "--period-ratio", "0.5", "--damping", "0.1")
    assert "too few to follow" in found["warnings"][0]


REFUSED = {
    PRESS: "no stiffness_Nm_rad in [shaft]: set the stiffness",
    RACK: f"{RACK}:8: a rack has no shaft: use --period-ratio",
    f"{PRESS} --period-ratio 3 --damping 1": "--damping 1: must be at least 0, below",
    f"{PRESS} --period-ratio nan": "--period-ratio nan: must be",
    f"{PRESS} --set shaft.stiffness_Nm_rad=1e12 --set load.inertia_kgm2=1e-9": "gives a period",
    f"{PRESS} --period-ratio 3 --format csv --samples 1": "--samples 1: must",
    f"{UNLOADED} --set shaft.stiffness_Nm_rad=100 --format csv": "a load without inertia has no",
}


@pytest.mark.parametrize("line", REFUSED)
def test_what_is_refused(line):
    result = run(*line.split())
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
