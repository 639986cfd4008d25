"""The window of a terminal: its width, and text in it."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.errors import clean
from geneva_cli.output.terminal.layout import styled, wrapped
from geneva_cli.output.text import WIDTH


class Window(NamedTuple):
    """The width of lines in letters, the look of letters, and the options for all columns.

    A ``whole`` table has every column, constant ones too; a ``wide`` one exceeds the window.
    Letters may be ``styled``, as bold ones, and without ``unicode`` they are ASCII.
    """

    columns: int
    styled: bool = False
    whole: bool = False
    wide: bool = False
    unicode: bool = True


def window(whole: bool, is_wide: bool) -> Window:
    """The window of standard output; COLUMNS has precedence over the terminal's own width."""
    styled = os.environ.get("TERM", "dumb") != "dumb" and not os.environ.get("NO_COLOR")
    # A window of fewer than 60 columns breaks lines itself.
    columns = max(shutil.get_terminal_size().columns, 60)
    return Window(columns, styled, whole or is_wide, is_wide)


def paragraphs(text: str, window: Window, style: str = "") -> Iterator[str]:
    """The lines of a text of one or more paragraphs."""
    for paragraph in text.split("\n") if text else ():
        for line in wrapped(clean(paragraph), min(window.columns, WIDTH)):
            yield styled(line, style, window.styled)
