"""A figure as SVG, and as PNG by resvg, which is an extra. Equal figures give equal bytes.

In SVG texts remain texts, and colours follow the reader's light or dark mode.
"""

from collections.abc import Iterable, Iterator
from html import escape

from geneva_cli.errors import GenevaError, clean
from geneva_cli.figure import Figure
from geneva_cli.output.inks import DARK, LIGHT, Paper, colour, dashes
from geneva_cli.output.plot import plot_layout as layout
from geneva_cli.output.plot.plot_layout import TEXT, Frame, Kind, Look, Path, Point
from geneva_cli.output.templates import filled
from geneva_cli.table import in_decimals

WIDE = 1500  # pixels of a png: ten inches at 150 dots an inch


def chunks(figure: Figure) -> Iterator[str]:
    """Yield the file's text."""
    known, pen, tall = figure.curves(), _SvgPen(), 0.0
    for block in layout.blocks(figure):
        block.draw(pen, tall)
        tall += block.high
    names = ", ".join(layout.named(panel.y) for panel in figure.panels)
    content = f"{names} by {layout.named(figure.x).lower()}"
    patterns = [(n, " ".join(map(_n, dashes(n)))) for n in known]
    dashed = "".join(f".c{n} {{ stroke-dasharray: {d} }}\n" for n, d in patterns if d)
    title = escape(clean(figure.title).strip(), quote=False)
    parts = {"TITLE": title, "CONTENT": escape(content, quote=False), "DASHES": dashed}
    parts |= {"WIDE": _n(layout.PAGE), "TALL": _n(tall), "SIZE": _n(TEXT)}
    parts |= {"LIGHT": _style(LIGHT, known), "DARK": _style(DARK, known)}
    yield filled("figure.svg", parts | {"DRAWING": "".join(pen.out)})


def png_chunks(figure: Figure) -> Iterator[bytes]:
    """Yield a picture's bytes, equal on every machine.

    Raises GenevaError if resvg or the font is not installed.
    """
    try:
        from font_source_sans_pro import font_files_ttf as fonts
        from resvg_py import svg_to_bytes
    except ImportError:
        raise GenevaError(
            "png needs resvg-py and a font, which are not installed: pip install "
            "'geneva-cli[plot]', or write an .svg or a .pdf"
        ) from None
    yield svg_to_bytes(
        "".join(chunks(figure)),
        zoom=WIDE / layout.PAGE,
        skip_system_fonts=True,  # a picture does not depend on the machine
        font_files=[fonts["SourceSansPro"], fonts["SourceSansProBold"]],
        sans_serif_family="Source Sans Pro",
    )


def _style(paper: Paper, known: Iterable[int]) -> str:
    own = "".join(
        f".c{n} {{ stroke: {colour(n, paper)} }} .d{n} {{ fill: {colour(n, paper)} }}\n"
        for n in known
    )
    return (
        f".page {{ fill: {paper.page} }} text {{ fill: {paper.text} }}\n"
        f".rest {{ fill: {paper.rest} }} .grid {{ stroke: {paper.grid} }}"
        f" .axis {{ stroke: {paper.axis} }}\n{own}"
    )


class _SvgPen:
    """Elements of an SVG."""

    def __init__(self) -> None:
        self.out: list[str] = []

    def begin(self, name: str, frame: Frame) -> None:
        # the last digits of a peak may differ between machines
        x, y = (" ".join(f"{v:.12g}" for v in ends) for ends in (frame.window, frame.span))
        self.out.append(
            f'<g id="{escape(name)}" data-x="{x}" data-y="{y}" data-frame="{_n(layout.LEFT)}'
            f' {_n(frame.top)} {_n(frame.wide)} {_n(frame.high)}">\n'
        )

    def end(self) -> None:
        self.out.append("</g>\n")

    def rest(self, x: float, y: float, wide: float, high: float) -> None:
        self.out.append(
            f'<rect class="rest" x="{_n(x)}" y="{_n(y)}" width="{_n(wide)}" height="{_n(high)}"/>\n'
        )

    def draw(self, kind: Kind, paths: Iterable[Path], number: int = 0) -> None:
        if kind == "sample":
            words = [f"M{_at(start)}h{_n(end[0] - start[0])}" for start, end in paths]
        elif kind == "jump":
            words = [f"M{_at(before)}V{_n(after[1])}" for before, after in paths]
        elif kind == "points":
            words = [f"M{at}h0" for at in dict.fromkeys(_at(place) for (place,) in paths)]
        else:
            words, last = [], ""  # a path that begins at the end of the one before continues it
            for path in paths:
                places = list(map(_at, path))
                words += [] if places[0] == last else ["M" + places[0]]
                words += [" " + place for place in places[1:]]
                last = places[-1]
        look = {"grid": "grid", "axis": "axis", "sample": f"curve c{number}"}
        name = look.get(kind, f"{kind} c{number}")
        self.out.append(f'<path class="{name}" d="{"".join(words)}"/>\n')

    def dot(self, number: int, place: Point) -> None:
        x, y = map(_n, place)
        self.out.append(f'<circle class="d{number}" cx="{x}" cy="{y}" r="2.8"/>\n')

    def text(self, place: Point, text: str, size: float = TEXT, look: Look = "start") -> None:
        more = f' text-anchor="{look}"' if look in ("middle", "end") else ""
        more += "" if size == TEXT else f' font-size="{_n(size)}"'
        more += ' font-weight="bold"' if look == "bold" else ""
        x, y = map(_n, place)
        self.out.append(f'<text x="{x}" y="{y}"{more}>{escape(text, quote=False)}</text>\n')


def _at(place: Point) -> str:
    return f"{_n(place[0])},{_n(place[1])}"


def _n(value: float) -> str:
    return in_decimals(value, 2)
