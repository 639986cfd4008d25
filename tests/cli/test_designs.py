"""Every command on every design of the folder, and in every format on one."""

import csv
import io
import json
import math
from pathlib import Path

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli import load
from geneva_cli.cli.app import app

pytestmark = pytest.mark.usefixtures("made_once", "read_once")
DESIGNS = sorted((repo.DESIGNS).glob("*.toml"))
COMMANDS = {
    "peaks": [],
    "motion": ["--samples", "73"],
    "profile": ["--tolerance", "0.05"],
    "loads": [],
    "plot": ["--pick", "wheel_deg,velocity,acceleration,jerk,power"],
    "vibration": ["--period-ratio", "4.2", "--samples", "9"],
    "report": [],
    "check": [],
}


def numbers(value: object) -> list[float]:
    if isinstance(value, dict):
        return [x for v in value.values() for x in numbers(v)]
    if isinstance(value, list):
        return [x for v in value for x in numbers(v)]
    return [value] if isinstance(value, float) else []


ONE = repo.DESIGNS / "four-bar-z4.toml"  # in all formats: it has links, a curve and loads


@pytest.mark.sampled(6)
@pytest.mark.parametrize("format", ["table", "csv", "md"])
@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_in_every_format(command: str, format: str) -> None:
    run(ONE, command, format)


@pytest.mark.sampled(24)
@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("design", DESIGNS, ids=lambda p: p.stem)
def test_every_command_on_every_design(design: Path, command: str) -> None:
    run(design, command, "json")


def run(design: Path, command: str, format: str) -> None:
    """Run a command and find numbers alone in what it prints."""
    spec = load(str(design)).spec
    column = spec.output.column  # a rack has another one
    words = [word.replace("wheel_deg", column) for word in COMMANDS[command]]
    arguments = [command, str(design), "--format", format, *words]
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 0, result.output
    assert "nan" not in result.stdout.lower().replace("nance", "")
    if format == "json":
        assert all(math.isfinite(x) for x in numbers(json.loads(result.stdout)))
    if format == "csv":
        rows = list(csv.reader(io.StringIO(result.stdout)))
        assert len(rows) > 1
        assert {len(row) for row in rows} == {len(rows[0])}


def test_there_are_designs_enough() -> None:
    assert len(DESIGNS) >= 10


@pytest.mark.parametrize("design", DESIGNS, ids=lambda p: p.stem)
def test_a_design_says_what_it_is(design: Path) -> None:
    assert design.read_text(encoding="utf-8").startswith("# ")
