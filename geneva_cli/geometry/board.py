"""The lines and texts that are already on a drawing, as chords, to keep new ones clear of them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from geneva_cli.geometry import shapes
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Point, Segment, Shape
from geneva_cli.geometry.sheet import ABOVE, BELOW, Label, Measure
from geneva_cli.numerics.arrays import Array

BESIDE, ON = 3.0, 4.0  # mm: distance of a dimension line to another, and to a line of the part
IN_LINE = 0.1  # mm: lines that overlap by less may be in line with each other


class Board:
    """A drawing's chords, and the boxes of its texts."""

    def __init__(self) -> None:
        self._texts: list[Label] = []
        self._swept: list[Arc] = []  # dimension lines that are arcs
        none: Array = np.empty((0, 4))
        self._drawn, self._part = none, none  # straight lines of the part; all chords of it
        self._ruled = none  # straight dimension lines
        self._main = none  # dimension lines, leaders and arrows
        self._extended = none  # extension lines
        self._all = none

    def draw(self, shape: Shape) -> None:
        """Add the lines of a shape."""
        own = chords(shape)
        self._all, self._part = (np.concatenate((a, own)) for a in (self._all, self._part))
        if isinstance(shape, Contour):
            lines = _chords(piece for piece in shape.segments if isinstance(piece, Line))
            self._drawn = np.concatenate((self._drawn, lines))

    def write(self, label: Label) -> None:
        """Add a text."""
        self._texts.append(label)
        self._all = np.concatenate((self._all, _ring(label.corners)))

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
        self.write(measure.label)

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
            count += sum(_grazes(piece, self._part) for piece in measure.main_lines)
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
        if crosses(measure.label, self._all, gap):
            return False
        lines = np.concatenate((_lines(measure), _ring(measure.label.corners)))
        return not any(crosses(text, lines, 0.6) for text in self._texts)

    def box(self) -> tuple[float, float, float, float]:
        """Return the bounding box of all lines and texts: x0, y0, x1, y1."""
        x, y = self._all[:, ::2], self._all[:, 1::2]
        return float(x.min()), float(y.min()), float(x.max()), float(y.max())


def chords(shape: Shape) -> Array:
    """Return the chords of a shape, (n, 4)."""
    return _chords(shapes.two_arcs(shape) if isinstance(shape, Circle) else shape.segments)


def _beside(line: Line, lines: Array) -> tuple[float, Array, Array]:
    """Return a line's length, and how far chords are along and across it, (n, 2) both."""
    (x, y), (u, v) = line
    long = math.dist(*line)
    c, s = ((u - x) / long, (v - y) / long) if long else (1.0, 0.0)
    dx, dy = lines[:, ::2] - x, lines[:, 1::2] - y
    return long, dx * c + dy * s, dy * c - dx * s


def _runs_along(line: Line, lines: Array, apart: float) -> bool:
    """Return True if a line runs beside one of others, (n, 4), with less than ``apart`` between."""
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
    first = np.clip(along.min(axis=1), 0.0, long)
    last = np.clip(along.max(axis=1), 0.0, long)
    levels = (across[:, 0] + slope * (end - along[:, 0]) for end in (first, last))
    low, high = np.sort(np.stack(list(levels)), axis=0)
    near = (low < 1.5) & (high > -1.5) & (last - first > IN_LINE)
    return long >= IN_LINE and bool((near & ~steep).any())


def _chords(pieces: Iterable[Segment]) -> Array:
    rows: list[tuple[float, float, float, float]] = []
    for piece in pieces:
        # chords of at most 1.5 mm
        long = 0.0 if isinstance(piece, Line) else shapes.segment_length(piece)
        ends = shapes.points(piece, max(1, math.ceil(long / 1.5)))
        rows += [(*p, *q) for p, q in zip(ends, ends[1:], strict=False)]
    return np.array(rows).reshape(-1, 4)


def _lines(measure: Measure) -> Array:
    """Return the chords of a dimension's lines and arrows."""
    return np.concatenate([_chords(measure.lines), *(_ring(one.corners) for one in measure.arrows)])


def _main(measure: Measure) -> Array:
    """Return the chords of dimension line or leader, and the axes of arrows, without their tips."""
    # dimensions in a row meet with their tips, and a leader touches what it points at
    tip = 0.5  # mm at an end that may lie on another line
    rows = [_chords([piece]) for piece in measure.main_lines]
    for arrow in measure.arrows:
        _, left, right = arrow.corners
        back = 0.5 * (left[0] + right[0]), 0.5 * (left[1] + right[1])
        rows.append(_chords([Line(arrow.tip, back)]))
    for chain in rows:
        for end, other in ((slice(0, 2), slice(2, 4)), (slice(2, 4), slice(0, 2))):
            row = chain[0 if end.start == 0 else -1]
            long = float(np.hypot(*(row[other] - row[end])))
            if long > 2.0 * tip:
                row[end] += tip / long * (row[other] - row[end])
    return np.concatenate(rows)


def _crossings(some: Array, others: Array) -> int:
    """Return how many pairs of chords, (m, 4) and (n, 4), cross."""
    a, b = some[:, None, :2], some[:, None, 2:]
    c, d = others[None, :, :2], others[None, :, 2:]
    apart = _side(a, b, c) * _side(a, b, d) < 0.0
    return int((apart & (_side(c, d, a) * _side(c, d, b) < 0.0)).sum())


def _side(a: Array, b: Array, p: Array) -> Array:
    """Return on which side of lines from a to b points are: above 0 on the left."""
    u, v = b - a, p - a
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])


def _ring(corners: Sequence[Point]) -> Array:
    """Return the sides of a polygon, (n, 4)."""
    return np.array([(*p, *q) for p, q in zip(corners, (*corners[1:], corners[0]), strict=True)])


def crosses(label: Label, lines: Array, gap: float = 0.0) -> bool:
    """Return True if chords, (n, 4), come nearer to a text's box than ``gap`` mm."""
    near = np.ones(len(lines), dtype=bool)  # the few that may
    for k, places in enumerate(zip(*label.corners, strict=True)):
        one, other = lines[:, k], lines[:, k + 2]
        near &= np.minimum(one, other) < max(places) + 2.0 * gap
        near &= np.maximum(one, other) > min(places) - 2.0 * gap
    lines = lines[near]
    c, s = math.cos(label.turn), math.sin(label.turn)
    x, y = lines[:, ::2] - label.at[0], lines[:, 1::2] - label.at[1]
    along, up = c * x + s * y, c * y - s * x
    low, high = np.zeros(len(lines)), np.ones(len(lines))
    limits = (
        (along, -gap, label.width + gap),
        (up, -BELOW * label.height - gap, ABOVE * label.height + gap),
    )
    for place, least, most in limits:
        start, step = place[:, 0], place[:, 1] - place[:, 0]
        flat = np.abs(step) < 1e-12
        safe = np.where(flat, 1.0, step)
        a, b = (least - start) / safe, (most - start) / safe
        within = (start >= least) & (start <= most)
        first = np.where(flat, np.where(within, -np.inf, np.inf), np.minimum(a, b))
        last = np.where(flat, np.where(within, np.inf, -np.inf), np.maximum(a, b))
        low, high = np.maximum(low, first), np.minimum(high, last)
    return bool((low <= high).any())
