"""A document as PDF: A4 pages with numbers; a heading is on the page of what follows it."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.answer import FAILS, PASSES, WARNS
from geneva_cli.errors import clean
from geneva_cli.output.document.blocks import (
    Block,
    Curves,
    Document,
    Facts,
    Grid,
    Heading,
    Picture,
    Prose,
    TextList,
)
from geneva_cli.output.document.pdf_table import caption, facts, grid
from geneva_cli.output.letters import western
from geneva_cli.output.pdf import pdf_file
from geneva_cli.output.pdf.pdf_drawing import drawing
from geneva_cli.output.pdf.pdf_pages import (
    AMBER,
    BODY,
    GREEN,
    INK,
    LEADING,
    LEFT,
    LINE,
    RED,
    WIDE,
    Item,
    box,
    lines,
    pages,
    rule,
    words,
)
from geneva_cli.output.plot import plot_pdf

TITLE, HEAD, VERDICT = 6.4, 4.4, 4.2
MARK = 4.0  # before a text of a list


def chunks(document: Document) -> Iterator[str]:
    """The file's text; the same document gives the same bytes."""
    title = clean(document.title)
    yield from pdf_file.pdf_text(title, pages(_items(document), western(title)))


def _items(document: Document) -> Iterator[Item]:
    for text in lines(clean(document.title), TITLE, WIDE, bold=True):
        yield _line(text, TITLE, bold=True)
    yield _gap(2.0, keeps=True)
    ink = {PASSES: GREEN, WARNS: AMBER, FAILS: RED}[document.state]
    for text in lines(document.verdict, VERDICT, WIDE - 2.0 * MARK, bold=True):
        yield _barred(text, VERDICT, ink, bold=True)
    for reason in document.reasons:
        for i, text in enumerate(_wrapped(reason, WIDE - 3.0 * MARK)):
            yield _barred(text, BODY, ink, mark="" if i else "•")
    yield _gap(3.0)
    for block in document.blocks:
        yield from _block(block)


def _block(block: Block) -> Iterator[Item]:
    if isinstance(block, Heading):
        yield _heading(block.text)
    elif isinstance(block, Prose):
        rows = _wrapped(block.text, WIDE)
        for i, text in enumerate(rows):  # no single line of it on a page
            yield _line(text, BODY)._replace(keeps=i in (0, len(rows) - 2))
        yield _gap(2.5)
    elif isinstance(block, TextList):
        yield from _list(block.texts)
    elif isinstance(block, Facts):
        yield from facts(block)
    elif isinstance(block, Grid):
        yield from grid(block)
    elif isinstance(block, Picture):
        yield from caption(block.drawing.title)
        yield drawing(block.drawing)
    else:
        assert isinstance(block, Curves)
        yield from plot_pdf.items(block.figure)


def _wrapped(text: str, width_mm: float) -> list[str]:
    return lines(clean(text), BODY, width_mm)


def _list(texts: tuple[str, ...]) -> Iterator[Item]:
    for text in texts:
        for i, line in enumerate(_wrapped(text, WIDE - MARK)):
            yield _line(line, BODY, indent=MARK, mark="" if i else "•")
        yield _gap(0.8)
    yield _gap(2.0)


def _gap(high: float, keeps: bool = False) -> Item:
    return Item(high, lambda top: "", keeps)


def _line(text: str, size: float, bold: bool = False, indent: float = 0.0, mark: str = "") -> Item:
    def draw(top: float) -> str:
        y = top - size
        before = words(mark, (LEFT + 1.0, y), size) if mark else ""
        return before + words(text, (LEFT + indent, y), size, bold)

    return Item(LEADING * size, draw)


def _heading(text: str) -> Item:
    def draw(top: float) -> str:
        y = top - 4.0 - HEAD
        return words(text, (LEFT, y), HEAD, bold=True) + rule(LEFT, y - 1.7, WIDE, 0.3, LINE)

    return Item(4.0 + HEAD + 4.5, draw, keeps=True)


def _barred(text: str, size: float, ink: str, bold: bool = False, mark: str = "") -> Item:
    """A line of the verdict, or of a reason, with a bar in the verdict's colour."""
    high = LEADING * size
    x = LEFT + MARK + (0.0 if bold else MARK)

    def draw(top: float) -> str:
        y = top - size
        before = words(mark, (LEFT + MARK + 1.0, y), size) if mark else ""
        bar = box(LEFT, top - high, 1.6, high, ink)
        return bar + before + words(text, (x, y), size, bold, ink if bold else INK)

    return Item(high, draw)
