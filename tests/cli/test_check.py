"""`geneva check`: a headline that counts warnings, what to change, and one list of warnings."""

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli.cli.app import app

pytestmark = pytest.mark.usefixtures("made_once")
TURRET, PLAIN, CURVED = "turret.toml", "side-crank-z6.toml", "press-curved.toml"
FAST = "[wheel]\nz = 6\n[drive]\nkind = 'side-crank'\nA = 0.1\n[limits]\nacceleration_max = 1.0\n"


def run(*arguments: str) -> Any:
    return CliRunner().invoke(app, ["check", *arguments])


@pytest.fixture(autouse=True)
def fails(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A spec that fails, in the folder with the designs."""
    monkeypatch.chdir(tmp_path)
    for name in (TURRET, PLAIN, CURVED):
        shutil.copy(repo.DESIGNS / name, name)
    (tmp_path / "fast.toml").write_text(FAST, encoding="utf-8")
    return "fast.toml"


@pytest.fixture
def watched(monkeypatch: pytest.MonkeyPatch) -> None:
    """A person looks at standard output, in a window of 60 columns, without colour."""
    monkeypatch.setattr("geneva_cli.output.is_seen", lambda output: output == "-")
    monkeypatch.setenv("COLUMNS", "60")
    monkeypatch.setenv("NO_COLOR", "1")


def test_a_headline_counts_warnings() -> None:
    """A machine whose wall is cut away for half the motion does not read as one that passes."""
    for spec, headline in (
        (PLAIN, "✓ {}: all 17 checks pass"),
        (TURRET, "! {}: all 22 checks pass, 1 warning"),
        (
            CURVED,
            "! {}: all 28 checks pass, not positively driven during 47.5 % of the motion, "
            "3 warnings",
        ),
    ):
        found = run(spec)
        assert found.exit_code == 0
        assert " ".join(found.stdout.split("\n\n")[0].split()) == headline.format(spec)


def test_json_has_the_warnings_and_strict_obeys_them() -> None:
    found = run(PLAIN, TURRET, "--format", "json")
    tree = json.loads(found.stdout)
    assert list(tree) == ["rows", "passes", "warnings", "chosen"]
    assert tree["passes"] is True
    assert list(tree["chosen"]) == [PLAIN, TURRET] and tree["chosen"][PLAIN] == {}
    pin = tree["chosen"][TURRET]["size.pin_mm"]
    assert pin == {"value": 12.0, "was": None, "why": "by load: 202.5 N on the pin"}
    (warning,) = tree["warnings"]
    assert list(warning) == ["spec", "name", "text", "accepted"]
    assert (warning["spec"], warning["name"]) == (TURRET, "wheel-left-out")
    assert warning["text"].startswith("the wheel's own inertia, as drawn, is 0.3024 kg m²")
    assert {row["spec"] for row in tree["rows"]} == {PLAIN, TURRET}
    assert found.exit_code == 0
    assert run(TURRET, "--strict", "--format", "json").exit_code == 1
    assert run(PLAIN, "--strict").exit_code == 0


def test_a_spec_that_cannot_be_read_does_not_pass() -> None:
    Path("bad.toml").write_text("[wheel]\nzz = 6\n", encoding="utf-8")
    error = {"spec": "bad.toml", "error": 'bad.toml:2: unknown key zz in [wheel] (did you mean "z"'}
    for others in ([], [PLAIN], [PLAIN, TURRET]):
        found = run("bad.toml", *others, "--format", "json")
        tree = json.loads(found.stdout)
        assert (found.exit_code, tree["passes"]) == (2, False)
        (row,) = (one for one in tree["rows"] if one["spec"] == "bad.toml")
        assert list(row) == list(error) and row["error"].startswith(error["error"])
        assert {one["spec"] for one in tree["rows"]} == {"bad.toml", *others}
    few = run("bad.toml", PLAIN, "--format", "json", "--columns", "spec,error")
    assert [*json.loads(few.stdout)][:1] == ["rows"] and "zz" in few.stdout
    assert "✗ 1 of 2 specs passes, 1 cannot be read" in run("bad.toml", PLAIN).stdout
    both = run("bad.toml", PLAIN, "fast.toml").stdout
    assert "✗ 1 of 3 specs fails, 1 cannot be read" in both


@pytest.mark.parametrize("format", ["table", "csv", "json", "md"])
def test_a_warning_is_printed_once(format: str) -> None:
    """On standard error where the format has no place for it, and nowhere else."""
    found = run(TURRET, "--format", format)
    both = " ".join(f"{found.stdout} {found.stderr}".split())
    assert both.count("if the load leaves it out, add") == 1
    assert ("leaves it" in found.stderr) is (format == "csv")


def test_what_fails_says_what_to_change(fails: str) -> None:
    """The change that is named passes."""
    found = run(fails)
    assert found.exit_code == 1
    assert found.stdout.startswith(f"✗ {fails}: 1 of 18 checks fails\n")
    failing = found.stdout.split("\n\n")[1]
    assert "peak acceleration  1.113, at most 1" in failing
    change = failing.split("passes with ")[1].split(" (")[0]
    assert run(fails, "--set", f"drive.{change.replace(' ', '')}").exit_code == 0


def test_parts_that_cannot_be_built_are_named(watched: None) -> None:
    """Beside the change that passes; the row has no value that would tell."""
    spec = str(repo.DESIGNS / "press-straight.toml")
    shown = " ".join(run(spec, "--set", "size.wheel_bore_mm=400").stdout.split())
    assert "parts wheel_bore_mm = 400: the slots reach down to 199.945 mm" in shown
    assert "passes with wheel_bore_mm = " in shown
    assert shown.count("the slots reach down to") == 1  # the text; the note is the change alone


def test_several_specs_are_counted_before_their_details(fails: str) -> None:
    found = run(PLAIN, fails, TURRET).stdout
    heads, *details = found.split("\n\n")
    *lines, count, sizes = heads.splitlines()
    assert [line[0] for line in lines] == ["✓", "✗", "!"]
    assert count == "✗ 1 of 3 specs fails, 1 with warnings"
    assert sizes == "sizes chosen by load in 1 of 3 specs (geneva size SPEC writes them)"
    assert details[0] == fails
    assert details[2] == TURRET


def test_standard_input_is_read_once() -> None:
    twice = CliRunner().invoke(app, ["check", "-", PLAIN, "-"], input="[wheel]\nz = 6\n")
    assert twice.exit_code == 2 and not twice.stdout
    assert twice.stderr == "<stdin>: given twice, but it can be read only once; name it once\n"
