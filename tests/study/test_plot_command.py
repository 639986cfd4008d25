"""Figures of sweeps, fronts and spectra from their CSV files, and what `geneva plot` refuses."""

import json
import os

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.figure import JOINED, POINTS
from geneva_cli.study.compare import of_table

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


def test_ascending_numbers_make_a_curve_divided_where_a_row_has_none():
    table = put("z,timing.dwell_s\n5,2\n6,\n7,1\n")
    (panel,) = of_table(table, "z", ["dwell_s"]).panels
    (curve,) = panel.curves
    assert (panel.y.name, curve.style) == ("timing.dwell_s", JOINED)
    assert [x for x, _ in curve.pieces] == [[5.0], [7.0]]
    (curve,) = of_table(put("a,b\n2,1\n1,2\n"), "a", ["b"]).panels[0].curves
    assert curve.style == POINTS


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
