"""A4 pages: items of a height, stacked, and page numbers. Millimetres, y up."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

from geneva_cli.output.letters import western
from geneva_cli.output.pdf import pdf_file
from geneva_cli.output.pdf.pdf_file import POINT, Page, number

WIDTH, HEIGHT = 210.0, 297.0
LEFT, TOP, BOTTOM = 16.0, 281.0, 20.0
WIDE = WIDTH - 2.0 * LEFT
BODY, SMALL = 3.4, 2.8  # sizes of letters
LEADING = 1.32  # distance of lines over the letters' size
INK, SOFT, LINE, BAND = "0.1 0.12 0.14", "0.35 0.39 0.43", "0.8 0.83 0.86", "0.95 0.96 0.97"
RED, AMBER, GREEN = "0.7 0.15 0.12", "0.48 0.31 0", "0.1 0.42 0.2"


class Item(NamedTuple):
    """An unbreakable part of a page; ``draw(top)`` are its operators from a height downwards.

    An item that ``keeps`` is on the page of the next one; ``head`` is repeated above it if a page
    begins with it.
    """

    high: float
    draw: Callable[[float], str]
    keeps: bool = False
    head: Item | None = None


def pages(items: Iterable[Item], foot: str) -> list[Page]:
    """Items on as many pages as they need."""
    contents: list[str] = []
    content, y = "", TOP
    for group in _groups(items):
        high = sum(item.high for item in group)
        if content and y - high < BOTTOM:
            contents.append(content)
            content, y = "", TOP
            head = group[0].head
            if head:
                content, y = head.draw(y), y - head.high
        for item in group:
            if content and y - item.high < BOTTOM:  # a group higher than a page
                contents.append(content)
                content, y = "", TOP
            content += item.draw(y)
            y -= item.high
    contents.append(content)
    return [_page(text, f"{i} / {len(contents)}", foot) for i, text in enumerate(contents, 1)]


def _groups(items: Iterable[Item]) -> Iterator[list[Item]]:
    group: list[Item] = []
    for item in items:
        group.append(item)
        if not item.keeps:
            yield group
            group = []
    if group:
        yield group


def _page(content: str, which: str, foot: str) -> Page:
    begin = f"{POINT:.9f} 0 0 {POINT:.9f} 0 0 cm\n1 J 1 j\n"
    low = 11.0
    name = fitting(foot, SMALL, WIDE - 30.0)
    end = words(name, (LEFT, low), SMALL, ink=SOFT)
    end += words(which, (LEFT + WIDE - wide(which, SMALL), low), SMALL, ink=SOFT)
    return Page(WIDTH, HEIGHT, begin + content + end, fonts=2)


def words(
    text: str,
    at: tuple[float, float],
    size: float,
    bold: bool = False,
    ink: str = INK,
    turn: float = 0,
) -> str:
    """A coloured text that starts at a point on its base line."""
    return f"{ink} rg\n" + pdf_file.text(western(text), at, size, turn, 2 if bold else 1)


def rule(x: float, y: float, long: float, width: float = 0.15, ink: str = LINE) -> str:
    """A horizontal line."""
    ends = f"{number(x)} {number(y)} m {number(x + long)} {number(y)} l"
    return f"{ink} RG {number(width)} w [] 0 d {ends} S\n"


def box(x: float, y: float, long: float, high: float, ink: str) -> str:
    """A filled rectangle up from its lower left corner."""
    return f"{ink} rg {number(x)} {number(y)} {number(long)} {number(high)} re f\n"


def wide(text: str, size: float, bold: bool = False) -> float:
    """A text's width."""
    return pdf_file.wide(western(text), size, bold)


def lines(text: str, size: float, width_mm: float, bold: bool = False) -> list[str]:
    """A text broken into lines that fit a width; a longer word is cut."""
    out: list[str] = []
    line = ""
    for word in filter(None, text.split(" ")):
        whole = f"{line} {word}" if line else word
        if wide(whole, size, bold) <= width_mm:
            line = whole
            continue
        if line:
            out.append(line)
        while wide(word, size, bold) > width_mm and len(word) > 1:
            fits = _fits(word, size, width_mm, bold)
            out.append(word[:fits])
            word = word[fits:]
        line = word
    return [*out, line] if line or not out else out


def fitting(text: str, size: float, width_mm: float) -> str:
    """The beginning of a text that fits a width."""
    return (
        text
        if wide(text, size) <= width_mm
        else text[: _fits(text, size, width_mm, False) - 1] + "…"
    )


def _fits(word: str, size: float, width_mm: float, bold: bool) -> int:
    """The number of letters that fit, up to a sign such as an underscore if one is near the end."""
    many = 1
    while many < len(word) and wide(word[: many + 1], size, bold) <= width_mm:
        many += 1
    place = max(word.rfind(sign, 1, many) for sign in "_./-") + 1
    return place if place > 0.4 * many else many
