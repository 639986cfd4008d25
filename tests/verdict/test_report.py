"""`geneva report`: what check says stands on top, and a program finds the same names everywhere."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
import repo
from sampling import some
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.verdict import advice

pytestmark = pytest.mark.usefixtures("made_once")
DESIGNS = repo.DESIGNS
JAMS = "[wheel]\nz = 6\n[size]\nwheel_radius_mm = 120\n"


def run(*arguments: str) -> Any:
    return CliRunner().invoke(app, list(arguments))


def written(folder: Path, text: str) -> str:
    file = folder / "spec.toml"
    file.write_text(text, encoding="utf-8")
    return str(file)


def names(tree: Any, path: str = "") -> set[str]:
    """The dotted names of a json object; what may be a list or null has no names below it."""
    if not isinstance(tree, dict) or not path.count(".") < 3:
        return {path}
    return {name for k, v in tree.items() for name in names(v, f"{path}.{k}")}


@pytest.mark.long
def test_failed_checks_stand_on_top_and_end_as_check_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    spec = written(tmp_path, JAMS)
    found = run("report", spec, "--format", "json")
    assert found.exit_code == 1
    tree = json.loads(found.stdout)
    assert list(tree)[:4] == ["spec", "title", "passes", "checks_failed"]
    assert tree["passes"] is False
    (failed,) = tree["checks_failed"]
    assert re.match(r"parts overlap by 9\.171 mm at -?[\d.]+°; wheel_ra", failed)
    monkeypatch.setattr(advice, "TRIALS", 0)  # it is in the text above
    text = " ".join(run("report", spec).stdout.split())  # not as its lines are broken
    places = [text.index(part) for part in ("overlap by 9.17", "geneva explain gap_mm", "velocity")]
    assert places == sorted(places)


@pytest.mark.long
def test_a_program_finds_the_same_names_for_every_machine() -> None:
    """Two unlike engagements and a plain one; `make stress`: toothed, a sphere, a linkage."""
    trees = {}
    few = ("two-rollers-side-crank", "projector")
    for name in some((*few, "gear-sector", "spherical-z6", "four-bar-z4"), few):
        found = run("report", str(DESIGNS / f"{name}.toml"), "--format", "json")
        assert found.exit_code == 0
        trees[name] = json.loads(found.stdout) | {"chosen": None}
    plain = names(trees["projector"])
    for name, tree in trees.items():
        assert names(tree) == plain, name
    assert all(tree["not_proved"] == [] for tree in trees.values())
    two = trees["two-rollers-side-crank"]
    assert len(two["stations"]) == 2
    assert trees["projector"]["stations"] is None
    worst = max(s["acceleration"]["max"] for s in two["stations"])
    assert two["acceleration"]["max"] == worst
    assert two["timing"]["motion_deg"] is None
    assert two["timing"]["dwell_deg"] == pytest.approx(45.0)


@pytest.mark.parametrize("format", ["table", "json"])
def test_what_is_not_proved_shows(format: str, tmp_path: Path) -> None:
    spec = written(tmp_path, "[wheel]\nz = 400\n")
    for command in ("report", "check"):
        found = run(command, spec, "--format", format)
        assert found.exit_code == 0
        assert "slots are not drawn" in found.stdout


@pytest.mark.long
@pytest.mark.usefixtures("read_once", "no_advice")
def test_values_that_are_none_or_have_no_bound_are_words(tmp_path: Path) -> None:
    """An eye smaller than its pin's hole has no wall; a slot's edge bears without bound."""
    spec = written(tmp_path, "[wheel]\nz = 6\n[size]\narm_eye_mm = 1\n")
    endless = [str(DESIGNS / "press-345.toml"), "--set", "limits.contact_stress_max_MPa=500"]
    for words, said in (
        ([spec], "arm_wall_mm is not computed: arm_eye_mm = 1: the eye must be above 5"),
        (endless, "contact stress max no bound at -1.368°, at most 500; "),
    ):
        found = run("report", *words, "--format", "md")
        assert found.exit_code == 1 and isinstance(found.exception, SystemExit)
        assert said in found.stdout
        text = found.stdout.replace(spec, "")
        assert not re.search(r"\b(nan|inf)\b", text, re.IGNORECASE)
    warned = run("profile", spec, "--part", "wheel", "--format", "svg").stderr
    assert "arm_wall_mm is not computed: arm_eye_mm = 1" in warned
    assert "arm_wall_mm is 0" not in warned and "above 5, the pin's hole would" not in warned
