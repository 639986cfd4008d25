"""What a command says of itself: groups, examples that run, and words that the shell may put."""

import importlib
import shutil
import sys

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli.cli.app import COMMANDS, GROUPS, app
from geneva_cli.cli.command import as_command
from geneva_cli.manual import GROUPS as PAGES
from geneva_cli.output import CAMS, CONTROLLERS, DOCUMENTS, DRAWN, FORMATS

EXAMPLES = [
    (name, example)
    for name in COMMANDS
    for example in as_command(
        name, importlib.import_module(f"geneva_cli.cli.commands.{name}").run
    ).examples
]


def geneva(*words, cwd=None):
    result = CliRunner().invoke(app, [*words], prog_name="geneva")
    assert result.exit_code == 0, result.output
    return result.stdout


def test_help_lists_the_commands_by_what_a_person_wants():
    said = geneva("-h")
    assert said == geneva("--help")
    for group, commands in GROUPS.items():
        block = said.partition(f"\n{group}:\n")[2].partition("\n\n")[0]
        assert [line.split()[0] for line in block.splitlines()] == list(commands)
    assert max(map(len, said.splitlines())) <= 80


def test_help_begins_with_three_examples_and_ends_with_options():
    """Between them a line for each group of the manual, in place of all its topics."""
    said = geneva("-h")
    examples = said.partition("\nExamples:\n")[2].partition("\n\n")[0].splitlines()
    assert [line.split()[1] for line in examples] == ["new", "check", "profile"]
    topics = said.partition("\nManual")[2].partition("\n\n")[0].splitlines()[1:]
    assert [line.split()[0].strip(",") for line in topics] == [p.split(":")[0] for p in PAGES]
    options = [line.split()[0] for line in said.splitlines() if line.startswith("  -")]
    assert options[-3:] == ["--install-completion", "--show-completion", "-h,"]


@pytest.mark.parametrize("name", COMMANDS)
def test_help_of_a_command_ends_with_its_examples(name):
    said = geneva(name, "-h")
    shown = said.partition("\nExamples:\n")[2].replace(" \\\n      ", " ").splitlines()
    assert [line.strip() for line in shown] == [e for n, e in EXAMPLES if n == name] != []


def test_the_page_of_all_commands_needs_no_click(monkeypatch):
    """An install without the tools of development has no Click: Typer brings its own."""
    monkeypatch.setitem(sys.modules, "click", None)
    assert "## check\n" in geneva("help", "commands")


@pytest.mark.parametrize(
    ("name", "formats"),
    [
        ("keys", FORMATS),
        ("motion", (*FORMATS, *CAMS)),
        ("motion", CONTROLLERS),
        ("profile", (*FORMATS, *DRAWN, "pdf")),
        ("report", {**FORMATS, **DOCUMENTS}),
    ],
)
def test_help_names_the_formats_that_are_written(name, formats):
    *others, last = formats
    assert f"{', '.join(others)} or {last}." in " ".join(geneva(name, "-h").split())


@pytest.mark.long
@pytest.mark.parametrize(("name", "example"), EXAMPLES, ids=[e for _, e in EXAMPLES])
def test_an_example_runs_as_it_stands(name, example, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("webbrowser.open", lambda page: True)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    shutil.copy(repo.DESIGNS / "turret.toml", "spec.toml")
    program, *words = example.split()
    assert program == "geneva" and name in words[:1]
    geneva(*words)
