"""A figure as SVG, and as PNG by resvg, which is an extra. Equal figures give equal bytes.

In SVG texts remain texts, and colours follow the reader's light or dark mode.
"""

from collections.abc import Iterable, Iterator
from html import escape

from geneva_cli.errors import GenevaError, clean
from geneva_cli.figure import Figure
from geneva_cli.output.inks import DARK, LIGHT, Paper, colour, dashes
from geneva_cli.output.plot import plot_layout as layout
from geneva_cli.output.plot.plot_layout import TEXT, FigureBlock, Lines, Words
from geneva_cli.output.templates import filled
from geneva_cli.table import in_decimals

WIDE = 1500  # pixels of a png: ten inches at 150 dots an inch


def chunks(figure: Figure) -> Iterator[str]:
    """Yield the file's text."""
    known, drawing, tall = figure.curves(), "", 0.0
    for block in layout.blocks(figure):
        drawing += _drawn(block, tall)
        tall += block.high
    names = ", ".join(layout.named(panel.y) for panel in figure.panels)
    content = f"{names} by {layout.named(figure.x).lower()}"
    patterns = [(n, " ".join(map(_n, dashes(n)))) for n in known]
    dashed = "".join(f".c{n} {{ stroke-dasharray: {d} }}\n" for n, d in patterns if d)
    title = escape(clean(figure.title).strip(), quote=False)
    parts = {"TITLE": title, "CONTENT": escape(content, quote=False), "DASHES": dashed}
    parts |= {"WIDE": _n(layout.PAGE), "TALL": _n(tall), "SIZE": _n(TEXT)}
    parts |= {"LIGHT": _style(LIGHT, known), "DARK": _style(DARK, known)}
    yield filled("figure.svg", parts | {"DRAWING": drawing})


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
    own = "".join(f".c{n} {{ stroke: {colour(n, paper)} }}\n" for n in known)
    return (
        f".page {{ fill: {paper.page} }} text {{ fill: {paper.text} }}\n"
        f".rest {{ fill: {paper.rest} }} .grid {{ stroke: {paper.grid} }}"
        f" .axis {{ stroke: {paper.axis} }}\n{own}"
    )


def _drawn(block: FigureBlock, top: float) -> str:
    """The elements of a block whose top is at a height of the page; a panel is a group."""
    out = "".join(_text(m, top) if isinstance(m, Words) else _path(m, top) for m in block.marks)
    frame = block.frame
    if not frame:
        return out
    # the last digits of a peak may differ between machines
    x, y = (" ".join(f"{v:.12g}" for v in ends) for ends in (frame.window, frame.span))
    place = layout.LEFT, top + layout.ABOVE, frame.wide, frame.high
    data = f'data-x="{x}" data-y="{y}" data-frame="{" ".join(map(_n, place))}"'
    return f'<g id="{escape(block.name)}" {data}>\n{out}</g>\n'


def _path(lines: Lines, top: float) -> str:
    words, last = list[str](), ""  # a path that begins at the end of the one before continues it
    for path in lines.paths:
        first, *more = (f"{_n(x)},{_n(top + y)}" for x, y in path)
        more = more or [first]  # one place is a dot
        words += [] if first == last else ["M" + first]
        words += [f" {place}" for place in more]
        last = more[-1]
    name = lines.kind if lines.kind in ("rest", "grid", "axis") else f"{lines.kind} c{lines.number}"
    return f'<path class="{name}" d="{"".join(words)}"/>\n' if words else ""


def _text(words: Words, top: float) -> str:
    more = f' text-anchor="{words.look}"' if words.look in ("middle", "end") else ""
    more += "" if words.size == TEXT else f' font-size="{_n(words.size)}"'
    more += ' font-weight="bold"' if words.look == "bold" else ""
    place = f'x="{_n(words.place[0])}" y="{_n(top + words.place[1])}"'
    return f"<text {place}{more}>{escape(words.text, quote=False)}</text>\n"


def _n(value: float) -> str:
    return in_decimals(value, 2)
