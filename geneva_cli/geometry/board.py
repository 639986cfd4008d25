"""The lines and texts that are already on a drawing, as chords, to keep new ones clear of them.

Chords are complex numbers, (n, 2): their starts and ends.
"""

import cmath
import math
from collections.abc import Iterable

import numpy as np

from geneva_cli.geometry import shapes
from geneva_cli.geometry.shapes import Line, Segment, Shape
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

    def first(self, candidates: Iterable[Measure], gap: float = 0.6) -> Measure | None:
        """Return the free dimension with the fewest crossings, and add it; None if none is free.

        It keeps clear of texts, with its own text by ``gap`` mm, and of lines along its own. After
        the first free one 100 more are tried.
        """
        best, least, left, added = None, math.inf, 100, tuple[Array, ...]()
        for measure in candidates:
            if not left or not least:
                break
            left -= best is not None
            own, lines = _chords(measure.lines[:1]), _lines(measure)
            along = _run_along(own, self._ruled)
            # a leader may run along other lines if it must
            if along and measure.kind in ("length", "angular"):
                continue
            if _crosses(measure.label, self._all, gap):
                continue
            if any(_crosses(text, lines, 0.6) for text in self._texts):
                continue
            # extension lines may cross each other (ISO 129-1)
            main, extended = _main(measure), _chords(measure.extension_lines)
            count = along + _crossings(main, np.concatenate((self._main, self._extended)))
            count += _crossings(extended, self._main)
            if count < least:
                best, least, added = measure, count, (lines, own, main, extended)
        if best is not None:
            self._texts.append(best.label)
            every = zip((self._all, self._ruled, self._main, self._extended), added, strict=True)
            self._all, self._ruled, self._main, self._extended = map(np.concatenate, every)
        return best

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
    corners = [*(one.corners for one in measure.arrows), measure.label.corners]
    rings = (chords(shapes.polygon("", ring)) for ring in corners)
    return np.concatenate([_chords(measure.lines), *rings])


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


@np.errstate(divide="ignore", invalid="ignore")
def _crosses(label: Label, lines: Array, gap: float) -> bool:
    """Return True if chords come nearer to a text's box than ``gap`` mm."""
    seen = (lines - complex(*label.at)) * cmath.rect(1.0, -label.turn)
    place, high = np.array((seen.real, seen.imag)), label.height
    least = np.array(((-gap,), (-BELOW * high - gap,)))
    most = np.array(((label.width + gap,), (ABOVE * high + gap,)))
    start, step = place[..., 0], np.diff(place)[..., 0]
    a, b = (least - start) / step, (most - start) / step  # infinite, of a line along the side
    first, last = np.fmax.reduce(np.fmin(a, b)), np.fmin.reduce(np.fmax(a, b))
    return bool((np.fmax(first, 0.0) <= np.fmin(last, 1.0)).any())
