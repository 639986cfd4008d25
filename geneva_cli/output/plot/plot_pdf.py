"""A figure as PDF: a page of its own, or panels on the pages of a document."""

from collections.abc import Iterable, Iterator
from typing import ClassVar

from geneva_cli.figure import Figure
from geneva_cli.output.inks import LIGHT, colour, dashes
from geneva_cli.output.letters import western
from geneva_cli.output.pdf import BEGIN, INK, Page, box, number, pdf_text, point, tint, wide, words
from geneva_cli.output.plot import plot_layout as layout
from geneva_cli.output.plot.plot_layout import TEXT, Frame, Kind, Look, Path, Point


def chunks(figure: Figure) -> Iterator[str]:
    """Yield the text of a file with the figure alone."""
    parts = list(layout.blocks(figure))
    mm = 25.4 / layout.INCH  # one px on a figure's own page
    tall = mm * sum(block.high for block in parts)
    content, top = BEGIN, tall
    for block in parts:
        content += drawn(block, 0.0, mm, top)
        top -= mm * block.high
    yield from pdf_text(western(figure.title), [Page(mm * layout.PAGE, tall, content, fonts=2)])


def drawn(block: layout.FigureBlock, left: float, scale: float, top: float) -> str:
    """Return the operators of a part of a figure, from a height downwards."""
    pen = _PdfPen(left, scale, top)
    block.draw(pen, 0.0)
    return "".join(pen.out)


class _PdfPen:
    """Operators of a page, in mm; y upwards."""

    WIDTHS: ClassVar = {"grid": 0.5, "axis": 0.9, "curve": 1.6, "sample": 1.6, "jump": 0.8}

    def __init__(self, left: float, scale: float, top: float) -> None:
        self.left, self.scale, self.top = left, scale, top
        self.out: list[str] = []

    def begin(self, name: str, frame: Frame) -> None:
        pass  # a page has no groups

    def end(self) -> None:
        pass

    def rest(self, x: float, y: float, wide: float, high: float) -> None:
        (left, bottom), k = self._place((x, y + high)), self.scale
        self.out.append(box(left, bottom, k * wide, k * high, tint(LIGHT.rest)))

    def draw(self, kind: Kind, paths: Iterable[Path], number: int = 0) -> None:
        ink = {"grid": LIGHT.grid, "axis": LIGHT.axis}.get(kind) or colour(number, LIGHT)
        if kind == "points":
            paths = dict.fromkeys(map(tuple, paths))
        dashed = number if kind in ("curve", "sample") else 0
        self._stroke(ink, self.WIDTHS.get(kind, 4.0), paths, dashed)

    def dot(self, number: int, place: Point) -> None:
        self._stroke(colour(number, LIGHT), 5.6, [[place]])

    def text(self, place: Point, text: str, size: float = TEXT, look: Look = "start") -> None:
        (x, y), size = self._place(place), self.scale * size
        before = {"end": 1.0, "middle": 0.5}.get(look, 0.0) * wide(text, size)
        self.out.append(words(text, (x - before, y), size, look == "bold", INK))

    def _stroke(self, ink: str, width: float, paths: Iterable[Path], dashed: int = 0) -> None:
        """Draw lines with round ends and a curve's dashes; a path of one place is a dot."""
        dash = " ".join(number(self.scale * x) for x in dashes(dashed))
        self.out.append(f"{tint(ink)} RG {number(self.scale * width)} w [{dash}] 0 d\n")
        for path in paths:
            first, *rest = dict.fromkeys(point(self._place(place)) for place in path)
            self.out.append(f"{first} m\n" + "".join(f"{p} l\n" for p in rest or [first]) + "S\n")

    def _place(self, place: Point) -> Point:
        return self.left + self.scale * place[0], self.top - self.scale * place[1]
