"""Every example in the README is run again, and its output compared.

``GENEVA_UPDATE=1 pytest tests/commands/test_readme.py`` writes today's output into the README.
"""

import os
import re
import shlex
from pathlib import Path

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli.app import COMMANDS, app

ROOT = repo.ROOT
README = ROOT / "README.md"
BLOCK = re.compile(r"```console\n(.*?)```", re.DOTALL)


def run(command: str) -> str:
    program, *arguments = shlex.split(command)
    assert program == "geneva"
    result = CliRunner().invoke(app, arguments, prog_name="geneva")
    assert result.exit_code == 0, result.output
    return result.stdout


def replay(block: str) -> str:
    """The block with the output of each of its commands as it is today."""
    commands = [line[2:] for line in block.splitlines() if line.startswith("$ ")]
    return "\n".join(f"$ {command}\n{run(command)}" for command in commands)


@pytest.fixture(autouse=True)
def at_root(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)


def test_the_examples_print_what_the_readme_shows() -> None:
    text = README.read_text(encoding="utf-8")
    today = BLOCK.sub(lambda m: f"```console\n{replay(m[1])}```", text)
    if os.environ.get("GENEVA_UPDATE"):
        README.write_text(today, encoding="utf-8")
    assert text == today or os.environ.get("GENEVA_UPDATE")


def test_the_spec_in_the_readme_is_valid(tmp_path: Path) -> None:
    spec = re.search(r"```toml\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    assert spec
    file = tmp_path / "readme.toml"
    file.write_text(spec[1], encoding="utf-8")
    result = CliRunner().invoke(app, ["check", str(file)])
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_is_in_the_readme(command: str) -> None:
    assert f"geneva {command}" in README.read_text(encoding="utf-8")
