"""The manual: a page of Markdown for each topic, and the entries of its reference pages.

A new page is a file in the folder of its kind, and a line in contents.txt. ``cli.pages`` prints
those of reference that have no file.

An entry says what a word of the output means. A ``## `` heading names what it explains, or several
names of one thing; a name that begins with a dot is an ending of others, as ``.max``. The first
paragraph is the meaning. Items with a label have the fields: ``- Formula: ...``. An entry without
``See`` has the links of the last one whose name begins with the same word.
"""

import os
import re
from functools import cache
from typing import NamedTuple


def read(*place: str) -> str:
    """A text in this folder, without its pictures.

    >>> read("contents.txt").startswith("## ")
    True
    """
    with open(os.path.join(os.path.dirname(__file__), *place), encoding="utf-8") as file:
        return re.sub(r"<img [^>]*>(<br>|\n)?", "", file.read())


# The pages of each kind (https://diataxis.fr), and what they are about
GROUPS: dict[str, dict[str, str]] = {
    section.partition("\n")[0]: dict(re.findall("^- (.*?): (.*)", section, re.MULTILINE))
    for section in read("contents.txt").split("## ")[1:]
}
TOPICS = {topic: about for pages in GROUPS.values() for topic, about in pages.items()}


def path(topic: str) -> str:
    """File of a topic's page, where it has one."""
    group = next(group for group, pages in GROUPS.items() if topic in pages)
    folder = group.partition(":")[0].lower().replace("-", "")
    return os.path.join(os.path.dirname(__file__), folder, f"{topic}.md")


def page(topic: str) -> str:
    """A topic's page as Markdown, from its file; without its pictures.

    >>> page("symbols").splitlines()[0]
    '# Symbols and conventions'
    """
    return read(path(topic))


ENTRIES = {  # a page each, and what one of its entries is
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
        return ENTRIES[self.page]

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
    for page in ENTRIES:
        links = dict[str, str]()  # those of the last entry, by the first word of its name
        for section in re.split(r"^## ", source(page), flags=re.MULTILINE)[1:]:
            heading, _, body = section.partition("\n")
            names, meaning = tuple(heading.split(", ")), body.strip().partition("\n\n")[0]
            texts = dict[str, str]()
            for label, words in re.findall(ITEM, body, re.MULTILINE):
                texts[label.lower().replace(" ", "_")] = " ".join(words.split()).strip("`")
            word = names[0].partition(".")[0]
            links[word] = texts["see"] = texts.get("see") or links.get(word, "")
            out.append(Entry(page, names, " ".join(meaning.split()), **texts))
    return tuple(out)


def source(topic: str) -> str:
    """Text of a page with entries; that of quantities is printed as a table."""
    return read("quantities.txt") if topic == "quantities" else page(topic)
