"""Line numbers of keys in a spec's text, determined by the TOML reader itself."""

from __future__ import annotations

import re
from itertools import islice
from typing import Any

import tomli


def line_of(text: str, path: tuple[str | int, ...]) -> int:
    """Line on which a key (or else its table) is set; 0 if it is not set.

    The key's line is the first after which the text so far parses and contains the key. Only lines
    that look like setting it are tried. A number in the path counts the tables of a list, from 0.
    """
    lines = text.split("\n")
    while path:
        before = sum(part for part in path if isinstance(part, int))  # tables that may set it too
        name = re.escape(next((p for p in reversed(path) if isinstance(p, str)), ""))
        sets = re.compile(rf"""(^|[\s.,{{\["']){name}["']?\s*[=.\]]""")
        likely = (
            i for i, x in enumerate(lines) if sets.search(x) and not x.lstrip().startswith("#")
        )
        for i in islice(likely, 10 + before):  # else its table is named
            if _holds(lines, i + 1, path):
                return i + 1
        path = path[:-1]
    return 0


def _holds(lines: list[str], end: int, path: tuple[str | int, ...]) -> bool:
    """True if the lines up to the end of the value that starts on line ``end`` set the key."""
    more = 0
    while True:
        try:
            node: Any = tomli.loads("\n".join(lines[: end + more]))
            break
        except (ValueError, RecursionError):
            if end + more >= len(lines):
                return False
            more = 2 * more + 1  # a value of many lines
    for part in path:
        if isinstance(part, int):
            node = node[part] if isinstance(node, list) and part < len(node) else None
        else:
            node = node.get(part) if isinstance(node, dict) else None
    return node is not None
