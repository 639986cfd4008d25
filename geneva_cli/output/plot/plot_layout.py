"""The layout of a figure: panels stacked over one x axis, as lines and texts for SVG and PDF.

Lengths are in px of a page 820 px wide, y downwards.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple, TypeAlias

from geneva_cli.errors import clean, cut
from geneva_cli.figure import LINE, POINTS, Axis, Curve, Figure, Mark, Panel
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.output.text import LETTER, width_of

Point: TypeAlias = tuple[float, float]
Path: TypeAlias = Sequence[Point]
# rest: filled areas; points and dot, a peak: places
Kind: TypeAlias = Literal["rest", "grid", "axis", "curve", "sample", "jump", "points", "dot"]
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
    """The size of a panel, ``LEFT`` and ``ABOVE`` in its block, and the values that it shows."""

    wide: float
    high: float
    window: tuple[float, float]
    span: tuple[float, float]

    def at(self, x: float, y: float) -> Point:
        """Place of a point of a curve."""
        (a, b), (low, top) = self.window, self.span
        right, down = (x - a) / (b - a), (top - y) / (top - low)
        return LEFT + right * self.wide, ABOVE + down * self.high


class Lines(NamedTuple):
    """Lines of a kind; ``number`` is a curve's, and determines its look."""

    kind: Kind
    paths: Sequence[Path]
    number: int = 0


class Words(NamedTuple):
    """A text that stands on its base line."""

    place: Point
    text: str
    size: float = TEXT
    look: Look = "start"


class FigureBlock(NamedTuple):
    """An unbreakable part of a figure from its top downwards; a panel has a name and a frame."""

    high: float
    marks: tuple[Lines | Words, ...]
    name: str = ""
    frame: Frame | None = None


def blocks(figure: Figure) -> Iterator[FigureBlock]:
    """Yield the title with the legend, then each panel; the last panel has the axis."""
    most = int((PAGE - 2.0 * RIGHT) / (LETTER * TITLE))
    title = Words((RIGHT, TITLE + 8.0), cut(clean(figure.title).strip(), most), TITLE, "bold")
    head, high, known = list[Lines | Words]([title]), TITLE + 14.0, figure.curves()
    if len(known) > 1:
        x, high = RIGHT, high + LINE_HEIGHT
        for curve in known.values():
            name = cut(clean(curve.name), 48)
            needs = SAMPLE + 6.0 + TEXT * LETTER * width_of(name) + 18.0
            if x > RIGHT and x + needs > PAGE - RIGHT:
                x, high = RIGHT, high + LINE_HEIGHT + 2.0
            head += (*_sample(curve, x, high, SAMPLE), Words((x + SAMPLE + 6.0, high), name))
            x += needs
    yield FigureBlock(high, tuple(head))
    # a panel's height, by the number of panels
    high = {1: 300.0, 2: 220.0, 3: 160.0}.get(len(figure.panels), 112.0)
    marked = any(curve.marks for panel in figure.panels for curve in panel.curves)
    wide = PAGE - LEFT - (MARKS if marked else RIGHT)
    across = ticks(*figure.window, int(wide / 70.0), figure.x.unit)
    for panel in figure.panels:
        low, top = panel.span()
        space = 0.05 * (top - low) or 0.5 * abs(top) or 1.0  # above and below
        frame = Frame(wide, high, figure.window, (low - space, top + space))
        marks = [*_panel(figure, panel, frame, across), *_peaks(figure, panel, frame, len(known))]
        below = _axis(figure, frame, across) if panel is figure.panels[-1] else ()
        tall = ABOVE + high + (BELOW if below else 0.0)
        yield FigureBlock(tall, (*marks, *below), panel.y.name, frame)


def _axis(figure: Figure, frame: Frame, across: Sequence[float]) -> tuple[Words, ...]:
    """The numbers and the name of the x axis."""
    low, ends = ABOVE + frame.high, [frame.at(v, frame.span[0]) for v in across]
    shown = zip(ends, labels(across), strict=True)
    numbers = (Words((x, low + 15.0), label, look="middle") for (x, _), label in shown)
    text = named(figure.x) + (", dwells shaded" if figure.shaded else "")
    return *numbers, Words((LEFT + 0.5 * frame.wide, low + 34.0), text, look="middle")


def _sample(curve: Curve, x: float, y: float, long: float) -> Iterator[Lines]:
    middle = y - 0.35 * TEXT
    if curve.style != POINTS:
        yield Lines("sample", [[(x, middle), (x + long, middle)]], curve.number)
    if curve.style != LINE:
        yield Lines("points", [[(x + 0.5 * long, middle)]], curve.number)


def _panel(
    figure: Figure, panel: Panel, frame: Frame, across: Sequence[float]
) -> Iterator[Lines | Words]:
    """Yield the grid, the axes with numbers and name, and the curves."""
    up = ticks(*frame.span, int(frame.high / 24.0), panel.y.unit)
    (a, b), (low, top) = frame.window, frame.span
    rests = []
    for c, d in figure.shaded:
        rests.append([frame.at(*p) for p in ((c, low), (c, top), (d, top), (d, low))])
    yield Lines("rest", rests)
    level = [[frame.at(a, v), frame.at(b, v)] for v in up]
    yield Lines("grid", level + [[frame.at(v, top), frame.at(v, low)] for v in across])
    axes = [[frame.at(a, top), frame.at(a, low), frame.at(b, low)]]
    if low < 0.0 < top:
        axes.append([frame.at(a, 0.0), frame.at(b, 0.0)])
    yield Lines("axis", axes)
    for ((_, y), _), label in zip(level, labels(up), strict=True):
        yield Words((LEFT - 6.0, y + 0.35 * SMALL), label, SMALL, "end")
    yield Words((LEFT, ABOVE - 7.0), named(panel.y), look="bold")
    for curve in panel.curves:
        pieces = [list(map(frame.at, *piece)) for piece in curve.pieces]
        if curve.style != POINTS:
            yield Lines("curve", pieces, curve.number)
        if curve.style != LINE:
            points = dict.fromkeys(place for piece in pieces for place in piece)
            yield Lines("points", [[place] for place in points], curve.number)
            continue
        jumps = [[frame.at(x, a), frame.at(x, b)] for x, a, b in curve.jumps()]
        visible = [jump for jump in jumps if abs(jump[1][1] - jump[0][1]) > 0.05]  # px
        yield Lines("jump", visible, curve.number)


def _peaks(figure: Figure, panel: Panel, frame: Frame, known: int) -> Iterator[Lines | Words]:
    """Yield a dot at each peak; its value and place to the right of the panel."""
    x, y = LEFT + frame.wide + 12.0, ABOVE + 0.8 * TEXT
    for curve in panel.curves:
        for mark in curve.marks:
            if mark.y is not None:
                yield Lines("dot", [[frame.at(mark.x, mark.y)]], curve.number)
            if known > 1:
                yield from _sample(curve, x, y, 0.8 * SAMPLE)
            words = mark_text(mark, "°" if figure.x.unit else "")
            yield Words((x + (SAMPLE if known > 1 else 0.0), y), words)
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
