"""The lines and texts that are already on a drawing, as chords, to keep new ones clear of them.

Chords are complex numbers, (n, 2): their starts and ends.
"""

import cmath
import math
from collections.abc import Iterable, Sequence

import numpy as np

from geneva_cli.geometry import shapes
from geneva_cli.geometry.shapes import Arc, Contour, Line, Point, Segment, Shape
from geneva_cli.geometry.sheet import ABOVE, BELOW, Label, Measure
from geneva_cli.numerics.arrays import Array

BESIDE, ON = 3.0, 4.0  # mm: distance of a dimension line to another, and to a line of the part
IN_LINE = 0.1  # mm: lines that overlap by less may be in line with each other


class Board:
    """A drawing's chords, and the boxes of its texts."""

    def __init__(self) -> None:
        self._texts, self._swept = list[Label](), list[Arc]()  # dimension lines that are arcs
        # straight lines of the part, all chords of it, straight dimension lines; dimension lines,
        # leaders and arrows; extension lines; and all
        none: Array = np.empty((0, 2), dtype=complex)
        self._drawn = self.part = self._ruled = self._main = self._extended = self._all = none

    def draw(self, shape: Shape) -> None:
        """Add the lines of a shape."""
        own = chords(shape)
        self._all, self.part = (np.concatenate((a, own)) for a in (self._all, self.part))
        if isinstance(shape, Contour):
            lines = _chords(piece for piece in shape.segments if isinstance(piece, Line))
            self._drawn = np.concatenate((self._drawn, lines))

    def put(self, measure: Measure) -> None:
        """Add a dimension: its lines, arrows and text."""
        self._all = np.concatenate((self._all, _lines(measure)))
        self._main = np.concatenate((self._main, _main(measure)))
        self._extended = np.concatenate((self._extended, _chords(measure.extension_lines)))
        own = measure.lines[0]
        if isinstance(own, Line):
            self._ruled = np.concatenate((self._ruled, _chords([own])))
        elif isinstance(own, Arc):
            self._swept.append(own)
        self._texts.append(measure.label)

    def first(self, candidates: Iterable[Measure], gap: float = 0.6) -> Measure | None:
        """Return the free dimension with the fewest crossings, and add it; None if none is free.

        Its text is ``gap`` mm clear. After the first free one 100 more are tried.
        """
        best, least, left = None, math.inf, 100
        for measure in candidates:
            if not left or not least:
                break
            left -= best is not None
            if not self._is_free(measure, gap):
                continue
            # of others, and lines of the part that it grazes; extension lines may cross each other
            # (ISO 129-1)
            main = _main(measure)
            count = _crossings(main, self._main) + _crossings(main, self._extended)
            count += _crossings(_chords(measure.extension_lines), self._main)
            count += sum(_grazes(piece, self.part) for piece in measure.main_lines)
            if count < least:
                best, least = measure, count
        if best is not None:
            self.put(best)
        return best

    def _is_free(self, measure: Measure, gap: float) -> bool:
        """Return True if a dimension keeps clear of texts, and of lines along its own."""
        own = measure.lines[0]
        if isinstance(own, Arc):
            for other in self._swept:  # arcs side by side
                same = math.dist(own.centre, other.centre) < IN_LINE
                turn = 0.5 * (sum(shapes.legs(other)) - sum(shapes.legs(own))) % math.tau
                overlap = 0.5 * (abs(own.sweep) + abs(other.sweep)) - min(turn, math.tau - turn)
                near = abs(own.radius - other.radius) < BESIDE
                if same and near and overlap * own.radius > IN_LINE:
                    return False
        elif isinstance(own, Line):
            if measure.kind == "length" and _runs_along(own, self._drawn, ON):
                return False
            if _runs_along(own, self._ruled, BESIDE):
                return False
        if _crosses(measure.label, self._all, gap):
            return False
        lines = _lines(measure)
        return not any(_crosses(text, lines, 0.6) for text in self._texts)

    def box(self) -> tuple[float, float, float, float]:
        """Return the bounding box of all lines and texts: x0, y0, x1, y1."""
        x, y = self._all.real, self._all.imag
        return float(x.min()), float(y.min()), float(x.max()), float(y.max())


def chords(shape: Shape) -> Array:
    """Return the chords of a shape."""
    return _chords(shapes.as_contour(shape).segments)


def _beside(line: Line, lines: Array) -> tuple[float, Array, Array]:
    """Return a line's length, and how far chords are along and across it, (n, 2) both."""
    start, long = complex(*line.start), math.dist(*line)
    ahead = (complex(*line.end) - start) / long if long else 1.0
    seen = (lines - start) * np.conj(ahead)
    return long, seen.real, seen.imag


def _runs_along(line: Line, lines: Array, apart: float) -> bool:
    """Return True if a line runs beside one of others, with less than ``apart`` between."""
    long, along, across = _beside(line, lines)
    # a wheel of many slots has thousands of lines: reductions over pairs would take most of a sheet
    (start, end), (one, other) = along.T, np.abs(across).T
    overlap = (np.minimum(start, end) < long - IN_LINE) & (np.maximum(start, end) > IN_LINE)
    return long >= IN_LINE and bool((overlap & (np.maximum(one, other) < apart)).any())


def _grazes(piece: Segment, lines: Array) -> bool:
    """Return True if a straight line lies within 1.5 mm of chords, nearly in their direction."""
    if not isinstance(piece, Line):
        return False
    long, along, across = _beside(piece, lines)
    run, rise = np.diff(along)[:, 0], np.diff(across)[:, 0]
    slope = rise / np.where(run == 0.0, 1.0, run)
    steep = np.abs(rise) > 0.2 * np.abs(run)  # above 11 degrees lines are seen to cross
    # the part of each chord between the ends of the line
    ends = np.clip((along.min(axis=1), along.max(axis=1)), 0.0, long)
    levels = across[:, 0] + slope * (ends - along[:, 0])
    near = (levels.min(axis=0) < 1.5) & (levels.max(axis=0) > -1.5)
    return long >= IN_LINE and bool((near & (ends[1] - ends[0] > IN_LINE) & ~steep).any())


def _chords(pieces: Iterable[Segment]) -> Array:
    rows: list[tuple[complex, complex]] = []
    for piece in pieces:
        # chords of at most 1.5 mm
        long = 0.0 if isinstance(piece, Line) else shapes.segment_length(piece)
        ends = [complex(*p) for p in shapes.points(piece, max(1, math.ceil(long / 1.5)))]
        rows += zip(ends, ends[1:], strict=False)
    return np.array(rows, dtype=complex).reshape(-1, 2)


def _lines(measure: Measure) -> Array:
    """Return the chords of a dimension's lines, arrows and text."""
    rings = [*(one.corners for one in measure.arrows), measure.label.corners]
    return np.concatenate([_chords(measure.lines), *map(_ring, rings)])


def _main(measure: Measure) -> Array:
    """Return the chords of dimension line or leader, and the axes of arrows, without their tips."""
    # dimensions in a row meet with their tips, and a leader touches what it points at
    tip = 0.5  # mm at an end that may lie on another line
    rows = [_chords([piece]) for piece in measure.main_lines]
    for arrow in measure.arrows:
        _, left, right = (complex(*corner) for corner in arrow.corners)
        rows.append(np.array([[complex(*arrow.tip), 0.5 * (left + right)]]))
    for chain in rows:
        for row, end in ((chain[0], 0), (chain[-1], 1)):
            inwards = row[1 - end] - row[end]
            if abs(inwards) > 2.0 * tip:
                row[end] += tip * inwards / abs(inwards)
    return np.concatenate(rows)


def _crossings(some: Array, others: Array) -> int:
    """Return how many pairs of chords, m and n, cross."""
    a, b, c, d = some[:, :1], some[:, 1:], others[:, 0], others[:, 1]
    apart = _side(a, b, c) * _side(a, b, d) < 0.0
    return int((apart & (_side(c, d, a) * _side(c, d, b) < 0.0)).sum())


def _side(a: Array, b: Array, p: Array) -> Array:
    """Return on which side of lines from a to b points are: above 0 on the left."""
    return np.asarray(((b - a).conj() * (p - a)).imag)


def _ring(corners: Sequence[Point]) -> Array:
    """Return the sides of a polygon."""
    ends = np.array([complex(*corner) for corner in corners])
    return np.column_stack((ends, np.roll(ends, -1)))


@np.errstate(divide="ignore", invalid="ignore")
def _crosses(label: Label, lines: Array, gap: float) -> bool:
    """Return True if chords come nearer to a text's box than ``gap`` mm."""
    near = np.ones(len(lines), dtype=bool)  # the few that may
    corners = _ring(label.corners)
    for own, (one, other) in ((corners.real, lines.real.T), (corners.imag, lines.imag.T)):
        near &= np.minimum(one, other) < own.max() + 2.0 * gap
        near &= np.maximum(one, other) > own.min() - 2.0 * gap
    seen = (lines[near] - complex(*label.at)) * cmath.rect(1.0, -label.turn)
    low, high = np.zeros(len(seen)), np.ones(len(seen))
    limits = (
        (seen.real, -gap, label.width + gap),
        (seen.imag, -BELOW * label.height - gap, ABOVE * label.height + gap),
    )
    for place, least, most in limits:
        start, step = place[:, 0], np.diff(place)[:, 0]
        a, b = (least - start) / step, (most - start) / step  # infinite, of a line along the side
        low, high = np.fmax(low, np.fmin(a, b)), np.fmin(high, np.fmax(a, b))
    return bool((low <= high).any())
