"""A document as one self-contained page of HTML: no script, no network, no font."""

import base64
from collections.abc import Iterable, Iterator
from html import escape

from geneva_cli.errors import clean
from geneva_cli.output import svg
from geneva_cli.output.document import blocks
from geneva_cli.output.plot import plot_svg
from geneva_cli.output.templates import filled, template
from geneva_cli.output.terminal.summary import SIGNS

NUMBER = ' class="n"'
LONG = 36  # letters; a longer value is broken into lines, from the left


def chunks(document: blocks.Document) -> Iterator[str]:
    """The page's text; the same document gives the same bytes."""
    parts = {"TITLE": _text(document.title), "STYLE": template("report.css")}
    parts |= {"STATE": document.state, "SIGN": SIGNS[document.state]}
    parts |= {"VERDICT": _text(document.verdict), "REASONS": "".join(_list(document.reasons))}
    parts["CONTENT"] = "".join(_content(document.blocks))
    yield filled("report.html", parts)


def _content(every: Iterable[blocks.Block]) -> Iterator[str]:
    is_open = False  # facts side by side
    for block in every:
        if (isinstance(block, blocks.Grid) and block.facts) != is_open:
            yield "</div>\n" if is_open else '<div class="facts">\n'
            is_open = not is_open
        yield from _block(block)
    yield "</div>\n" if is_open else ""


def _block(block: blocks.Block) -> Iterator[str]:
    if isinstance(block, blocks.Heading):
        yield f"<h2>{_text(block.text)}</h2>\n"
    elif isinstance(block, blocks.Prose):
        yield f"<p>{_text(block.text)}</p>\n"
    elif isinstance(block, blocks.TextList):
        yield from _list(block.texts)
    elif isinstance(block, blocks.Grid):
        yield from _grid(block)
    elif isinstance(block, blocks.Picture):
        yield from _figure("drawing", block.drawing.title, svg.chunks(block.drawing))
    elif isinstance(block, blocks.Curves):
        yield from _figure("curves", block.figure.title, plot_svg.chunks(block.figure))


def _figure(name: str, title: str, chunks: Iterable[str]) -> Iterator[str]:
    """A picture as a part of the page, whose names and styles are its own."""
    data = base64.b64encode("".join(chunks).encode()).decode()
    yield f'<figure class="{name}" tabindex="0">\n<img alt="{_text(title)}"'
    yield f' src="data:image/svg+xml;base64,{data}">\n</figure>\n'


def _grid(grid: blocks.Grid) -> Iterator[str]:
    rows = blocks.texts(grid)
    columns = zip(blocks.right_aligned(grid), zip(*rows, strict=True), strict=True)
    sides = [NUMBER if right else ' class="s"' * blocks.is_short(cells) for right, cells in columns]
    heads = "".join(
        f'<th scope="col"{side if side == NUMBER else ""}>{_text(head)}</th>'
        for head, side in zip(grid.heads, sides, strict=True)
    )
    head = f"<thead><tr>{heads}</tr></thead>\n" if any(grid.heads) else ""
    wide = " wide" if len(grid.heads) > 4 else ""  # four columns fit on a phone
    yield "" if grid.facts else f'<div class="grid{wide}" tabindex="0">\n'
    yield f"<table>\n<caption>{_text(grid.caption)}</caption>\n{head}<tbody>\n"
    for first, *rest in rows:
        yield f'<tr><th scope="row">{_text(first)}</th>'
        for value, side in zip(rest, sides[1:], strict=True):
            attribute = side if len(value) <= LONG else ""
            attribute = ' class="bad"' if value == blocks.BAD else attribute
            yield f"<td{attribute}>{_text(value)}</td>"
        yield "</tr>\n"
    yield "</tbody>\n</table>\n" + ("" if grid.facts else "</div>\n")


def _list(texts: tuple[str, ...]) -> Iterator[str]:
    if texts:
        yield "<ul>\n" + "".join(f"<li>{_text(text)}</li>\n" for text in texts) + "</ul>\n"


def _text(text: str) -> str:
    return escape(clean(text))
