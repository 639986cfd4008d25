"""Reference pages that the code prints have every command, key and quantity."""

import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from geneva_cli import manual
from geneva_cli.cli.app import COMMANDS, app
from geneva_cli.cli.pages import PRINTED, page
from geneva_cli.manual import TOPICS, entries, path
from geneva_cli.specfile.keys import all_keys


def help_of(command: str) -> str:
    """What ``geneva COMMAND -h`` prints on 80 columns."""
    result = CliRunner().invoke(app, [command, "-h"], prog_name="geneva", terminal_width=80)
    return "\n".join(line.rstrip() for line in result.stdout.strip().splitlines())


def rows(text: str) -> list[list[str]]:
    """Cells of the rows of all tables, without their headings."""
    lines = [line for line in text.splitlines() if line.startswith("| `")]
    return [re.split(r" (?<!\\)\| ", line.strip("| ")) for line in lines]


def test_every_page_that_is_printed_is_a_topic_and_no_file() -> None:
    assert PRINTED.keys() <= TOPICS.keys()
    files = {Path(path(topic)) for topic in TOPICS if topic not in PRINTED}
    assert files == set(Path(manual.__file__).parent.rglob("*.md"))
    assert all(page(topic).startswith("# ") for topic in PRINTED)


@pytest.mark.sampled(5)
@pytest.mark.parametrize("command", COMMANDS)
def test_the_page_of_commands_has_their_help(command: str) -> None:
    assert f"## {command}\n\n```text\n{help_of(command)}\n```\n" in page("commands")


def test_the_page_of_keys_has_each_of_them() -> None:
    shown = rows(page("keys"))
    assert [row[0].strip("`") for row in shown] == [key.key for key in all_keys()]
    (speed,) = (row for row in shown if row[0] == "`n_rpm`")
    assert speed[1] == "1/min" and speed[3] == "`60.0`"
    assert {row[3] for row in shown if row[0] == "`z`"} == {"required"}


def test_the_page_of_quantities_is_one_table() -> None:
    shown = rows(page("quantities"))
    named = [name for row in shown for name in re.findall(r"`([^`]+)`", row[0])]
    assert named == [n for e in entries() if e.group == "quantity" for n in e.names]
    assert all(len(row) == 3 and row[2] for row in shown)
    (force,) = (row for row in shown if row[0] == "`loads.pin_force_N`")
    assert force[1] == "N"
