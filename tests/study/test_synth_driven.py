"""A machine that its slots do not drive during half of the motion, in the rows of a search."""

import pytest
from typer.testing import CliRunner

from geneva_cli.cli.app import app

DIAL = """[wheel]
z = 8
[drive]
n_rpm = 40
[load]
inertia_kgm2 = 0.8
torque_Nm = 12
"""


def rows(tmp_path, *options):
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
    found = rows(tmp_path, "--check", "0")
    assert ("crank", "modified-sine", "no: driven_fraction") in found
    assert ("cam", "modified-sine", "maybe") in found  # straight slots drive any law


@pytest.mark.long
def test_buildable_rows_are_driven(tmp_path):
    found = rows(tmp_path, "--buildable", "--check", "1")
    assert found == [("cam", "modified-sine", "yes")]
