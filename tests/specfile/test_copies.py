"""The designs that come with the program, copied."""

import re

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli import GenevaError, load
from geneva_cli.cli.app import app


def new(*words):
    return CliRunner().invoke(app, ["new", *map(str, words)])


def test_a_copy_is_the_design_and_what_it_names(tmp_path):
    file = tmp_path / "table-law" / "spec.toml"
    file.parent.mkdir()
    assert new("--from-design", "table-law", "-o", file).exit_code == 0
    assert file.read_bytes() == (repo.DESIGNS / "table-law.toml").read_bytes()
    assert CliRunner().invoke(app, ["peaks", str(file)]).exit_code == 0
    (tmp_path / "table-law" / "table-law.csv").write_text("mine")
    refused = new("--from-design", "table-law", "-o", tmp_path / "table-law" / "third.toml")
    assert refused.exit_code == 2 and "this file exists" in refused.output


def test_what_is_wrong_is_said():
    assert 'did you mean "turret"' in new("--from-design", "turet").output
    assert "give -o FILE" in new("--from-design", "table-law").output
    for words in ((), ("curved", "--list"), ("curved", "--from-design", "turret")):
        assert new(*words).exit_code == 2


def test_a_file_that_exists_is_replaced_by_force_alone(tmp_path):
    """A spec is a person's work: of the new one not a byte goes over it."""
    file = tmp_path / "spec.toml"
    for words in (["external"], ["--from-design", "turret"]):
        file.write_text("mine")
        refused = new(*words, "-o", file)
        assert refused.exit_code == 2
        assert "this file exists; give another name, or --force" in refused.output
        assert file.read_text(encoding="utf-8") == "mine"
        assert new(*words, "--force", "-o", file).exit_code == 0
        assert "[wheel]" in file.read_text(encoding="utf-8")


def test_a_design_in_place_of_a_kind_is_answered_with_its_option():
    refused = new("projector")
    assert refused.exit_code == 2
    assert "is a design, not a KIND; use `geneva new --from-design projector`" in refused.stderr


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("designs/turret.toml", "--from-design turret -o turret.toml` writes one"),
        ("mine.toml", "`geneva new external -o spec.toml` writes one"),
    ],
)
def test_a_spec_that_is_not_there_is_answered_with_a_way_to_one(path, said, tmp_path):
    with pytest.raises(GenevaError, match=re.escape(said)):
        load(str(tmp_path / path))
