"""A document as Markdown: headings, tables, and descriptions of its pictures."""

from collections.abc import Iterator, Sequence

from geneva_cli.output.document import blocks
from geneva_cli.output.markdown import escaped, lines_of
from geneva_cli.output.notes import span_text
from geneva_cli.output.plot.plot_layout import mark_text, named


def chunks(document: blocks.Document) -> Iterator[str]:
    """Yield the text, block by block."""
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
        yield _list([span_text(span) for span in look.spans] if look else [])
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
