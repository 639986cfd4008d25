"""What the words of the output mean: Markdown beside this file, a heading an entry.

A heading names what it explains, or several names of one thing; a name that begins with a dot is
an ending of others, as ``.max``. A paragraph says what it means, and lines of one label each the
rest: ``Formula:``, ``Unit:`` (where the name's ending does not say it), ``Source:``, ``To do:``
and ``Proof:``, the tests that hold it.
"""

from __future__ import annotations

import os
import re
from functools import cache
from typing import NamedTuple

GROUPS = {  # a file each, and what one of its entries is
    "checks": "check",
    "quantities": "quantity",
    "kinds": "kind",
    "laws": "law",
    "warnings": "warning",
    "parts": "part",
    "choices": "choice",
}
_LABEL = re.compile(r"^(Formula|Unit|Source|To do|Proof): ", re.MULTILINE)


class Entry(NamedTuple):
    """What one file says under one heading; texts without line breaks, "" for what is not said."""

    group: str
    names: tuple[str, ...]
    meaning: str
    formula: str = ""
    unit: str = ""
    source: str = ""
    to_do: str = ""
    proof: str = ""


@cache
def entries() -> tuple[Entry, ...]:
    """All entries, group by group.

    >>> next(e.unit for e in entries() if "power.max" in e.names)
    '1'
    """
    return tuple(entry for group in GROUPS for entry in _read(group))


def _read(group: str) -> list[Entry]:
    place = os.path.join(os.path.dirname(__file__), f"{group}.md")
    with open(place, encoding="utf-8") as file:
        _, *sections = re.split(r"^## ", file.read(), flags=re.MULTILINE)
    return [_entry(GROUPS[group], section) for section in sections]


def _entry(group: str, section: str) -> Entry:
    heading, _, text = section.partition("\n")
    meaning, *rest = _LABEL.split(text)
    said = {
        label.lower().replace(" ", "_"): " ".join(words.split())
        for label, words in zip(rest[::2], rest[1::2], strict=True)
    }
    return Entry(group, tuple(heading.split(", ")), " ".join(meaning.split()), **said)
