"""Accepted warnings: shown with their reason, and no obstacle to ``--strict``."""

import json
import re
from pathlib import Path

import pytest
from click.testing import Result
from repo import ROOT
from typer.testing import CliRunner

from geneva_cli import Accept
from geneva_cli.cli.app import app
from geneva_cli.spec.schema import fields

SPEC = """\
[wheel]
z = 30
held_by = "brake"
[size]
roller_radius_mm = 1.5
lock_radius_mm = 0
slot_clearance_mm = 0.5
[accept]
many-slots = "a dial of 30 stations"
turns-back = "an older law"
"""
REASON = "a dial of 30 stations"


@pytest.fixture
def spec(tmp_path: Path) -> str:
    file = tmp_path / "dial.toml"
    file.write_text(SPEC, encoding="utf-8")
    return str(file)


def run(*words: str) -> Result:
    return CliRunner().invoke(app, [*words])


def test_every_warning_can_be_accepted() -> None:
    """Each name of a warning in the sources is a key; a note on an unknown value is no warning."""
    sources = [file.read_text(encoding="utf-8") for file in (ROOT / "geneva_cli").rglob("*.py")]
    named = {name for text in sources for name in re.findall(r'Notice\(\s*"([a-z-]+)"', text)}
    assert {field.key for field in fields(Accept)} == named - {"not-known"}
    assert named > {*Accept.ELSEWHERE}


def test_check_shows_the_reason_and_what_does_not_occur(spec: str) -> None:
    shown = run("check", spec).stdout
    assert "1 warning, 1 warning accepted" in shown
    assert f"accepted  many-slots: {REASON}" in shown
    assert "note      turns-back: no such warning occurs" in shown
    report = run("report", spec).stdout
    assert f"accepted      many-slots: {REASON}" in report
    assert "note          turns-back: no such warning occurs" in report


def test_strict_passes_once_all_are_accepted(spec: str) -> None:
    assert run("check", spec, "--strict").exit_code == 1
    more = ("--set", "accept.loose-fit=painted slots")
    passes = run("check", spec, "--strict", "--format", "json", *more)
    assert passes.exit_code == 0
    warnings = {row["name"]: row for row in json.loads(passes.stdout)["warnings"]}
    assert warnings["many-slots"]["accepted"] == REASON
    assert warnings["many-slots"]["text"].startswith("z = 30: more than 24 slots")
    assert run("check", spec, *more).stdout.startswith(f"✓ {spec}: all")


def test_lists_of_texts_have_the_reason(spec: str) -> None:
    for command in ("loads", "report"):
        tree = json.loads(run(command, spec, "--format", "json").stdout)
        assert any(text.startswith(f"accepted ({REASON}): z = 30") for text in tree["warnings"])
    written = run("peaks", spec, "--format", "csv", "-o", f"{spec}.csv").stderr
    assert f"warning, accepted ({REASON}): z = 30" in written


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ('many-slot = "agreed"', 'dial.toml:9: unknown key many-slot in [accept] (did you mean "m'),
        ('many-slots = " "', "dial.toml:9: many-slots needs the reason for accepting it"),
    ],
)
def test_bad_names_and_reasons_have_their_line(spec: str, line: str, message: str) -> None:
    Path(spec).write_text(SPEC.replace('many-slots = "a dial of 30 stations"', line))
    shown = run("check", spec)
    assert shown.exit_code == 2
    assert message in shown.stderr
