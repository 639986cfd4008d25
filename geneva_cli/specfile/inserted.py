"""Keys that are written into the text of a spec, whose comments and order stay."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

import tomli

from geneva_cli.specfile.writer import noted, quoted


class Written(NamedTuple):
    """A value to write, and the comment behind it; none where it is empty."""

    value: Any
    note: str = ""


def inserted(text: str, table: str, keys: Mapping[str, Written]) -> str | None:
    """Return a spec's text with these keys in one table.

    A key that the table has gets the value, and keeps its line and its comment. Others stand behind
    the table's last key, or in a table at the end of the text. Returns None for a text in which the
    table has no line of its own, as in ``size = {pin_mm = 6}``, or a value takes several lines.

    >>> print(inserted("[size]\\nface_width_mm = 18", "size", {"pin_mm": Written(6.0, "rule")}))
    [size]
    face_width_mm = 18
    pin_mm = 6.0  # rule
    <BLANKLINE>
    """
    lines, left = text.rstrip("\n").split("\n"), dict(keys)
    header = re.compile(rf"\s*\[\s*{re.escape(table)}\s*\]\s*(#.*)?")
    start = next((i for i, line in enumerate(lines) if header.fullmatch(line)), len(lines))
    if start == len(lines):
        lines += ["", f"[{table}]"]
        start += 1
    after = range(start + 1, len(lines))
    end = next((i for i in after if lines[i].lstrip().startswith("[")), len(lines))
    for i in range(start + 1, end):
        name = lines[i].partition("=")[0].strip()
        if name in left:
            lines[i] = _with_value(lines[i], left.pop(name).value)
    last = max(i for i in range(start, end) if _is_set(lines[i]))
    more = noted([(f"{key} = {quoted(one.value)}", one.note) for key, one in left.items()])
    lines[last + 1 : last + 1] = more
    out = "\n".join(lines) + "\n"
    try:
        return out if tomli.loads(out) == _wanted(text, table, keys) else None
    except tomli.TOMLDecodeError:
        return None


def _with_value(line: str, value: Any) -> str:
    """Return a line ``key = value  # comment`` with another value."""
    parts = re.fullmatch(r"""([^=]*=\s*)("[^"]*"|'[^']*'|[^"'#]*?)(\s*#.*|\s*)""", line)
    return f"{parts[1]}{quoted(value)}{parts[3]}" if parts else line


def _wanted(text: str, table: str, keys: Mapping[str, Written]) -> dict[str, Any]:
    """Return the tree of a text with these keys."""
    tree = node = tomli.loads(text)
    for name in table.split("."):
        node = node.setdefault(name, {})
    node.update({key: one.value for key, one in keys.items()})
    return tree


def _is_set(line: str) -> bool:
    return bool(line.strip()) and not line.lstrip().startswith("#")
