"""README and manual: every example is run again and compared, every picture is drawn anew.

``GENEVA_UPDATE=1 pytest tests/cli/test_manual.py`` writes today's outputs and pictures.
"""

import os
import re
import shlex
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
import repo
from typer.testing import CliRunner
from windows import looking

from geneva_cli import output
from geneva_cli.cli.app import COMMANDS, app
from geneva_cli.cli.command import as_command
from geneva_cli.cli.commands import help
from geneva_cli.cli.pages import PRINTED, page
from geneva_cli.manual import GROUPS, TOPICS, path

pytestmark = pytest.mark.usefixtures("made_once")
ROOT = repo.ROOT
README = ROOT / "README.md"
PAGES = [README, *(Path(path(topic)) for topic in TOPICS if topic not in PRINTED)]
UPDATE = bool(os.environ.get("GENEVA_UPDATE"))
FENCE = re.compile(r"```([a-z]+)\n(.*?)```", re.DOTALL)
NAMED = re.compile(r"# (add to )?(\S+\.\w+)\n")  # first line of a block that is a file
CONTINUED = "\\\n"  # the end of a line whose command goes on in the next
COMMAND = re.compile(r"^\$ ((?:.*\\\n)*.*)", re.MULTILINE)  # of a block with its output
SILENT = re.compile(r"^(\$ (?:.*\\\n)*.*\n)\n(?=\$ )", re.MULTILINE)  # a command without output
PICTURES = ROOT / "geneva_cli/manual/pictures"
DRAWN = tomllib.loads((ROOT / "tests/cli/pictures.toml").read_text(encoding="utf-8"))
SHOWN = re.compile(r'<img src="([^"]+)"')
COLUMNS = 78  # of the terminal that examples are seen on: with their indent they fill one of 80
NUMBER = re.compile(r"-?\d+\.\d+")


def searching(file: Path) -> object:
    """A page; long runs and updates alone take those that search or draw for a second or more."""
    search = "sweep-front", "dwell-time", "reduce-acceleration", "find-tolerances", "tolerances"
    files = "processes", "inches", "ci", "write-report", "drawing-sheet", "hand-over", "cad"
    more = "accuracy", "shafts", "plots", "size-motor", "law-from-csv", "stop-swinging"
    long = file.stem in (*search, *files, *more) and not UPDATE
    return pytest.param(file, marks=pytest.mark.long) if long else file


def invoke(arguments: list[str]) -> str:
    """What a command prints; a check that is shown to fail ends with 1."""
    result = CliRunner().invoke(app, arguments, prog_name="geneva")
    assert result.exit_code <= (arguments[0] == "check"), result.output
    return result.stdout


def run(command: str) -> str:
    """What a reader sees, on a terminal without colours."""
    program, *arguments = shlex.split(command)
    assert program == "geneva"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(output, "is_seen", lambda file: file == "-" and arguments[0] != "plot")
        patch.setenv("COLUMNS", str(COLUMNS))
        patch.setenv("TERM", "dumb")
        return invoke(arguments)


def replay(block: str) -> str:
    """The block with the output of each of its commands as it is today."""
    commands = COMMAND.findall(block)
    shown = "\n".join(f"$ {one}\n{run(one.replace(CONTINUED, ' '))}" for one in commands)
    return SILENT.sub(r"\1", shown)


def do(kind: str, block: str) -> str:
    """A block of a how-to as it is today, done by a reader who takes one after the other."""
    if kind == "console":
        return replay(block)
    if kind == "sh":
        for command in commands_in(block):
            invoke(words_of(command))
    elif (name := NAMED.match(block)) and kind != "python":
        with open(name[2], "a" if name[1] else "w", encoding="utf-8") as file:
            file.write(block)
    return block


@pytest.mark.parametrize("file", PAGES[1:], ids=lambda file: file.stem)
def test_a_line_to_paste_is_not_broken_by_a_window(file: Path) -> None:
    """A command or a line of code fits into 80 columns with its indent."""
    pasted = []
    for kind, block in FENCE.findall(text_of(file)):
        if kind == "text":  # a message
            continue
        commands = [f"$ {c}" for c in COMMAND.findall(block)] if kind == "console" else [block]
        pasted += [line for command in commands for line in command.splitlines()]
    assert [line for line in pasted if len(line) > COLUMNS] == []
    assert [line for line in pasted if re.search(r" (-o|--output) ?\\?$", line)] == []


def text_of(file: Path) -> str:
    return file.read_text(encoding="utf-8")


@pytest.fixture(autouse=True)
def windows() -> Iterator[None]:
    """What is printed fits into the window of any terminal."""
    with looking():
        yield


@pytest.fixture(autouse=True)
def at_root(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)


@pytest.mark.parametrize("file", [*map(searching, PAGES)], ids=lambda file: file.stem)
def test_the_examples_print_what_is_shown(
    file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = text_of(file)
    monkeypatch.chdir(tmp_path)  # a page makes the files that it reads
    today = FENCE.sub(lambda m: f"```{m[1]}\n{do(m[1], m[2])}```", text)
    if UPDATE:
        file.write_text(today, encoding="utf-8")
    assert text == today or UPDATE


def test_pages_show_the_pictures_that_are_drawn() -> None:
    shown = {PICTURES / Path(name).name for file in PAGES for name in SHOWN.findall(text_of(file))}
    assert shown == {PICTURES / name for name in DRAWN} == set(PICTURES.glob("*.svg"))


@pytest.mark.sampled(1 if UPDATE else 3)
@pytest.mark.parametrize("name", DRAWN)
def test_a_picture_is_what_its_command_draws(name: str, tmp_path: Path) -> None:
    """To a hundredth of a unit: another processor may round another last digit."""
    kept, new = PICTURES / name, tmp_path / name
    invoke([*shlex.split(DRAWN[name])[1:], "-o", str(new)])
    if UPDATE:
        kept.write_text(text_of(new), encoding="utf-8")
    old, today = text_of(kept), text_of(new)
    assert NUMBER.sub("", old) == NUMBER.sub("", today)
    numbers = [[float(n) for n in NUMBER.findall(text)] for text in (old, today)]
    assert numbers[0] == pytest.approx(numbers[1], abs=0.01)


def commands_in(block: str) -> list[str]:
    """The commands of a shell block, but those of a job array's variables."""
    lines = block.replace(CONTINUED, " ").splitlines()
    return [line for line in lines if line.startswith("geneva ") and "$" not in line]


def words_of(command: str) -> list[str]:
    """The arguments of a command as a shell splits them; fewer designs of many."""
    few = re.sub(r"--random 10+|--samples 1000000", lambda m: m[0][:-2], command)
    words = shlex.split(few, comments=True)
    return words[1 : words.index(">") if ">" in words else None]


def test_the_readme_is_short_and_leads_to_the_manual() -> None:
    text = text_of(README)
    assert len(text.splitlines()) <= 120
    links = re.findall(r"\]\(([^)]+)\)", text)
    assert {name for name in links if not (ROOT / name).exists()} == set()
    assert "geneva_cli/manual" in links and "`geneva help`" in text


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_is_in_the_manual(command: str) -> None:
    assert any(f"geneva {command}" in text_of(file) for file in PAGES)


def test_pages_begin_with_a_title_and_name_pages_that_exist() -> None:
    for topic in TOPICS:
        text = page(topic)
        assert text.startswith("# ") and "<img" not in text and "<!--" not in text, topic
        named = set(re.findall(r"geneva help ([a-z-]+)", text))
        searched = {
            line.split()[-1] for line in as_command("help", help.run).examples
        }  # searched words
        assert named <= {*TOPICS, *COMMANDS, *searched}, topic


def test_help_prints_the_page_the_list_or_the_options_of_a_command() -> None:
    assert invoke(["help", "symbols"]) == invoke(["help", "symbol"]) == page("symbols")
    contents = invoke(["help"])
    assert all(f"- {topic}: {about}\n" in contents for topic, about in TOPICS.items())
    assert [line[3:] for line in contents.splitlines() if line.startswith("## ")] == [*GROUPS]
    assert invoke(["help", "peaks"]) == invoke(["peaks", "--help"])
    result = CliRunner().invoke(app, ["help", "symblos"])
    assert result.exit_code == 2 and 'did you mean "symbols"?' in result.output
