"""Reference pages that are made from the code: each equals what is made today.

``GENEVA_UPDATE=1 pytest tests/cli/test_reference_pages.py`` writes them.
"""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from geneva_cli.cli.app import COMMANDS, GROUPS, app
from geneva_cli.manual import path
from geneva_cli.specfile.keys import Key, all_keys

WIDTH = 80  # columns of a terminal's help


def commands_page() -> str:
    """The help of every command, under the headings of ``geneva --help``."""
    parts = [
        "# Commands\n\nThe help of each command, as `geneva COMMAND -h` prints it. "
        "[Formats](formats.md) describes\nwhat they write.\n"
    ]
    for group, names in GROUPS.items():
        rows = "\n".join(f"| [{n}](#{n}) | {line} |" for n, line in names.items())
        parts.append(f"| {group.lower()} | |\n| --- | --- |\n{rows}\n")
    for name in COMMANDS:
        parts.append(f"## {name}\n\n```text\n{_help(name)}\n```\n")
    return "\n".join(parts)


def _help(name: str) -> str:
    result = CliRunner().invoke(app, [name, "-h"], prog_name="geneva")
    return "\n".join(line.rstrip() for line in result.stdout.strip().splitlines())


def keys_page() -> str:
    """Every key of a spec, a table of keys for each table of the file."""
    parts = [
        "# Keys\n\nEvery key of a spec, as `geneva keys` lists them. A key with kinds in brackets "
        "goes with\nthese kinds only. A default of `-` means that the value follows from other "
        "keys, or is not\nneeded.\n"
    ]
    tables: dict[str, list[Key]] = {}
    for key in all_keys():
        tables.setdefault(key.table, []).append(key)
    for table, keys in tables.items():
        head = "| key | unit | value | default | meaning |\n| --- | --- | --- | --- | --- |"
        title = f"[{table}]" if table else "Above the tables"
        parts.append("\n".join([f"## {title}\n", head, *map(_row, keys), ""]))
    return "\n".join(parts)


def _row(key: Key) -> str:
    kinds = f" ({key.goes_with})" if key.goes_with else ""
    default = "required" if key.required else f"`{key.default}`" if key.default else "-"
    value = key.range or key.type
    cells = (f"`{key.key}`", key.unit or "", value, default, key.meaning + kinds)
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"


MADE = {"commands": commands_page, "keys": keys_page}


@pytest.fixture(autouse=True)
def eighty_columns(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Help as a terminal of 80 columns shows it."""
    monkeypatch.setenv("COLUMNS", str(WIDTH))
    yield


@pytest.mark.parametrize("topic", MADE)
def test_a_page_is_what_the_code_makes(topic: str) -> None:
    file, today = Path(path(topic)), MADE[topic]()
    if os.environ.get("GENEVA_UPDATE"):
        file.write_text(today, encoding="utf-8")
    assert file.read_text(encoding="utf-8") == today
