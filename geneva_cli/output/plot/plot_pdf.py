"""A figure as PDF: a page of its own, or panels on the pages of a document."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial

from geneva_cli.figure import Figure
from geneva_cli.output.inks import LIGHT, colour, dashes
from geneva_cli.output.letters import western
from geneva_cli.output.pdf import pdf_file
from geneva_cli.output.pdf.pdf_file import POINT, number, tint
from geneva_cli.output.pdf.pdf_pages import INK, LEFT, WIDE, Item, box, wide, words
from geneva_cli.output.plot.plot_layout import (
    END,
    INCH,
    PAGE,
    START,
    TEXT,
    FigureBlock,
    Path,
    Pen,
    Point,
    blocks,
)


def chunks(figure: Figure) -> Iterator[str]:
    """Yield the text of a file with the figure alone."""
    parts = list(blocks(figure))
    mm = 25.4 / INCH  # one px on a figure's own page
    tall = mm * sum(block.high for block in parts)
    content, top = f"{POINT:.9f} 0 0 {POINT:.9f} 0 0 cm\n1 J 1 j\n", tall
    for block in parts:
        content += _drawn(block, 0.0, mm, top)
        top -= mm * block.high
    page = pdf_file.Page(mm * PAGE, tall, content, fonts=2)
    yield from pdf_file.pdf_text(western(figure.title), [page])


def items(figure: Figure) -> Iterator[Item]:
    """Yield a figure's parts for a document, so that no title and no last panel stands alone."""
    scale = WIDE / PAGE
    parts = list(blocks(figure))
    for i, block in enumerate(parts):
        draw = partial(_drawn, block, LEFT, scale)
        yield Item(scale * block.high, draw, keeps=i in (0, len(parts) - 2))


def _drawn(block: FigureBlock, left: float, scale: float, top: float) -> str:
    pen = _PdfPen(left, scale, top)
    block.draw(pen, 0.0)
    return "".join(pen.out)


class _PdfPen(Pen):
    """Operators of a page, in mm; y upwards."""

    def __init__(self, left: float, scale: float, top: float) -> None:
        self.left, self.scale, self.top = left, scale, top
        self.out: list[str] = []

    def rest(self, x: float, y: float, wide: float, high: float) -> None:
        (left, bottom), k = self._place((x, y + high)), self.scale
        self.out.append(box(left, bottom, k * wide, k * high, tint(LIGHT.rest)))

    def grid(self, paths: Iterable[Path]) -> None:
        self._stroke(LIGHT.grid, 0.5, paths)

    def axis(self, paths: Iterable[Path]) -> None:
        self._stroke(LIGHT.axis, 0.9, paths)

    def curve(self, number: int, paths: Iterable[Path]) -> None:
        self._stroke(colour(number, LIGHT), 1.6, paths, dashes(number))

    def jumps(self, number: int, paths: Iterable[Path]) -> None:
        self._stroke(colour(number, LIGHT), 0.8, paths)

    def points(self, number: int, places: Path) -> None:
        self._stroke(colour(number, LIGHT), 4.0, [[place] for place in dict.fromkeys(places)])

    def dot(self, number: int, place: Point) -> None:
        self._stroke(colour(number, LIGHT), 5.6, [[place]])

    def text(self, x: float, y: float, text: str, size: float = TEXT, hold: str = START) -> None:
        self._words(x, y, text, size, hold)

    def bold(self, x: float, y: float, text: str, size: float = TEXT) -> None:
        self._words(x, y, text, size, START, bold=True)

    def _words(
        self, x: float, y: float, text: str, size: float, hold: str, bold: bool = False
    ) -> None:
        (x, y), size = self._place((x, y)), self.scale * size
        before = 0.0 if hold == START else wide(text, size, bold) * (1.0 if hold == END else 0.5)
        self.out.append(words(text, (x - before, y), size, bold, INK))

    def _stroke(
        self, ink: str, width: float, paths: Iterable[Path], pattern: tuple[float, ...] = ()
    ) -> None:
        """Draw lines with round ends; a path of one place is a dot."""
        dash = " ".join(number(self.scale * x) for x in pattern)
        self.out.append(f"{tint(ink)} RG {number(self.scale * width)} w [{dash}] 0 d\n")
        for path in paths:
            first, *rest = dict.fromkeys(self._at(place) for place in path)
            self.out.append(f"{first} m\n" + "".join(f"{p} l\n" for p in rest or [first]) + "S\n")

    def _place(self, place: Point) -> Point:
        return self.left + self.scale * place[0], self.top - self.scale * place[1]

    def _at(self, place: Point) -> str:
        return pdf_file.point(self._place(place))
