"""Columns side by side in a window: widths, omitted columns, and lines.

Nothing is cut: a number keeps its width, and text is broken between words only.
"""

import os
import re
import shutil
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

from geneva_cli.errors import clean
from geneva_cli.output.text import GAP, WIDTH, cell, line_of, width_of
from geneva_cli.table import for_people

BOLD, DIM, PLAIN = "\x1b[1m", "\x1b[2m", "\x1b[0m"
READABLE = 100  # letters of the longest line of prose that is easy to read
PROSE = 28  # letters to which a column of prose is narrowed before another column is omitted


class Window(NamedTuple):
    """The width of lines in letters, the look of letters, and the options for all columns.

    A ``whole`` table has every column, constant ones too; a ``wide`` one exceeds the window.
    Letters may be ``styled``, as bold ones.
    """

    columns: int
    styled: bool = False
    whole: bool = False
    wide: bool = False


def window(whole: bool, is_wide: bool) -> Window:
    """The window of standard output; COLUMNS has precedence over the terminal's own width."""
    styled = os.environ.get("TERM", "dumb") != "dumb" and not os.environ.get("NO_COLOR")
    # A window of fewer than 60 columns breaks lines itself.
    columns = max(shutil.get_terminal_size().columns, 60)
    return Window(columns, styled, whole or is_wide, is_wide)


def styled(text: str, style: str, is_styled: bool) -> str:
    """A text in a style such as bold, if the terminal supports it; an empty one stays empty."""
    return f"{style}{text}{PLAIN}" if is_styled and style and text else text


class ShownColumn(NamedTuple):
    """A column as a person reads it: heading, unit below it, and cells as text."""

    name: str
    words: str
    unit: str
    cells: Sequence[str]
    is_text: bool
    decides: bool = False  # it is never left out

    def least(self, prose: int = PROSE) -> int:
        """Least width in letters to which it can be narrowed; of prose at least ``prose``."""
        if not (self.is_text and any(" " in text for text in self.cells)):
            return self.natural()
        prose = min(prose, 12) if self.decides else prose
        return max([min(self.natural(), prose), *map(width_of, self._words())])

    def natural(self) -> int:
        """Width in letters of its longest cell, and of its heading broken between words."""
        return max([width_of(text) for text in (*self._words(), *self.cells)], default=0)

    def _words(self) -> list[str]:
        cells = [word for text in self.cells for word in text.split()] if self.is_text else []
        return [*self.words.split(), self.unit, *cells]


def wrapped(
    text: str,
    width: float,
    measure: Callable[[str], float] = width_of,
    breaks: str = r"(?<=[/,=])|(?<=::)",
) -> list[str]:
    """A text in lines of at most ``width``, broken between words.

    A longer word stays whole, but for a path or a list, which is broken behind a sign.

    >>> wrapped("a long text", 6)
    ['a long', 'text']
    """
    if measure(text) <= width:
        return [text]
    lines: list[str] = []
    line: str | None = None
    for word in text.split(" "):
        parts = [word]
        if measure(word) > width:
            parts = re.split(breaks, word)
        for i, part in enumerate(parts):
            longer = part if line is None else line + " " * (i == 0) + part
            if line is not None and measure(longer) > width:
                lines += [line.rstrip()] if line.strip() else []
                longer = part
            line = longer
    return [*lines, line or ""]


def paragraphs(text: str, window: Window, style: str = "") -> Iterator[str]:
    """The lines of a text of one or more paragraphs."""
    for paragraph in text.split("\n") if text else ():
        for line in wrapped(clean(paragraph), min(window.columns, WIDTH)):
            yield styled(line, style, window.styled)


def widths(columns: Sequence[ShownColumn], width: int, prose: int = PROSE) -> list[int] | None:
    """The columns' widths, the widest prose narrowed first; None if they exceed ``width``."""
    sizes = [column.natural() for column in columns]
    spare = width - len(GAP) * (len(columns) - 1) - sum(sizes)
    if spare >= 0:
        return sizes
    least = [column.least(prose) for column in columns]
    if sum(least) - sum(sizes) > spare:
        return None
    while spare < 0:
        widest = max((i for i, w in enumerate(sizes) if w > least[i]), key=lambda i: sizes[i])
        sizes[widest] -= 1
        spare += 1
    return sizes


def fitting(
    columns: Sequence[ShownColumn], order: Sequence[str], width: int
) -> tuple[list[ShownColumn], list[int]]:
    """The columns that fit, the first of ``order`` kept the longest, and their widths."""
    kept = list(columns)
    while True:
        others = [column for column in kept if not column.decides and column.name != order[0]]
        sizes = widths(kept, width, PROSE if len(others) > 1 else 18)
        if sizes is not None or not others:
            return kept, sizes or [column.least(PROSE) for column in kept]
        kept.remove(max(others, key=lambda column: order.index(column.name)))


def heads(columns: Sequence[ShownColumn], sizes: Sequence[int], is_styled: bool) -> Iterator[str]:
    """The lines of the headings, directly above the units."""
    texts = [wrapped(column.words, size) for column, size in zip(columns, sizes, strict=True)]
    high = max(map(len, texts))
    is_text = [column.is_text for column in columns]
    for line in zip(*([""] * (high - len(text)) + text for text in texts), strict=True):
        yield styled(line_of(line, sizes, is_text), BOLD, is_styled)
    if any(column.unit for column in columns):
        units = [column.unit for column in columns]
        yield styled(line_of(units, sizes, is_text), DIM, is_styled)


def row(texts: Sequence[str], sizes: Sequence[int], is_text: Sequence[bool]) -> Iterator[str]:
    """The lines of a row, one except for prose."""
    cells = [wrapped(text, size) for text, size in zip(texts, sizes, strict=True)]
    for level in range(max(map(len, cells))):
        yield line_of([cell[level] if level < len(cell) else "" for cell in cells], sizes, is_text)


def value(number: Any, unit: str = "") -> str:
    """A value for people at a terminal, with its unit.

    >>> value(34.733492, "N m"), value(53173000.0), value(2.8e8, "h")
    ('34.73 N m', '5.317e7', 'practically unlimited')
    """
    return with_unit(bare(number, unit), unit)


def with_unit(text: str, unit: str) -> str:
    """A number with its unit; words stand alone."""
    return f"{text} {unit}" if unit and text[-1:].isdigit() else text


def bare(number: Any, unit: str) -> str:
    """A value without its unit, which identifies times too long to be meaningful."""
    if not isinstance(number, float):
        return cell(number)
    # A life of more than 114 years of running day and night is meaningless.
    if unit == "h" and number > 1e6:
        return "practically unlimited"
    digits, e, power = for_people(number, unit).partition("e")
    return f"{digits}e{int(power)}" if e else digits
