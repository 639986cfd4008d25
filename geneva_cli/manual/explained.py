"""Entries of the reference pages: what each word of the output means.

A ``## `` heading names what an entry explains, or several names of one thing; a name that begins
with a dot is an ending of others, as ``.max``. The first paragraph is the meaning. Items with a
label have the fields: ``- Formula: ...``. An entry without ``See`` has the links of the last one
whose name begins with the same word.
"""

import re
from functools import cache
from typing import NamedTuple

from geneva_cli.manual import read

GROUPS = {  # a page each, and what one of its entries is
    "checks": "check",
    "quantities": "quantity",
    "kinds": "kind",
    "laws": "law",
    "warnings": "warning",
    "parts": "part",
    "choices": "choice",
}

ITEM = r"^- ([A-Z][a-z ]*): (.*(?:\n  .*)*)"  # a label and its text, with indented lines


class Entry(NamedTuple):
    """One heading of a page and its texts, without line breaks; "" for what a page leaves out."""

    page: str
    names: tuple[str, ...]
    meaning: str
    formula: str = ""
    unit: str = ""
    source: str = ""
    to_do: str = ""
    see: str = ""  # links to other pages

    @property
    def group(self) -> str:
        """The kind of thing that is explained."""
        return GROUPS[self.page]

    @property
    def topics(self) -> tuple[str, ...]:
        """Pages of the manual that have it: its own, then those for the reasons."""
        return (self.page, *re.findall(r"\[([a-z-]+)\]\([^)]*\)", self.see))


@cache
def entries() -> tuple[Entry, ...]:
    """All entries, page by page.

    >>> next(e.unit for e in entries() if "power.max" in e.names)
    '1'
    """
    out = []
    for page in GROUPS:
        links = dict[str, str]()  # those of the last entry, by the first word of its name
        for section in re.split(r"^## ", text(page), flags=re.MULTILINE)[1:]:
            heading, _, body = section.partition("\n")
            names, meaning = tuple(heading.split(", ")), body.strip().partition("\n\n")[0]
            texts = dict[str, str]()
            for label, words in re.findall(ITEM, body, re.MULTILINE):
                texts[label.lower().replace(" ", "_")] = " ".join(words.split()).strip("`")
            word = names[0].partition(".")[0]
            links[word] = texts["see"] = texts.get("see") or links.get(word, "")
            out.append(Entry(page, names, " ".join(meaning.split()), **texts))
    return tuple(out)


def text(page: str) -> str:
    """Text of a page without pictures; that of quantities is printed as a table."""
    return read("quantities.txt") if page == "quantities" else read("reference", f"{page}.md")
