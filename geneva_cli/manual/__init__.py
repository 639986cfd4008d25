"""The manual: a page of Markdown for each topic, in a folder for each kind of page.

A new page is a file, and a line in contents.txt. ``cli.pages`` prints those of reference that have
no file.
"""

import os
import re


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
