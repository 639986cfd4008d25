"""A figure as PDF: a page of its own, or panels on the pages of a document."""

from collections.abc import Iterator

from geneva_cli.figure import Figure
from geneva_cli.output import pdf
from geneva_cli.output.inks import LIGHT, colour, dashes
from geneva_cli.output.letters import western
from geneva_cli.output.plot import plot_layout as layout
from geneva_cli.output.plot.plot_layout import Lines, Path, Words

# of lines, px; of all others
WIDTHS = {"grid": 0.5, "axis": 0.9, "curve": 1.6, "sample": 1.6, "jump": 0.8, "dot": 5.6}
POINTS = 4.0


def chunks(figure: Figure) -> Iterator[str]:
    """Yield the text of a file with the figure alone."""
    parts = list(layout.blocks(figure))
    mm = 25.4 / layout.INCH  # one px on a figure's own page
    tall = mm * sum(block.high for block in parts)
    content, top = pdf.BEGIN, tall
    for block in parts:
        content += pdf.moved(drawn(block), 0.0, top, mm)
        top -= mm * block.high
    yield from pdf.pdf_text(western(figure.title), [pdf.Page(mm * layout.PAGE, tall, content)])


def drawn(block: layout.FigureBlock) -> str:
    """Return the operators of a part of a figure, px, from the height 0 downwards."""

    def text(one: Words) -> str:
        before = {"end": 1.0, "middle": 0.5}.get(one.look, 0.0) * pdf.wide(one.text, one.size)
        at = one.place[0] - before, -one.place[1]
        return pdf.words(one.text, at, one.size, one.look == "bold")

    def path(places: Path) -> str:
        first, *rest = dict.fromkeys(pdf.point((x, -y)) for x, y in places)
        return f"{first} m\n" + "".join(f"{p} l\n" for p in rest or [first])  # a dot of one place

    def lines(one: Lines) -> str:
        ink = {"rest": LIGHT.rest, "grid": LIGHT.grid, "axis": LIGHT.axis}.get(one.kind)
        ink = pdf.colour(ink or colour(one.number, LIGHT))
        if one.kind == "rest":
            return f"{ink} rg\n" + "".join(f"{path(places)}f\n" for places in one.paths)
        dashed = one.number if one.kind in ("curve", "sample") else 0
        dash = " ".join(map(pdf.number, dashes(dashed)))
        look = f"{ink} RG {WIDTHS.get(one.kind, POINTS)} w [{dash}] 0 d\n"
        return look + "".join(f"{path(places)}S\n" for places in one.paths)

    return "".join(text(one) if isinstance(one, Words) else lines(one) for one in block.marks)
