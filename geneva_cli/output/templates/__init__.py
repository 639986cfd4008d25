"""Texts that lie beside the code as files, with places to be filled."""

import os
import re


def template(name: str) -> str:
    """The text of a file, by its path in this folder."""
    with open(os.path.join(os.path.dirname(__file__), name), encoding="utf-8") as file:
        return file.read()


def filled(name: str, parts: dict[str, str]) -> str:
    """The text of a file with a part in place of each ``%NAME%``, in one pass.

    So a title with the name of another part is not replaced.
    """
    return re.sub("%([A-Z]+)%", lambda place: parts[place[1]], template(name))
