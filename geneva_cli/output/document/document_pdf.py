"""A document as PDF: A4 pages with numbers; a heading is on the page of what follows it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from typing import NamedTuple

from geneva_cli.answer import FAILS, NO_BREAK, PASSES, WARNS
from geneva_cli.errors import clean
from geneva_cli.geometry.shapes import Point, Shape, placed
from geneva_cli.geometry.sheet import Annotations, Drawing, extent, prepared
from geneva_cli.output import pdf
from geneva_cli.output.document import blocks
from geneva_cli.output.inks import CENTRE_LINES, INKS, LIGHT
from geneva_cli.output.letters import western
from geneva_cli.output.notes import LETTERS, notes
from geneva_cli.output.plot import plot_layout, plot_pdf
from geneva_cli.output.svg import rings, tint
from geneva_cli.output.terminal.layout import wrapped

WIDTH, HEIGHT = 210.0, 297.0
LEFT, TOP, BOTTOM = 16.0, 281.0, 20.0
WIDE = WIDTH - 2.0 * LEFT
TITLE, HEAD, VERDICT, BODY, SMALL = 6.4, 4.4, 4.2, 3.4, 2.8  # sizes of letters
LEADING = 1.32  # distance of lines over the letters' size
MARK = 4.0  # before a text of a list
PAD = 1.3  # left and right of a cell's text
SPACE = 0.55  # above and below it
STEP = LEADING * SMALL
# in a word longer than a line: behind a sign, and behind any letter from the 24th on
BREAKS = r"(?<=[_./-])|(?<=\w{24})"
SOFT, LINE, BAND = "0.35 0.39 0.43", "0.8 0.83 0.86", "0.95 0.96 0.97"
RED, AMBER, GREEN = "0.7 0.15 0.12", "0.48 0.31 0", "0.1 0.42 0.2"


class Item(NamedTuple):
    """An unbreakable part of a page: its height, and its operators from the height 0 downwards.

    An item that ``keeps`` is on the page of the next one; ``head`` is repeated above it if a page
    begins with it.
    """

    high: float
    content: str = ""
    keeps: bool = False
    head: Item | None = None


def chunks(document: blocks.Document) -> Iterator[str]:
    """Yield the file's text; the same document gives the same bytes."""
    title = clean(document.title)
    yield from pdf.pdf_text(title, _pages(_items(document), western(title)))


def _pages(items: Iterable[Item], foot: str) -> list[pdf.Page]:
    """Return items on as many A4 pages as they need, numbered."""
    contents, y, group = [""], TOP, list[Item]()
    for item in items:
        group.append(item)
        if item.keeps:
            continue
        if contents[-1] and y - sum(one.high for one in group) < BOTTOM:
            contents.append("")
            y = TOP
            group[:0] = [head] if (head := group[0].head) else []
        for one in group:
            contents[-1] += pdf.moved(one.content, 0.0, y)
            y -= one.high
        group = []
    out, low = [], 11.0
    if pdf.wide(foot, SMALL) > WIDE - 30.0:
        foot = _lines(foot, SMALL, WIDE - 34.0)[0] + " …"
    for i, text in enumerate(contents, 1):
        which = f"{i} / {len(contents)}"
        end = pdf.words(foot, (LEFT, low), SMALL, ink=SOFT)
        end += pdf.words(which, (LEFT + WIDE - pdf.wide(which, SMALL), low), SMALL, ink=SOFT)
        out.append(pdf.Page(WIDTH, HEIGHT, pdf.BEGIN + text + end))
    return out


def _items(document: blocks.Document) -> Iterator[Item]:
    for text in _lines(document.title, TITLE, WIDE, bold=True):
        yield _line(text, TITLE, bold=True)
    yield Item(2.0, keeps=True)
    ink = {PASSES: GREEN, WARNS: AMBER, FAILS: RED}[document.state]
    for text in _lines(document.verdict, VERDICT, WIDE - 2.0 * MARK, bold=True):
        yield _line(text, VERDICT, bold=True, indent=MARK, ink=ink, bar=ink)
    for reason in document.reasons:
        for i, text in enumerate(_lines(reason, BODY, WIDE - 3.0 * MARK)):
            yield _line(text, BODY, indent=2.0 * MARK, mark="" if i else "•", bar=ink)
    yield Item(3.0)
    for block in document.blocks:
        yield from _block(block)


def _block(block: blocks.Block) -> Iterator[Item]:
    if isinstance(block, blocks.Heading):
        y = -4.0 - HEAD
        text = pdf.words(block.text, (LEFT, y), HEAD, bold=True)
        yield Item(8.5 + HEAD, text + _rule(LEFT, y - 1.7, WIDE, 0.3), keeps=True)
    elif isinstance(block, blocks.Prose):
        rows = _lines(block.text, BODY, WIDE)
        for i, text in enumerate(rows):  # no single line of it on a page
            yield _line(text, BODY)._replace(keeps=i in (0, len(rows) - 2))
        yield Item(2.5)
    elif isinstance(block, blocks.TextList):
        for text in block.texts:
            for i, line in enumerate(_lines(text, BODY, WIDE - MARK)):
                yield _line(line, BODY, indent=MARK, mark="" if i else "•")
            yield Item(0.8)
        yield Item(2.0)
    elif isinstance(block, blocks.Grid):
        yield from _grid(block)
    elif isinstance(block, blocks.Picture):
        yield from _caption(block.drawing.title)
        yield _drawing(block.drawing)
    elif isinstance(block, blocks.Curves):
        scale, parts = WIDE / plot_layout.PAGE, list(plot_layout.blocks(block.figure))
        for i, part in enumerate(parts):  # no title and no last panel stands alone
            content = pdf.moved(plot_pdf.drawn(part), LEFT, 0.0, scale)
            yield Item(scale * part.high, content, keeps=i in (0, len(parts) - 2))


def _line(
    text: str,
    size: float,
    bold: bool = False,
    indent: float = 0.0,
    mark: str = "",
    ink: str = pdf.INK,
    bar: str = "",
) -> Item:
    """A line of text behind a mark, and a ``bar`` of a colour at the left edge."""
    high = LEADING * size
    content = pdf.box(LEFT, -high, 1.6, high, bar) if bar else ""
    content += pdf.words(mark, (LEFT + indent - MARK + 1.0, -size), size) if mark else ""
    return Item(high, content + pdf.words(text, (LEFT + indent, -size), size, bold, ink))


def _grid(table: blocks.Grid) -> Iterator[Item]:
    """Yield a table with a head, which is repeated on each page; facts in two columns."""
    right, rows, heads = blocks.right_aligned(table), blocks.texts(table), table.heads
    if table.facts:
        half = (len(rows) + 1) // 2
        pairs = zip_longest(rows[:half], rows[half:], fillvalue=["", ""])
        rows, right = [[*one, "", *other] for one, other in pairs], [*right, False, *right]
        widths = [part * WIDE for part in (0.31, 0.17, 0.04, 0.31, 0.17)]
    else:
        short = [blocks.is_short(column) for column in zip(*rows, strict=True)]
        rows = [
            [text.replace(" ", NO_BREAK) if s else text for text, s in zip(row, short, strict=True)]
            for row in rows
        ]
        widths = _widths(heads, rows)
    head = _row(heads, right, widths, bold=True) if any(heads) else None
    yield from _caption(table.caption)
    if head:
        yield head._replace(keeps=True)
    for row in rows:
        yield _row(row, right, widths)._replace(head=head)
    yield Item(4.0)


def _caption(text: str) -> Iterator[Item]:
    """Yield the line above a table or a picture; nothing without a text."""
    if text:
        line = _line(text, SMALL, bold=True, ink=SOFT)
        yield line._replace(high=line.high + 1.4, keeps=True)


def _widths(heads: Sequence[str], rows: list[list[str]]) -> list[float]:
    """The columns' widths: those that they want, or fractions above their longest words."""
    needs, wants = [], []
    whole_word = 42.0  # the longest word that stays whole
    head_max = 30.0  # width of a head before it breaks
    for head, *cells in zip(heads, *rows, strict=True):
        words = [pdf.wide(word, SMALL, True) for word in head.split()]
        words += [pdf.wide(word, SMALL) for cell in cells for word in cell.split(" ")]
        lines = [min(pdf.wide(head, SMALL, True), head_max), *(pdf.wide(c, SMALL) for c in cells)]
        needs.append(min(max(words), whole_word) + 2.0 * PAD)
        wants.append(max(*words, *lines) + 2.0 * PAD)
    more, left = sum(wants) - sum(needs), WIDE - sum(needs)
    if left < 0.0:
        return [need * WIDE / sum(needs) for need in needs]
    fraction = min(1.0, left / more) if more > 0.0 else 0.0
    return [need + fraction * (want - need) for need, want in zip(needs, wants, strict=True)]


def _row(
    texts: Sequence[str], right: Sequence[bool], widths: Sequence[float], bold: bool = False
) -> Item:
    cells = [
        _lines(text, SMALL, long - 2.0 * PAD + 1e-6, bold)
        for text, long in zip(texts, widths, strict=True)
    ]
    high, x = max(map(len, cells)) * STEP + 2.0 * SPACE, LEFT
    out = pdf.box(LEFT, -high, sum(widths), high, BAND) if bold else ""
    for cell, is_right, long in zip(cells, right, widths, strict=True):
        ink, heavy = (RED, True) if cell == [blocks.BAD] else (pdf.INK, bold)
        for i, text in enumerate(cell):
            at = x + (long - PAD - pdf.wide(text, SMALL, heavy) if is_right else PAD)
            out += pdf.words(text, (at, -SPACE - 0.95 * SMALL - i * STEP), SMALL, heavy, ink)
        x += long
    return Item(high, out + _rule(LEFT, -high, sum(widths)))


def _drawing(drawn: Drawing) -> Item:
    """Return a drawing at the largest scale, centred: tinted plates, inked lines, and notes."""
    margin, tall_max = 3.0, 92.0  # mm: round the shapes, and their greatest height
    shown = prepared(drawn)
    look, around_shapes = shown.look or Annotations(), extent(shown)
    # notes add little to a drawing's width, and its arrows of rotation may add much
    around = notes(Annotations(turns=look.turns), around_shapes, "", 0.0).box
    across, tall = around.x1 - around.x0, around.y1 - around.y0
    scale = min((WIDE - 2.0 * margin) / across, tall_max / tall)
    noted = notes(look, around_shapes, "", SMALL / LETTERS / scale)

    def scaled(p: Point) -> Point:
        return scale * p[0], scale * p[1]

    def traced(shape: Shape) -> str:
        return pdf.outline(placed(shape, scale=scale))

    out = ""
    for layer, contours in rings(shown.solid) if shown.solid else []:
        out += f"{pdf.colour(tint(layer, LIGHT))} rg\n"
        out += "".join(map(traced, contours)) + "f*\n"
    for name in shown.layers:
        is_thin = name in CENTRE_LINES
        out += f"{pdf.colour(INKS[name].rgb)} RG {0.16 if is_thin else 0.3} w"
        out += f" [{'4 0.8 0.8 0.8' if is_thin else ''}] 0 d\n"
        out += "".join(f"{traced(shape)}S\n" for shape in shown.shapes if shape.layer == name)
    out += f"{SOFT} RG {SOFT} rg 0.16 w [] 0 d\n"
    out += "".join(f"{traced(one)}S\n" for one in (*noted.lines, *noted.scale_bar))
    out += "".join(pdf.triangle([*map(scaled, head.corners)]) for head in noted.heads)
    out += "".join(pdf.words(text, scaled(place), SMALL) for place, text in noted.texts)
    left = LEFT + 0.5 * (WIDE - scale * across) - scale * around.x0
    content = pdf.moved(out, left, -margin - scale * around.y1)
    return Item(scale * (noted.box.y1 - noted.box.y0) + 2.0 * margin, content)


def _rule(x: float, y: float, long: float, width: float = 0.15) -> str:
    """A horizontal line."""
    ends = f"{pdf.number(x)} {pdf.number(y)} m {pdf.number(x + long)} {pdf.number(y)} l"
    return f"{LINE} RG {pdf.number(width)} w [] 0 d {ends} S\n"


def _lines(text: str, size: float, width_mm: float, bold: bool = False) -> list[str]:
    """A text broken into lines that fit a width."""
    return wrapped(clean(text), width_mm, lambda part: pdf.wide(part, size, bold), BREAKS)
