"""A document as PDF: A4 pages with numbers; a heading is on the page of what follows it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geneva_cli.answer import FAILS, NO_BREAK, PASSES, WARNS, value_text
from geneva_cli.errors import clean
from geneva_cli.geometry.shapes import ORIGIN, Point, Shape, placed
from geneva_cli.geometry.sheet import Annotations, Drawing, extent, prepared
from geneva_cli.output.document.blocks import (
    BAD,
    Block,
    Curves,
    Document,
    Facts,
    Grid,
    Heading,
    Picture,
    Prose,
    TextList,
    is_number,
    is_short,
    texts,
)
from geneva_cli.output.inks import CENTRE_LINES, inks
from geneva_cli.output.letters import western
from geneva_cli.output.notes import LETTERS, notes
from geneva_cli.output.pdf import (
    AMBER,
    BAND,
    BODY,
    GREEN,
    INK,
    LEADING,
    LEFT,
    LINE,
    RED,
    SMALL,
    SOFT,
    WIDE,
    Item,
    box,
    lines,
    outline,
    pages,
    pdf_text,
    rule,
    tint,
    triangle,
    wide,
    words,
)
from geneva_cli.output.plot import plot_pdf
from geneva_cli.output.svg import opacity, rings

TITLE, HEAD, VERDICT = 6.4, 4.4, 4.2
MARK = 4.0  # before a text of a list
PAD = 1.3  # left and right of a cell's text
SPACE = 0.55  # above and below it
STEP = LEADING * SMALL


def chunks(document: Document) -> Iterator[str]:
    """Yield the file's text; the same document gives the same bytes."""
    title = clean(document.title)
    yield from pdf_text(title, pages(_items(document), western(title)))


def _items(document: Document) -> Iterator[Item]:
    for text in lines(clean(document.title), TITLE, WIDE, bold=True):
        yield _line(text, TITLE, bold=True)
    yield _gap(2.0)._replace(keeps=True)
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
        high = 4.0 + HEAD + 4.5
        yield Item(high, lambda top: _heading(block.text, top - 4.0 - HEAD), keeps=True)
    elif isinstance(block, Prose):
        rows = _wrapped(block.text, WIDE)
        for i, text in enumerate(rows):  # no single line of it on a page
            yield _line(text, BODY)._replace(keeps=i in (0, len(rows) - 2))
        yield _gap(2.5)
    elif isinstance(block, TextList):
        for text in block.texts:
            for i, line in enumerate(_wrapped(text, WIDE - MARK)):
                yield _line(line, BODY, indent=MARK, mark="" if i else "•")
            yield _gap(0.8)
        yield _gap(2.0)
    elif isinstance(block, Facts):
        yield from _facts(block)
    elif isinstance(block, Grid):
        yield from _grid(block)
    elif isinstance(block, Picture):
        yield from _caption(block.drawing.title)
        yield _drawing(block.drawing)
    else:
        assert isinstance(block, Curves)
        yield from plot_pdf.items(block.figure)


def _wrapped(text: str, width_mm: float) -> list[str]:
    return lines(clean(text), BODY, width_mm)


def _gap(high: float) -> Item:
    return Item(high, lambda top: "")


def _line(text: str, size: float, bold: bool = False, indent: float = 0.0, mark: str = "") -> Item:
    def draw(top: float) -> str:
        y = top - size
        before = words(mark, (LEFT + 1.0, y), size) if mark else ""
        return before + words(text, (LEFT + indent, y), size, bold)

    return Item(LEADING * size, draw)


def _heading(text: str, y: float) -> str:
    return words(text, (LEFT, y), HEAD, bold=True) + rule(LEFT, y - 1.7, WIDE, 0.3, LINE)


def _barred(text: str, size: float, ink: str, bold: bool = False, mark: str = "") -> Item:
    high = LEADING * size
    x = LEFT + MARK + (0.0 if bold else MARK)

    def draw(top: float) -> str:
        y = top - size
        before = words(mark, (LEFT + MARK + 1.0, y), size) if mark else ""
        bar = box(LEFT, top - high, 1.6, high, ink)
        return bar + before + words(text, (x, y), size, bold, ink if bold else INK)

    return Item(high, draw)


def _grid(table: Grid) -> Iterator[Item]:
    """Yield a table with a head, which is repeated on each page."""
    right = [all(map(is_number, column)) for column in zip(*table.rows, strict=True)]
    rows = texts(table)
    spaces = [NO_BREAK if is_short(column) else " " for column in zip(*rows, strict=True)]
    rows = [[text.replace(" ", s) for text, s in zip(row, spaces, strict=True)] for row in rows]
    widths = _widths(table.heads, rows)
    head = _row(table.heads, right, widths, bold=True)
    yield from _caption(table.caption)
    has_head = any(table.heads)
    if has_head:
        yield head._replace(keeps=True)
    for row in rows:
        yield _row(row, right, widths)._replace(head=head if has_head else None)
    yield _gap(4.0)


def _facts(table: Facts) -> Iterator[Item]:
    """Yield names and values, in two columns read downwards."""
    named = [(fact.name, value_text(fact.value, fact.unit)) for fact in table.facts]
    half = (len(named) + 1) // 2
    yield from _caption(table.caption)
    gap = 6.0  # between facts side by side
    long = 0.5 * (WIDE - gap)
    for i in range(half):
        pair = [(LEFT, named[i])]
        pair += [(LEFT + long + gap, named[half + i])] if half + i < len(named) else []
        yield _pair(pair, long)._replace(keeps=i == 0 and half > 1)
    yield _gap(4.0)


def _caption(text: str) -> Iterator[Item]:
    """Yield the line above a table or a picture; nothing without a text."""
    if text:
        yield Item(
            STEP + 1.4,
            lambda top: words(text, (LEFT, top - SMALL), SMALL, bold=True, ink=SOFT),
            keeps=True,
        )


def _widths(heads: Sequence[str], rows: list[list[str]]) -> list[float]:
    """The columns' widths: those that they want, or fractions above their longest words."""
    needs, wants = [], []
    whole_word = 42.0  # the longest word that stays whole
    head_max = 30.0  # width of a head before it breaks
    for head, *cells in zip(heads, *rows, strict=True):
        longest = [max((wide(w, SMALL, True) for w in head.split()), default=0.0)]
        least = longest + [wide(w, SMALL) for cell in cells for w in cell.split(" ")]
        most = [min(wide(head, SMALL, True), head_max), *longest, *(wide(c, SMALL) for c in cells)]
        needs.append(min(max(least), whole_word) + 2.0 * PAD)
        wants.append(max(max(most) + 2.0 * PAD, needs[-1]))
    more = sum(wants) - sum(needs)
    left = WIDE - sum(needs)
    if left < 0.0:
        return [need * WIDE / sum(needs) for need in needs]
    fraction = min(1.0, left / more) if more > 0.0 else 0.0
    return [need + fraction * (want - need) for need, want in zip(needs, wants, strict=True)]


def _row(
    texts: Sequence[str], right: Sequence[bool], widths: Sequence[float], bold: bool = False
) -> Item:
    cells = [
        lines(text, SMALL, wide_ - 2.0 * PAD + 1e-6, bold)
        for text, wide_ in zip(texts, widths, strict=True)
    ]
    high = max(map(len, cells)) * STEP + 2.0 * SPACE

    def draw(top: float) -> str:
        out = box(LEFT, top - high, sum(widths), high, BAND) if bold else ""
        x = LEFT
        for cell, is_right, long in zip(cells, right, widths, strict=True):
            out += _cell(cell, x + PAD, top, long - 2.0 * PAD, is_right, bold)
            x += long
        return out + rule(LEFT, top - high, sum(widths), ink=LINE)

    return Item(high, draw)


def _cell(
    texts: list[str], x: float, top: float, width: float, right: bool, bold: bool = False
) -> str:
    out = ""
    ink, bold = (RED, True) if texts == [BAD] else (INK, bold)
    for i, text in enumerate(texts):
        at = x + width - wide(text, SMALL, bold) if right else x
        out += words(text, (at, top - SPACE - 0.95 * SMALL - i * STEP), SMALL, bold, ink)
    return out


def _pair(pair: list[tuple[float, tuple[str, str]]], long: float) -> Item:
    cells = []
    name_fraction = 0.62  # fraction of a fact's width for its name
    for x, (name, value) in pair:
        needs = min(wide(value, SMALL), (1.0 - 0.5 * name_fraction) * long)
        width = long - 2.0 * PAD - needs
        cells.append((x, lines(name, SMALL, width), lines(value, SMALL, needs + 1e-6)))
    high = max(max(len(a), len(b)) for _, a, b in cells) * STEP + 2.0 * SPACE

    def draw(top: float) -> str:
        out = ""
        for x, name, value in cells:
            out += _cell(name, x, top, long, False) + _cell(value, x, top, long, True)
            out += rule(x, top - high, long, ink=LINE)
        return out

    return Item(high, draw)


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
    left = LEFT + 0.5 * (WIDE - scale * across)

    def draw(top: float) -> str:
        def at(p: Point) -> Point:
            return left + scale * (p[0] - around.x0), top - margin + scale * (p[1] - around.y1)

        def traced(shape: Shape) -> str:
            return outline(placed(shape, at(ORIGIN), scale=scale))

        out, every = "", rings(shown.solid) if shown.solid else []
        inked = inks(tuple(dict.fromkeys(layer for layer, _ in every)))
        for layer, contours in every:
            out += f"{tint(inked[layer].rgb, opacity(layer))} rg\n"
            out += "".join(map(traced, contours)) + "f*\n"
        for name, ink in inks(shown.layers).items():
            is_thin = name in CENTRE_LINES
            out += f"{tint(ink.rgb)} RG {0.16 if is_thin else 0.3} w"
            out += f" [{'4 0.8 0.8 0.8' if is_thin else ''}] 0 d\n"
            out += "".join(f"{traced(shape)}S\n" for shape in shown.shapes if shape.layer == name)
        out += f"{SOFT} RG {SOFT} rg 0.16 w [] 0 d\n"
        out += "".join(f"{traced(one)}S\n" for one in (*noted.lines, *noted.scale_bar))
        out += "".join(triangle([at(corner) for corner in head]) for head in noted.heads)
        return out + "".join(words(text, at(place), SMALL) for place, text in noted.texts)

    return Item(scale * (noted.box.y1 - noted.box.y0) + 2.0 * margin, draw)
