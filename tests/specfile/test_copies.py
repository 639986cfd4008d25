"""The designs that come with the program, copied."""

import repo
from typer.testing import CliRunner

from geneva_cli.app import app
from geneva_cli.specfile.designs import titles


def new(*words):
    return CliRunner().invoke(app, ["new", *map(str, words)])


def test_all_of_them_are_listed():
    listed = new("--list").stdout
    assert set(titles()) == {file.stem for file in repo.DESIGNS.glob("*.toml")}
    assert all(f"{name} " in listed and title in listed for name, title in titles().items())


def test_a_copy_is_the_design_and_what_it_names(tmp_path):
    for name in titles():
        file = tmp_path / name / "spec.toml"
        file.parent.mkdir()
        assert new("--from-design", name, "-o", file).exit_code == 0
        assert file.read_bytes() == (repo.DESIGNS / f"{name}.toml").read_bytes()
    beside = [path.name for path in tmp_path.glob("*/*.csv")]
    assert beside == ["table-law.csv"]
    again = new("--from-design", "table-law", "-o", tmp_path / "table-law" / "again.toml")
    assert again.exit_code == 0
    (tmp_path / "table-law" / "table-law.csv").write_text("mine")
    refused = new("--from-design", "table-law", "-o", tmp_path / "table-law" / "third.toml")
    assert refused.exit_code == 2 and "another file is there" in refused.output
    assert new("--from-design", "table-law", "-o", tmp_path / "spec.toml").exit_code == 0
    checked = CliRunner().invoke(app, ["peaks", str(tmp_path / "spec.toml")])
    assert checked.exit_code == 0


def test_what_is_wrong_is_said():
    assert 'did you mean "turret"' in new("--from-design", "turet").output
    assert "give -o FILE" in new("--from-design", "table-law").output
    for words in ((), ("curved", "--list"), ("curved", "--from-design", "turret")):
        assert new(*words).exit_code == 2
