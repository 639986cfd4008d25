"""Keys that are written into the text of a spec, whose comments and order stay."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import tomli

from geneva_cli.specfile.writer import noted, quoted


def inserted(text: str, table: str, keys: Mapping[str, tuple[Any, str]]) -> str | None:
    """Return a spec's text with more keys in one table: a value and a note each.

    They stand behind the table's own last key, or in a table at the end of the text. Returns None
    for a text in which the table has no line of its own, as in ``size = {pin_mm = 6}``.

    >>> print(inserted("[size]\\nface_width_mm = 18", "size", {"pin_mm": (6.0, "default r")}))
    [size]
    face_width_mm = 18
    pin_mm = 6.0  # default r
    <BLANKLINE>
    """
    lines = text.rstrip("\n").split("\n")
    more = noted([(f"{key} = {quoted(value)}", why) for key, (value, why) in keys.items()])
    header = re.compile(rf"\s*\[\s*{re.escape(table)}\s*\]\s*(#.*)?")
    start = next((i for i, line in enumerate(lines) if header.fullmatch(line)), None)
    if start is None:
        lines += ["", f"[{table}]", *more]
    else:
        after = range(start + 1, len(lines))
        end = next((i for i in after if lines[i].lstrip().startswith("[")), len(lines))
        last = max(i for i in range(start, end) if _is_set(lines[i]))
        lines[last + 1 : last + 1] = more
    out = "\n".join(lines) + "\n"
    wanted = tomli.loads(text)
    wanted[table] = {**wanted.get(table, {}), **{key: value for key, (value, _) in keys.items()}}
    try:
        return out if tomli.loads(out) == wanted else None
    except tomli.TOMLDecodeError:
        return None


def _is_set(line: str) -> bool:
    return bool(line.strip()) and not line.lstrip().startswith("#")
