"""Figures of sweeps, fronts and spectra from their CSV files, and what `geneva plot` refuses."""

import json
import os

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.figure import JOINED
from geneva_cli.study.figures import of_table

SPEC = str(repo.DESIGNS / "side-crank-z6.toml")


def run(*arguments):
    return CliRunner().invoke(app, list(map(str, arguments)))


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def put(text):
    with open("rows.csv", "w", encoding="utf-8", newline="") as file:
        file.write(text)
    return "rows.csv"


def sweep(*options):
    found = run("sweep", SPEC, *options, "-o", "rows.csv", "--jobs", "1")
    assert found.exit_code == 0, found.output
    return "rows.csv"


@pytest.mark.long
def test_a_curve_for_each_combination_of_the_other_keys():
    file = sweep("--vary", "drive.A=0,0.3,0.6", "--vary", "wheel.z=5,6", "--pick", "dwell_s")
    figure = of_table(file, "drive.A", ["dwell_s"])
    (panel,) = figure.panels
    assert panel.y.name == "timing.dwell_s"
    assert [curve.name for curve in panel.curves] == ["wheel.z = 5", "wheel.z = 6"]
    assert {curve.style for curve in panel.curves} == {JOINED}
    ((x, y),) = panel.curves[1].pieces
    assert x == [0.0, 0.3, 0.6]
    assert y[0] == pytest.approx(2.0 / 3.0)
    # over the other key: a curve for each A
    assert len(of_table(file, "wheel.z", ["dwell_s"]).panels[0].curves) == 3


def test_a_column_by_any_name_of_its_quantity():
    """A varied limit ends like the peak's other name, and is not meant by it."""
    swept = put("limits.acceleration_max,acceleration.max\n1,2\n3,5\n")
    (panel,) = of_table(swept, "limits.acceleration_max", ["acceleration_max"]).panels
    assert panel.y.label == "acceleration.max"
    table = put("z,acceleration_max\n5,2\n6,1\n")
    assert of_table(table, "wheel.z", ["acceleration.max"]).x.label == "z"


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("arguments", "wants"),
    [
        ([SPEC, "--pick", "velocty"], 'velocty: no quantity of a cycle (did you mean "velocity"?)'),
        ([SPEC, "--x", "a"], "--x and --y are for a .csv"),
        ([SPEC, "-o", "no/such/folder.svg"], "cannot write: No such file or directory"),
        ([SPEC, "rows.csv"], "a csv is plotted by itself"),
        (["rows.csv", "--x", "a", "--y", "b", "-o", "rows.csv"], "is an input"),
    ],
)
def test_refused(arguments, wants):
    """One line, exit status 2, and nothing is left behind."""
    put("a,b\n1,2\n")
    found = run("plot", *arguments)
    assert found.exit_code == 2 and found.stdout == ""
    assert wants in found.stderr and found.stderr.count("\n") == 1
    assert os.listdir() == ["rows.csv"]


def test_a_quantity_that_one_design_lacks_is_left_out_with_a_word():
    loaded = str(repo.DESIGNS / "turret.toml")
    found = run("plot", SPEC, loaded, "--pick", "pin_force_N", "-o", "a.svg")
    assert found.exit_code == 0
    assert f"{SPEC}: warning: no curve of pin_force_N: no force is known" in found.stderr
    with open("a.svg", encoding="utf-8") as file:
        assert 'class="curve c1"' in file.read()


def test_one_spec_through_values_is_a_curve_for_each():
    """The same curves as of the key set over the file; several files have none to vary."""
    found = run("plot", SPEC, "--vary", "drive.A=0,0.6", "--pick", "velocity", "--format", "json")
    assert found.exit_code == 0, found.output
    alone = run("plot", SPEC, "--set", "drive.A=0", "--pick", "velocity", "--format", "json")
    rows, own = (json.loads(one.stdout)["rows"] for one in (found, alone))
    assert {row["curve"] for row in rows} == {"drive.A=0", "drive.A=0.6"}
    first = {(row["input_deg"], row["value"]) for row in rows if row["curve"] == "drive.A=0"}
    moving = {(row["input_deg"], row["value"]) for row in own if abs(row["input_deg"]) <= 60.0}
    assert len(moving) > 20 and moving <= first  # it begins to rest elsewhere in the window
    refused = run("plot", SPEC, SPEC, "--vary", "drive.A=0,0.6")
    assert refused.exit_code == 2 and "--vary is for one SPEC" in refused.output
