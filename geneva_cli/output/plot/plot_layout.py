"""The layout of a figure: panels stacked over one x axis, for the pens of SVG and PDF.

Lengths are in px of a page 820 px wide, y downwards.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Literal, NamedTuple, Protocol, TypeAlias

from geneva_cli.errors import clean, cut
from geneva_cli.figure import LINE, POINTS, Axis, Curve, Figure, Mark, Panel
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.output.letters import LETTER, width

Point: TypeAlias = tuple[float, float]
Path: TypeAlias = Sequence[Point]
Kind: TypeAlias = Literal["grid", "axis", "curve", "sample", "jump", "points"]
Look: TypeAlias = Literal["start", "middle", "end", "bold"]  # a text's anchor; bold ones start

PAGE = 820.0
INCH = 82.0  # px of the layout in an inch: the page is ten inches wide
LEFT, RIGHT, MARKS = 72.0, 18.0, 192.0  # MARKS: the column of the peaks' values
ABOVE, BELOW = 26.0, 44.0  # a panel's name; the last one's ticks and the axis' name
TITLE, TEXT, SMALL = 15.0, 11.0, 10.0  # heights of letters
LINE_HEIGHT = 14.0
SAMPLE = 30.0  # length of a curve's sample in the legend
SHOWN_DIGITS = 6  # a peak's value has these; an axis has more if labels are equal


class Frame(NamedTuple):
    """A panel's place on the page, and the range of values that it shows."""

    top: float
    wide: float
    high: float
    window: tuple[float, float]
    span: tuple[float, float]

    def x(self, value: float) -> float:
        """Place of an x value."""
        a, b = self.window
        return LEFT + (value - a) / (b - a) * self.wide

    def y(self, value: float) -> float:
        """Place of a y value."""
        low, top = self.span
        return self.top + (top - value) / (top - low) * self.high


class _Pen(Protocol):
    """A surface to draw on; ``number`` is a curve's, and determines its look.

    A panel begins and ends; ``rest`` shades a stretch at rest, ``dot`` marks a peak. Paths of
    points are single places; a text stands on its base line.
    """

    def begin(self, name: str, frame: Frame) -> None: ...
    def end(self) -> None: ...
    def rest(self, x: float, y: float, wide: float, high: float) -> None: ...
    def draw(self, kind: Kind, paths: Iterable[Path], number: int = 0) -> None: ...
    def dot(self, number: int, place: Point) -> None: ...
    def text(self, place: Point, text: str, size: float = TEXT, look: Look = "start") -> None: ...


class FigureBlock(NamedTuple):
    """An unbreakable part of a figure: its height, and ``draw(pen, top)``."""

    high: float
    draw: Callable[[_Pen, float], None]


def blocks(figure: Figure) -> Iterator[FigureBlock]:
    """Yield the title with the legend, then each panel; the last panel has the axis."""
    known = figure.curves()
    legend, high = [], TITLE + 14.0
    if len(known) > 1:
        x, y = RIGHT, TITLE + 14.0 + LINE_HEIGHT
        for curve in known.values():
            name = cut(clean(curve.name), 48)
            needs = SAMPLE + 6.0 + TEXT * width(name) + 18.0
            if x > RIGHT and x + needs > PAGE - RIGHT:
                x, y = RIGHT, y + LINE_HEIGHT + 2.0
            legend.append((curve, x, y, name))
            x += needs
        high = y

    def head(pen: _Pen, top: float) -> None:
        most = int((PAGE - 2.0 * RIGHT) / (LETTER * TITLE))
        pen.text((RIGHT, TITLE + 8.0), cut(clean(figure.title).strip(), most), TITLE, "bold")
        for curve, x, y, name in legend:
            _sample(curve, x, y, SAMPLE, pen)
            pen.text((x + SAMPLE + 6.0, y), name)

    yield FigureBlock(high, head)
    # a panel's height, by the number of panels
    high = {1: 300.0, 2: 220.0, 3: 160.0}.get(len(figure.panels), 112.0)
    marked = any(curve.marks for panel in figure.panels for curve in panel.curves)
    wide = PAGE - LEFT - (MARKS if marked else RIGHT)
    for panel in figure.panels:
        yield _block(figure, panel, wide, high, bool(legend))


def _block(figure: Figure, panel: Panel, wide: float, high: float, several: bool) -> FigureBlock:
    """A panel of one curve or ``several``; the last has the axis."""
    is_last = panel is figure.panels[-1]

    def draw(pen: _Pen, top: float) -> None:
        frame = Frame(top + ABOVE, wide, high, figure.window, padded(panel))
        across = ticks(*figure.window, int(wide / 70.0), figure.x.unit)
        pen.begin(panel.y.name, frame)
        _panel(figure, panel, frame, across, pen)
        _marks(figure, panel, frame, several, pen)
        pen.end()
        if is_last:
            bottom = frame.top + high
            for value, label in zip(across, labels(across), strict=True):
                pen.text((frame.x(value), bottom + 15.0), label, look="middle")
            text = named(figure.x) + (", dwells shaded" if figure.shaded else "")
            pen.text((LEFT + 0.5 * wide, bottom + 34.0), text, look="middle")

    return FigureBlock(ABOVE + high + (BELOW if is_last else 0.0), draw)


def padded(panel: Panel) -> tuple[float, float]:
    """Return a panel's span with some space above and below."""
    low, high = panel.span()
    space = 0.05 * (high - low) or 0.5 * abs(high) or 1.0
    return low - space, high + space


def _sample(curve: Curve, x: float, y: float, long: float, pen: _Pen) -> None:
    middle = y - 0.35 * TEXT
    if curve.style != POINTS:
        pen.draw("sample", [[(x, middle), (x + long, middle)]], curve.number)
    if curve.style != LINE:
        pen.draw("points", [[(x + 0.5 * long, middle)]], curve.number)


def _panel(figure: Figure, panel: Panel, frame: Frame, across: list[float], pen: _Pen) -> None:
    """Draw the grid, the axes with numbers and name, and the curves."""
    up = ticks(*frame.span, int(frame.high / 24.0), panel.y.unit)
    right, bottom = LEFT + frame.wide, frame.top + frame.high
    for a, b in figure.shaded:
        pen.rest(frame.x(a), frame.top, frame.x(b) - frame.x(a), frame.high)
    level = [[(LEFT, frame.y(v)), (right, frame.y(v))] for v in up]
    upright = [[(frame.x(v), frame.top), (frame.x(v), bottom)] for v in across]
    pen.draw("grid", level + upright)
    axes = [[(LEFT, frame.top), (LEFT, bottom), (right, bottom)]]
    if frame.span[0] < 0.0 < frame.span[1]:
        axes.append([(LEFT, frame.y(0.0)), (right, frame.y(0.0))])
    pen.draw("axis", axes)
    for value, label in zip(up, labels(up), strict=True):
        pen.text((LEFT - 6.0, frame.y(value) + 0.35 * SMALL), label, SMALL, "end")
    pen.text((LEFT, frame.top - 7.0), named(panel.y), look="bold")
    for curve in panel.curves:
        pieces = [[(frame.x(x), frame.y(y)) for x, y in zip(*p, strict=True)] for p in curve.pieces]
        if curve.style != POINTS:
            pen.draw("curve", pieces, curve.number)
        if curve.style != LINE:
            pen.draw("points", [[place] for piece in pieces for place in piece], curve.number)
            continue
        jumps = [((frame.x(x), frame.y(a)), (frame.x(x), frame.y(b))) for x, a, b in curve.jumps()]
        visible = [jump for jump in jumps if abs(jump[1][1] - jump[0][1]) > 0.05]  # px
        if visible:
            pen.draw("jump", visible, curve.number)


def _marks(figure: Figure, panel: Panel, frame: Frame, several: bool, pen: _Pen) -> None:
    """Draw a dot at each peak; write its value and place to the right of the panel."""
    x, y = LEFT + frame.wide + 12.0, frame.top + 0.8 * TEXT
    for curve in panel.curves:
        for mark in curve.marks:
            if mark.y is not None:
                pen.dot(curve.number, (frame.x(mark.x), frame.y(mark.y)))
            if several:
                _sample(curve, x, y, 0.8 * SAMPLE, pen)
            words = mark_text(mark, "°" if figure.x.unit else "")
            pen.text((x + (SAMPLE if several else 0.0), y), words)
            y += LINE_HEIGHT


def ticks(low: float, high: float, most: int, unit: str = "") -> list[float]:
    """Multiples of a round step from ``low`` to ``high``, about ``most`` and never more.

    >>> ticks(-0.3, 1.2, 5), ticks(-60.0, 300.0, 9, "deg")
    ([0.0, 0.5, 1.0], [-45.0, 0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0])
    """
    width = high - low
    if not width > 0.0:
        return [low]
    power = 10.0 ** math.floor(math.log10(width / most))
    steps = [n * power for n in (1.0, 2.0, 2.5, 5.0, 10.0, 20.0, 25.0, 50.0, 100.0)]
    if unit == "deg" and width > 40.0:
        steps = [5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0]  # degrees that people use
        steps += [360.0 * 2**n for n in range(60)]
    for step in steps:
        first, last = math.ceil(low / step - ROUNDED), math.floor(high / step + ROUNDED)
        if last - first < most:
            break
    return [float(f"{n * step:.12g}") + 0.0 for n in range(first, last + 1)]


def labels(at: Sequence[float]) -> list[str]:
    """The numbers of an axis, with enough digits that no two are equal.

    >>> labels([0.0, 0.5, 1.0]), labels([0.0, 2e9]), labels([1e7, 1e7 + 0.5])
    (['0', '0.5', '1'], ['0', '2e+09'], ['10000000', '10000000.5'])
    """
    texts: list[str] = []
    for digits in range(SHOWN_DIGITS, 18):
        texts = [f"{x:.{digits}g}" for x in at]
        if len(set(texts)) == len(set(at)):
            break
    return texts


def named(axis: Axis) -> str:
    """An axis with its unit, such as ``Pin force (N)``."""
    return f"{axis.label} ({axis.unit.replace('deg', '°')})" if axis.unit else axis.label


def mark_text(mark: Mark, unit: str = "°") -> str:
    """A mark as text: its value and its place.

    >>> mark_text(Mark("max", -22.903061866, 649.007123))
    'max 649.007 at -22.90°'
    """
    # A larger place is written with an exponent.
    at = f"{mark.x:.2f}" if abs(mark.x) < 1e5 else f"{mark.x:.{SHOWN_DIGITS}g}"
    at = "0.00" if at == "-0.00" else at
    value = "no bound" if mark.y is None else f"{mark.word} {mark.y + 0.0:.{SHOWN_DIGITS}g}"
    return f"{value} at {at}{unit}"
