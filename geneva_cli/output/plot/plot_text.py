"""A figure as text: a compact chart for a terminal, or plain ASCII for a pipe or a file.

One curve is drawn in Braille dots (two by four in a letter) if the encoding has them. Several
curves have letters of their own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from geneva_cli.errors import clean, cut
from geneva_cli.figure import LINE, POINTS, Curve, Figure, Panel
from geneva_cli.output.plot.plot_layout import labels, mark_text, ticks
from geneva_cli.output.terminal.layout import width_of, wrapped

MARKS = "*o+x#@%&=~^$"  # letters of several curves in a panel, and of one curve in ASCII
LABEL = 10  # letters for the numbers of the upright axis


def chunks(figure: Figure, columns: int = 80, unicode: bool = False) -> Iterator[str]:
    """The chart's lines, none longer than ``columns``."""
    columns = min(max(columns, 40), 140)
    wide = columns - LABEL - 3
    known = figure.curves()
    yield from _lines(clean(figure.title).strip(), columns)
    if len(known) > 1:
        for curve in known.values():
            yield from _lines(f"  {MARKS[curve.number]}  {clean(curve.name)}", columns)
    ground, dwell = ("─", "░") if unicode else ("-", ":")
    lines = {1: 16, 2: 12}.get(len(figure.panels), 7)  # a panel's, by the number of panels
    for panel in figure.panels:
        yield "\n"
        yield from _heading(panel, columns, len(known) > 1, figure.x.unit)
        grid = _grid(figure, panel, wide, lines, unicode)
        yield from grid
    rests = [_column(x, figure, wide) for pair in figure.shaded for x in pair]
    foot = [ground] * wide
    for a, b in zip(rests[::2], rests[1::2], strict=True):
        foot[a : b + 1] = dwell * (b + 1 - a)
    yield f"{'':>{LABEL}} +{''.join(foot)}\n"
    yield from _below(figure, wide)
    if figure.shaded:
        yield f"{'':>{LABEL}}  {dwell * 3} dwell\n"


def _lines(text: str, columns: int) -> Iterator[str]:
    """A text broken between words; a word wider than the chart is cut."""
    for line in wrapped(text, columns):
        while line and width_of(line) > columns:
            line = cut(line, len(line) - 1) if len(line) > 8 else ""
        yield line + "\n"


def _heading(panel: Panel, columns: int, several: bool, unit: str) -> Iterator[str]:
    name = panel.y.name
    if several:
        yield from _lines(name, columns)
        for curve in panel.curves:
            for mark in curve.marks:
                yield from _lines(
                    f"  {MARKS[curve.number]}  {mark_text(mark, f' {unit}')}", columns
                )
        return
    peaks = ", ".join(mark_text(m, f" {unit}".rstrip()) for c in panel.curves for m in c.marks)
    yield from _lines(f"{name}: {peaks}" if peaks else name, columns)


def _grid(figure: Figure, panel: Panel, wide: int, high: int, unicode: bool) -> Iterator[str]:
    low, top = panel.span()
    if not top > low:
        low, top = low - (0.5 * abs(low) or 1.0), top + (0.5 * abs(top) or 1.0)
    step = (top - low) / (high - 1)

    def row(y: float) -> int:
        return min(max(round((top - y) / step), 0), high - 1)

    numbers = [""] * high
    at = ticks(low, top, max(high // 2, 2))
    for value, label in zip(at, labels(at), strict=True):
        numbers[row(value)] = label
    rows = [[" "] * wide for _ in range(high)]
    if low <= 0.0 <= top:
        rows[row(0.0)] = list(("·" if unicode else ".") * wide)
    if unicode and len(panel.curves) == 1:
        _braille(figure, panel.curves[0], rows, low, top)
    else:
        for curve in panel.curves:
            for x, y in _walk(curve, figure, wide, lambda y: (top - y) / step):
                rows[min(max(y, 0), high - 1)][min(max(x, 0), wide - 1)] = MARKS[curve.number]
    bar = "│" if unicode else "|"
    for label, cells in zip(numbers, rows, strict=True):
        yield f"{label:>{LABEL}} {bar}{''.join(cells)}".rstrip() + "\n"


def _braille(figure: Figure, curve: Curve, rows: list[list[str]], low: float, top: float) -> None:
    """Draw one curve in dots, with twice the resolution of letters across and four times up."""
    high, wide = len(rows), len(rows[0])
    step = (top - low) / (4 * high - 1)
    # The bit of each dot of a Braille letter, from top to bottom, left and right.
    dots = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
    bits: dict[tuple[int, int], int] = {}
    for x, y in _walk(curve, figure, 2 * wide, lambda y: (top - y) / step):
        x, y = min(max(x, 0), 2 * wide - 1), min(max(y, 0), 4 * high - 1)
        bits[y // 4, x // 2] = bits.get((y // 4, x // 2), 0) | dots[y % 4][x % 2]
    for (y, x), letter_bits in bits.items():
        rows[y][x] = chr(0x2800 + letter_bits)  # Unicode's Braille patterns


def _walk(
    curve: Curve, figure: Figure, wide: int, down: Callable[[float], float]
) -> Iterator[tuple[int, int]]:
    """The cells that a curve crosses, jumps included; only the points' cells for points."""
    last = None
    for xs, ys in curve.pieces:
        for x, y in zip(xs, ys, strict=True):
            here = (_across(x, figure, wide), down(y))
            steps = 1
            if last and curve.style != POINTS:
                steps = max(1, *(2 * round(abs(a - b)) for a, b in zip(here, last, strict=True)))
            a, b = last or here
            for i in range(1, steps + 1):
                fraction = i / steps
                yield round(a + fraction * (here[0] - a)), round(b + fraction * (here[1] - b))
            last = here
        last = last if curve.style == LINE else None


def _across(x: float, figure: Figure, wide: int) -> float:
    start, end = figure.window
    return (x - start) / (end - start) * (wide - 1)


def _column(x: float, figure: Figure, wide: int) -> int:
    return min(max(round(_across(x, figure, wide)), 0), wide - 1)


def _below(figure: Figure, wide: int) -> Iterator[str]:
    at = ticks(*figure.window, max(wide // 12, 2), figure.x.unit)
    line = [" "] * (wide + 1)
    free = 0
    for value, label in zip(at, labels(at), strict=True):
        begin = max(_column(value, figure, wide) - len(label) // 2, 0)
        begin = min(begin, wide + 1 - len(label))
        if begin >= free:
            line[begin : begin + len(label)] = label
            free = begin + len(label) + 1
    yield f"{'':>{LABEL}}  {''.join(line)}".rstrip() + "\n"
    yield f"{'':>{LABEL}}  {figure.x.name}\n"
