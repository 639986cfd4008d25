"""Tables and documents as Markdown, for reports and issues."""

from collections.abc import Iterable, Iterator, Sequence

from geneva_cli.output.document import blocks
from geneva_cli.output.plot.plot_layout import mark_text, named
from geneva_cli.output.text import cell
from geneva_cli.table import Table, flat

# HTML by its own names, which every renderer reads alike; Markdown by its backslash
ESCAPES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", **{c: f"\\{c}" for c in "\\`*[]|"}}


def chunks(table: Table) -> Iterator[str]:
    """The table, line by line."""
    if table.title:
        yield f"# {escaped(table.title)}\n\n"
    if table.prose:
        yield f"{escaped(table.prose)}\n\n"
    if table.record:
        table = flat(table)
        rows = zip(table.names, next(table.rows()), strict=True)
        yield from lines_of(("quantity", "value"), rows, (False, True))
    elif table.names:  # else only its title and prose are left
        yield from lines_of(table.names, table.rows(), [True] * len(table.names))


def lines_of(
    heads: Sequence[str], rows: Iterable[Sequence[object]], right: Sequence[bool]
) -> Iterator[str]:
    """The lines of a table, whose columns stand left or ``right``."""
    yield f"| {' | '.join(map(escaped, heads))} |\n"
    yield f"| {' | '.join('---:' if side else '---' for side in right)} |\n"
    for row in rows:
        yield f"| {' | '.join(map(escaped, row))} |\n"


def escaped(value: object) -> str:
    """A value without special meaning: a user's title may look like HTML or Markdown."""
    return "".join(ESCAPES.get(c, c) for c in cell(value))


def document_chunks(document: blocks.Document) -> Iterator[str]:
    """Yield the text of a document: headings, tables, and descriptions of its pictures."""
    yield f"# {escaped(document.title)}\n\n**{escaped(document.verdict)}**\n\n"
    yield _list(document.reasons)
    for block in document.blocks:
        yield from _block(block)


def _block(block: blocks.Block) -> Iterator[str]:
    if isinstance(block, blocks.Heading):
        yield f"## {escaped(block.text)}\n\n"
    elif isinstance(block, blocks.Prose):
        yield f"{escaped(block.text)}\n\n"
    elif isinstance(block, blocks.TextList):
        yield _list(block.texts)
    elif isinstance(block, blocks.Grid):
        yield from _grid(block)
    elif isinstance(block, blocks.Picture):
        look = block.drawing.look
        yield _list([span.text for span in look.spans] if look else [])
        yield "The drawing: `geneva profile SPEC --part assembly -o FILE.svg`\n\n"
    elif isinstance(block, blocks.Curves):
        peaks = tuple(
            (named(panel.y), mark_text(mark))
            for panel in block.figure.panels
            for curve in panel.curves
            for mark in curve.marks
        )
        yield from _grid(blocks.Grid(block.figure.title, ("Curve", "Peak"), peaks))
        yield "The curves: `geneva plot SPEC -o FILE.svg`\n\n"


def _grid(grid: blocks.Grid) -> Iterator[str]:
    yield f"**{escaped(grid.caption)}**\n\n" if grid.caption else ""
    heads = ("Quantity", "Value") if grid.facts else grid.heads
    right = blocks.right_aligned(grid) or [False] * len(heads)
    yield from lines_of(heads, blocks.texts(grid), right)
    yield "\n"


def _list(texts: Sequence[str]) -> str:
    return "".join(f"- {escaped(text)}\n" for text in texts) + "\n" * bool(texts)
