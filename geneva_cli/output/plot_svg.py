"""A figure as SVG, without another program: panels one below the other over one x axis.

Texts are texts; colours follow the reader's light or dark mode. The same figure gives the same
bytes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple
from xml.sax.saxutils import escape, quoteattr

from geneva_cli.errors import clean, cut
from geneva_cli.figure import LINE, POINTS, Curve, Figure, Mark, Panel
from geneva_cli.output.letters import LETTER, width
from geneva_cli.output.strokes import DARK, LIGHT, Paper, colour, dashes
from geneva_cli.output.ticks import labels, named, said, ticks

# In px:
PAGE = 820.0
LEFT, RIGHT, BESIDE = 72.0, 18.0, 192.0  # BESIDE: the column of the marks
HEIGHTS = {1: 300.0, 2: 220.0, 3: 160.0}  # of a panel, by their number
HEIGHT = 112.0  # where there are more
ABOVE, BELOW = 26.0, 44.0  # a panel's name; the last one's ticks and the axis' name
TITLE, TEXT, SMALL = 15.0, 11.0, 10.0  # heights of letters
LINE_HEIGHT = 14.0
SAMPLE = 30.0  # of a curve, in the legend
PAD = 0.05  # of a panel's span, above and below it
APART = 24.0, 70.0  # of ticks, at the least: up and across
SEEN = 0.05  # a jump that is shorter is none


class _Frame(NamedTuple):
    """A panel on the page, and what it shows."""

    top: float
    wide: float
    high: float
    window: tuple[float, float]
    span: tuple[float, float]

    def x(self, value: float) -> float:
        a, b = self.window
        return LEFT + (value - a) / (b - a) * self.wide

    def y(self, value: float) -> float:
        low, top = self.span
        return self.top + (top - value) / (top - low) * self.high

    @property
    def bottom(self) -> float:
        return self.top + self.high


def chunks(figure: Figure) -> Iterator[str]:
    """The file's text."""
    known = figure.curves()
    legend, begin = _legend(known.values()) if len(known) > 1 else ([], TITLE + 14.0)
    high = HEIGHTS.get(len(figure.panels), HEIGHT)
    marked = any(curve.marks for panel in figure.panels for curve in panel.curves)
    wide = PAGE - LEFT - (BESIDE if marked else RIGHT)
    frames = [
        _Frame(begin + ABOVE + i * (ABOVE + high), wide, high, figure.window, padded(panel))
        for i, panel in enumerate(figure.panels)
    ]
    tall = frames[-1].bottom + BELOW
    title = clean(figure.title).strip()
    names = ", ".join(named(panel.y) for panel in figure.panels)
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_n(PAGE)}" height="{_n(tall)}"'
        f' viewBox="0 0 {_n(PAGE)} {_n(tall)}" role="img" font-family="sans-serif"'
        f' font-size="{_n(TEXT)}">\n'
        f"<title>{escape(title)}</title>\n"
        f"<desc>{escape(names)} by {escape(named(figure.x).lower())}</desc>\n"
        f"<style>\n{_style(LIGHT, known)}{_dashes(known)}"
        f"@media (prefers-color-scheme: dark) {{\n{_style(DARK, known)}}}\n</style>\n"
        f'<rect class="page" width="{_n(PAGE)}" height="{_n(tall)}"/>\n'
    )
    most = int((PAGE - 2.0 * RIGHT) / (LETTER * TITLE))
    yield _text(RIGHT, TITLE + 8.0, cut(title, most), f'font-size="{_n(TITLE)}" font-weight="bold"')
    yield from legend
    across = ticks(*figure.window, int(wide / APART[1]), figure.x.unit)
    for panel, frame in zip(figure.panels, frames, strict=True):
        yield from _panel(figure, panel, frame, across, len(known) > 1)
    yield from _below(figure, frames[-1], across)
    yield _dwell(figure, frames[0])
    yield "</svg>\n"


def padded(panel: Panel) -> tuple[float, float]:
    """What a panel shows of its quantity: its span, with a little room above and below."""
    low, high = panel.span()
    room = PAD * (high - low) or 0.5 * abs(high) or 1.0
    return low - room, high + room


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


def _dashes(known: Iterable[int]) -> str:
    given = [(n, " ".join(map(_n, dashes(n)))) for n in known]
    own = "".join(f".c{n} {{ stroke-dasharray: {d} }}\n" for n, d in given if d)
    return (
        "path { fill: none } .curve { stroke-width: 1.6; stroke-linejoin: round }\n"
        f"{own}.jump {{ stroke-width: 0.8; stroke-dasharray: none }}\n"
        ".points { stroke-width: 4; stroke-linecap: round; stroke-dasharray: none }\n"
    )


def _legend(curves: Iterable[Curve]) -> tuple[list[str], float]:
    """Samples of the curves with their names, in lines below the title; where they end."""
    out, x, y = [], RIGHT, TITLE + 14.0 + LINE_HEIGHT
    for curve in curves:
        name = cut(clean(curve.name), 48)
        needs = SAMPLE + 6.0 + TEXT * width(name) + 18.0
        if x > RIGHT and x + needs > PAGE - RIGHT:
            x, y = RIGHT, y + LINE_HEIGHT + 2.0
        out.append(_sample(curve, x, y) + _text(x + SAMPLE + 6.0, y, name))
        x += needs
    return out, y


def _sample(curve: Curve, x: float, y: float, long: float = SAMPLE) -> str:
    middle = y - 0.35 * TEXT
    out = ""
    if curve.style != POINTS:
        out = f'<path class="curve c{curve.number}" d="M{_n(x)} {_n(middle)}h{_n(long)}"/>\n'
    if curve.style != LINE:
        out += f'<path class="points c{curve.number}" d="M{_n(x + 0.5 * long)} {_n(middle)}h0"/>\n'
    return out


def _panel(
    figure: Figure, panel: Panel, frame: _Frame, across: list[float], several: bool
) -> Iterator[str]:
    """One panel: dwells, grid, axes, curves and what is said of their peaks."""
    up = ticks(*frame.span, int(frame.high / APART[0]), panel.y.unit)
    yield (
        f'<g id={quoteattr(panel.y.name)} data-x="{figure.window[0]!r} {figure.window[1]!r}"'
        f' data-y="{frame.span[0]!r} {frame.span[1]!r}" data-frame="{_n(LEFT)} {_n(frame.top)}'
        f' {_n(frame.wide)} {_n(frame.high)}">\n'
    )
    for a, b in figure.shaded:
        x, wide = frame.x(a), frame.x(b) - frame.x(a)
        yield (
            f'<rect class="rest" x="{_n(x)}" y="{_n(frame.top)}" width="{_n(wide)}"'
            f' height="{_n(frame.high)}"/>\n'
        )
    lines = [f"M{_n(LEFT)} {_n(frame.y(v))}h{_n(frame.wide)}" for v in up]
    lines += [f"M{_n(frame.x(v))} {_n(frame.top)}v{_n(frame.high)}" for v in across]
    yield f'<path class="grid" d="{"".join(lines)}"/>\n'
    axes = f"M{_n(LEFT)} {_n(frame.top)}v{_n(frame.high)}h{_n(frame.wide)}"
    if frame.span[0] < 0.0 < frame.span[1]:
        axes += f"M{_n(LEFT)} {_n(frame.y(0.0))}h{_n(frame.wide)}"
    yield f'<path class="axis" d="{axes}"/>\n'
    for value, label in zip(up, labels(up), strict=True):
        y = frame.y(value) + 0.35 * SMALL
        yield _text(LEFT - 6.0, y, label, f'text-anchor="end" font-size="{_n(SMALL)}"')
    yield _text(LEFT, frame.top - 7.0, named(panel.y), 'font-weight="bold"')
    for curve in panel.curves:
        yield from _curve(curve, frame)
    yield from _marks(panel, frame, several, figure.x.unit)
    yield "</g>\n"


def _curve(curve: Curve, frame: _Frame) -> Iterator[str]:
    """The curve, its jumps as thin upright lines, and its points."""
    if curve.style != POINTS:
        words: list[str] = []
        last = ("", "")
        for xs, ys in curve.pieces:
            points = [(_n(frame.x(x)), _n(frame.y(y))) for x, y in zip(xs, ys, strict=True)]
            if points[0] != last:
                words.append("M" + ",".join(points[0]))
            words += [" " + ",".join(point) for point in points[1:]]
            last = points[-1]
        yield f'<path class="curve c{curve.number}" d="{"".join(words)}"/>\n'
    jumps = [(frame.x(x), frame.y(a), frame.y(b)) for x, a, b in curve.jumps()]
    seen = [f"M{_n(x)} {_n(a)}V{_n(b)}" for x, a, b in jumps if abs(b - a) > SEEN]
    if seen and curve.style == LINE:
        yield f'<path class="jump c{curve.number}" d="{"".join(seen)}"/>\n'
    if curve.style != LINE:
        places = [
            (_n(frame.x(x)), _n(frame.y(y)))
            for piece in curve.pieces
            for x, y in zip(*piece, strict=True)
        ]
        dots = "".join(f"M{x} {y}h0" for x, y in dict.fromkeys(places))
        yield f'<path class="points c{curve.number}" d="{dots}"/>\n'


def _marks(panel: Panel, frame: _Frame, several: bool, unit: str) -> Iterator[str]:
    """A dot at each peak, and its value and place beside the panel."""
    x, y = LEFT + frame.wide + 12.0, frame.top + 0.8 * TEXT
    for curve in panel.curves:
        for mark in curve.marks:
            yield _dot(curve, mark, frame)
            if several:
                yield _sample(curve, x, y, 0.8 * SAMPLE)
            yield _text(x + (SAMPLE if several else 0.0), y, said(mark, "°" if unit else ""))
            y += LINE_HEIGHT


def _dot(curve: Curve, mark: Mark, frame: _Frame) -> str:
    if mark.y is None:
        return ""
    return (
        f'<circle class="d{curve.number}" cx="{_n(frame.x(mark.x))}" cy="{_n(frame.y(mark.y))}"'
        ' r="2.8"/>\n'
    )


def _below(figure: Figure, frame: _Frame, across: list[float]) -> Iterator[str]:
    for value, label in zip(across, labels(across), strict=True):
        yield _text(frame.x(value), frame.bottom + 15.0, label, 'text-anchor="middle"')
    middle = LEFT + 0.5 * frame.wide
    yield _text(middle, frame.bottom + 34.0, named(figure.x), 'text-anchor="middle"')


def _dwell(figure: Figure, frame: _Frame) -> str:
    """The word above the first stretch at rest that has room for it, clear of the panel's name."""
    needs = TEXT * width("dwell")
    taken = LEFT + TEXT * width(named(figure.panels[0].y))
    for a, b in figure.shaded:
        middle = 0.5 * (frame.x(a) + frame.x(b))
        if frame.x(b) - frame.x(a) > needs and middle - needs > taken:
            return _text(middle, frame.top - 7.0, "dwell", 'text-anchor="middle"')
    return ""


def _text(x: float, y: float, text: str, more: str = "") -> str:
    return f'<text x="{_n(x)}" y="{_n(y)}"{" " + more if more else ""}>{escape(text)}</text>\n'


def _n(value: float) -> str:
    """Two decimals at the most; no negative zero."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
