"""The lines and texts that are already on a drawing, as chords, to keep new ones clear of them.

Chords are complex numbers, (n, 2): their starts and ends.
"""

import cmath
import math
from collections.abc import Iterable, Sequence

import numpy as np

from geneva_cli.geometry import shapes
from geneva_cli.geometry.shapes import Line, Point, Segment, Shape
from geneva_cli.geometry.sheet import ABOVE, BELOW, Label, Measure
from geneva_cli.numerics.arrays import Array

BESIDE = 3.0  # mm: distance of a dimension line or leader to lines along it
IN_LINE = 0.1  # mm: lines that overlap by less may be in line with each other
TIP = 0.5  # mm at the ends of a line that may lie on another one


class Board:
    """A drawing's chords, and the boxes of its texts."""

    def __init__(self) -> None:
        self._texts = list[Label]()
        # chords of the part, its straight lines and all dimension lines, lines of dimensions, their
        # extension lines, and all
        none: Array = np.empty((0, 2), dtype=complex)
        self.part = self._ruled = self._main = self._extended = self._all = none

    def draw(self, shape: Shape) -> None:
        """Add the lines of a shape."""
        own = chords(shape)
        self._all, self.part = (np.concatenate((a, own)) for a in (self._all, self.part))
        pieces = shapes.as_contour(shape).segments
        lines = _chords(piece for piece in pieces if isinstance(piece, Line))
        self._ruled = np.concatenate((self._ruled, lines))

    def put(self, measure: Measure) -> None:
        """Add a dimension: its lines, arrows and text."""
        own = _chords(measure.lines[:1])
        self._all = np.concatenate((self._all, _lines(measure)))
        self._ruled = np.concatenate((self._ruled, own))
        self._main = np.concatenate((self._main, _main(measure)))
        self._extended = np.concatenate((self._extended, _chords(measure.extension_lines)))
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
            # extension lines may cross each other (ISO 129-1)
            main, others = _main(measure), np.concatenate((self._main, self._extended))
            count = _crossings(main, others)
            count += _crossings(_chords(measure.extension_lines), self._main)
            count += self._runs_along(measure)
            if count < least:
                best, least = measure, count
        if best is not None:
            self.put(best)
        return best

    def _is_free(self, measure: Measure, gap: float) -> bool:
        """Return True if a dimension keeps clear of texts, and of lines along its own."""
        # a leader may run along other lines if it must
        if measure.kind in ("length", "angular") and self._runs_along(measure):
            return False
        if _crosses(measure.label, self._all, gap):
            return False
        lines = _lines(measure)
        return not any(_crosses(text, lines, 0.6) for text in self._texts)

    def _runs_along(self, measure: Measure) -> bool:
        return _run_along(_chords(measure.lines[:1]), self._ruled)

    def box(self) -> tuple[float, float, float, float]:
        """Return the bounding box of all lines and texts: x0, y0, x1, y1."""
        x, y = self._all.real, self._all.imag
        return float(x.min()), float(y.min()), float(x.max()), float(y.max())


def chords(shape: Shape) -> Array:
    """Return the chords of a shape."""
    return _chords(shapes.as_contour(shape).segments)


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
    """Return the chords of dimension line or leader, without the tips of their arrows."""
    # dimensions in a row meet with their tips, and a leader touches what it points at
    rows = [_chords([piece]) for piece in measure.main_lines]
    for chain in rows:
        ahead = np.sign(chain[:, 1] - chain[:, 0])
        chain[0, 0] += TIP * ahead[0]
        chain[-1, 1] -= TIP * ahead[-1]
    return np.concatenate(rows)


def _run_along(own: Array, lines: Array) -> bool:
    """Return True if some of a line's chords run beside others, nearer than ``BESIDE``."""
    start, step = own[:, :1], np.diff(own)
    seen = (lines[:, None] - start) * np.conj(np.sign(step))  # ahead along each chord
    along, across = seen.real, seen.imag
    overlap = (along.min(axis=2) < np.abs(step[:, 0]) - IN_LINE) & (along.max(axis=2) > IN_LINE)
    level = np.abs(np.diff(across)) < 0.2 * np.abs(np.diff(along))  # others are seen to cross
    return bool((overlap & level[..., 0] & (np.abs(across).min(axis=2) < BESIDE)).any())


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
    seen = (lines - complex(*label.at)) * cmath.rect(1.0, -label.turn)
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
