"""Pages of the manual: files, and those that the code itself prints; the search in all of them."""

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import groupby
from operator import attrgetter
from typing import Any, NamedTuple

from geneva_cli import manual
from geneva_cli.errors import cut
from geneva_cli.manual import TOPICS, explained
from geneva_cli.names import unit_of

WIDTH = 80  # columns of a command's help on the page of all commands


class Hit(NamedTuple):
    """A section of a page in which a word stands, and the first line with it."""

    topic: str  # the word for ``geneva help``
    section: str
    line: str


def page(topic: str) -> str:
    """A topic's page as Markdown, without pictures."""
    return PRINTED[topic]() if topic in PRINTED else manual.page(topic)


def program(width: int | None = None) -> Any:
    """The program's context, for the terminal's width unless another is given."""
    from typer import Context
    from typer.main import get_command

    from geneva_cli.cli.app import app

    group: Any = get_command(app)
    return Context(group, info_name="geneva", terminal_width=width, **group.context_settings)


def command_help(root: Any, name: str) -> str:
    """The help of a command of the program with the context ``root``."""
    _, command, _ = root.command.resolve_command(root, [name])
    return str(command.get_help(type(root)(command, parent=root, info_name=name)))


def commands_page() -> str:
    """The help of every command, under the headings of ``geneva --help``."""
    from geneva_cli.cli.app import COMMANDS, GROUPS

    parts = [
        "# Commands\n\nThe help of each command, as `geneva COMMAND -h` prints it. "
        "`geneva help formats` describes\nwhat they write.\n"
    ]
    for title, names in GROUPS.items():
        rows = "\n".join(f"| [{n}](#{n}) | {line} |" for n, line in names.items())
        parts.append(f"| {title.lower()} | |\n| --- | --- |\n{rows}\n")
    root = program(WIDTH)
    for name in COMMANDS:
        shown = command_help(root, name)
        lines = "\n".join(line.rstrip() for line in shown.strip().splitlines())
        parts.append(f"## {name}\n\n```text\n{lines}\n```\n")
    return "\n".join(parts)


def keys_page() -> str:
    """Every key of a spec, a table of keys for each table of the file."""
    from geneva_cli.specfile.keys import all_keys

    parts = [
        "# Keys\n\nEvery key of a spec, as `geneva keys` lists them. A key with kinds in brackets "
        "goes with\nthese kinds only. A default of `-` means that the value follows from other "
        "keys, or is not\nneeded.\n"
    ]
    for table, keys in groupby(all_keys(), attrgetter("table")):
        rows = [
            (
                f"`{key.key}`",
                key.unit or "",
                key.range or key.type,
                "required" if key.required else f"`{key.default}`" if key.default else "-",
                key.meaning + (f" ({key.goes_with})" if key.goes_with else ""),
            )
            for key in keys
        ]
        rows.insert(0, ("key", "unit", "value", "default", "meaning"))
        parts.append(f"## {f'[{table}]' if table else 'Above the tables'}\n\n{_table(rows)}")
    return "\n".join(parts)


def quantities_page() -> str:
    """Every quantity: names, unit and the first sentence of its meaning."""
    rows = [("name", "unit", "meaning")]
    for entry in explained.entries():
        if entry.page == "quantities":
            unit = entry.unit or next(filter(None, map(unit_of, entry.names)), "")
            meaning = entry.meaning.partition(". ")[0].rstrip(".")
            unit = "" if unit.startswith("that of") else unit
            names = ", ".join(f"`{name}`" for name in entry.names)
            rows.append((names, unit, meaning))
    return explained.text("quantities").partition("## ")[0] + _table(rows)


def _table(rows: Sequence[tuple[str, ...]]) -> str:
    """A table, whose first row is the head."""
    head, *others = (" | ".join(cell.replace("|", r"\|") for cell in row) for row in rows)
    lines = [head, " | ".join(["---"] * len(rows[0])), *others]
    return "".join(f"| {line} |\n" for line in lines)


PRINTED: dict[str, Callable[[], str]] = {
    "commands": commands_page,
    "keys": keys_page,
    "quantities": quantities_page,
}


def search(text: str) -> list[Hit]:
    """Sections of all pages in which each word of a text begins one, in any case.

    Sections with a word in their heading come first. The output of examples is not searched.
    """
    words = [re.compile(rf"(?<![^\W\d_]){re.escape(w)}", re.IGNORECASE) for w in text.split()]
    hits: list[Hit] = []
    for topic in TOPICS:
        for section, lines in _sections(topic):
            found = [[line for line in lines if word.search(line)] for word in words]
            if all(found):
                hits.append(Hit(topic, section, _plain(found[0][0])))
    return sorted(hits, key=lambda hit: not any(word.search(hit.section) for word in words))


def _sections(topic: str) -> Iterator[tuple[str, list[str]]]:
    """The sections of a page: heading and lines."""
    heading, lines, fence = "", list[str](), ""
    text = explained.text(topic) if topic == "quantities" else page(topic)  # with formulas
    for line in text.splitlines():
        if not fence and line.startswith("#"):  # in code it is a comment
            yield heading, lines
            heading, lines = line.lstrip("# "), []
        if line.startswith("```"):
            fence = "" if fence else line
        elif fence != "```console" or line.startswith("$ "):
            lines.append(line)
    yield heading, lines


def _plain(line: str) -> str:
    return cut(" ".join(line.replace("`", "").replace("*", "").lstrip("# ").split()), 76)
