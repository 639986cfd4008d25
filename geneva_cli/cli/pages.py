"""Pages of the manual: files, and those that the code itself prints; the search in all of them."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from geneva_cli import manual
from geneva_cli.manual import TOPICS, explained
from geneva_cli.names import unit_of

WIDTH = 80  # columns of a command's help on the page of all commands


class Hit(NamedTuple):
    """A section of a page in which a word stands, and the first line with it."""

    topic: str  # the word for ``geneva help``
    section: str
    line: str


def page(topic: str) -> str:
    """A topic's page as Markdown, without pictures; raises GenevaError for an unknown topic."""
    return PRINTED[topic]() if topic in PRINTED else manual.page(topic)


def commands_page() -> str:
    """The help of every command, under the headings of ``geneva --help``."""
    import click
    from typer.main import get_command

    from geneva_cli.cli.app import COMMANDS, GROUPS, app

    parts = [
        "# Commands\n\nThe help of each command, as `geneva COMMAND -h` prints it. "
        "`geneva help formats` describes\nwhat they write.\n"
    ]
    for title, names in GROUPS.items():
        rows = "\n".join(f"| [{n}](#{n}) | {line} |" for n, line in names.items())
        parts.append(f"| {title.lower()} | |\n| --- | --- |\n{rows}\n")
    group: Any = get_command(app)
    settings = {**group.context_settings, "terminal_width": WIDTH}
    root = click.Context(group, info_name="geneva", **settings)
    for name in COMMANDS:
        _, command, _ = group.resolve_command(root, [name])
        shown = command.get_help(click.Context(command, parent=root, info_name=name))
        lines = "\n".join(line.rstrip() for line in shown.strip().splitlines())
        parts.append(f"## {name}\n\n```text\n{lines}\n```\n")
    return "\n".join(parts)


def keys_page() -> str:
    """Every key of a spec, a table of keys for each table of the file."""
    from geneva_cli.specfile.keys import Key, all_keys

    parts = [
        "# Keys\n\nEvery key of a spec, as `geneva keys` lists them. A key with kinds in brackets "
        "goes with\nthese kinds only. A default of `-` means that the value follows from other "
        "keys, or is not\nneeded.\n"
    ]
    tables: dict[str, list[Key]] = {}
    for key in all_keys():
        tables.setdefault(key.table, []).append(key)
    for table, keys in tables.items():
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
        title = f"[{table}]" if table else "Above the tables"
        head = ("key", "unit", "value", "default", "meaning")
        parts.append(f"## {title}\n\n{_table(head, rows)}")
    return "\n".join(parts)


def quantities_page() -> str:
    """Every quantity: names, unit and the first sentence of its meaning."""
    rows = []
    for entry in explained.entries():
        if entry.page == "quantities":
            unit = entry.unit or next(filter(None, map(unit_of, entry.names)), "")
            meaning = entry.meaning.partition(". ")[0].rstrip(".")
            unit = "" if unit.startswith("that of") else unit
            names = ", ".join(f"`{name}`" for name in entry.names)
            rows.append((names, unit, meaning))
    return explained.head("quantities") + _table(("name", "unit", "meaning"), rows)


def _table(head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    lines = [head, ("---",) * len(head), *rows]
    escaped = ([cell.replace("|", r"\|") for cell in line] for line in lines)
    return "".join(f"| {' | '.join(line)} |\n" for line in escaped)


PRINTED: dict[str, Callable[[], str]] = {
    "commands": commands_page,
    "keys": keys_page,
    "quantities": quantities_page,
}


def search(word: str) -> list[Hit]:
    """Sections of all pages in which a word begins so, in any case; one hit for each section.

    Of words that stand nowhere together, the sections in which all of them stand.

    Sections with the word in their heading come first. The output of examples is not searched.
    """
    whole, words = _search(word), word.split()
    if whole or len(words) < 2:
        return whole
    # sections with all of the words
    first, *others = map(_search, words)
    sections = [{hit[:2] for hit in hits} for hits in others]
    return [hit for hit in first if all(hit[:2] in one for one in sections)]


def _search(word: str) -> list[Hit]:
    wanted = re.compile(rf"(?<![^\W\d_]){re.escape(word)}", re.IGNORECASE)
    hits: dict[tuple[str, str], Hit] = {}
    for topic in TOPICS:
        section, fence = "", ""
        text = explained.text(topic) if topic == "quantities" else page(topic)  # with formulas
        for line in text.splitlines():
            if line.startswith("```"):
                fence = "" if fence else line
            elif fence == "```console" and not line.startswith("$ "):
                continue
            elif not fence and line.startswith("#"):  # in code it is a comment
                section = line.lstrip("# ")
            if wanted.search(line):
                hits.setdefault((topic, section), Hit(topic, section, _excerpt(line, wanted)))
    return sorted(hits.values(), key=lambda hit: not wanted.search(hit.section))


def _excerpt(line: str, wanted: re.Pattern[str]) -> str:
    """The part of a line that has a word in it."""
    plain = " ".join(line.replace("`", "").replace("*", "").lstrip("# ").split())
    match = wanted.search(plain)
    at, word = (match.start(), match.group()) if match else (0, "")
    around = 24  # characters on each side of the word
    start = max(0, plain.rfind(" ", 0, max(0, at - around)) + 1) if at > around else 0
    end = plain.find(" ", at + len(word) + around)
    return plain[start : end if end > 0 else len(plain)]
