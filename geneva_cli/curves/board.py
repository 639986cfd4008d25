"""The lines and texts that are already on a drawing, to keep new ones clear of them.

Lines are stored as short chords. A new dimension comes as several candidates, each with all its
lines and texts. The first candidate that is free is used.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.curves.measure import at, segment_length
from geneva_cli.curves.shapes import Arc, Circle, Contour, Line, Point, Segment, Shape, two_arcs
from geneva_cli.curves.sheet import ABOVE, BELOW, Label, Measure

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

BESIDE, ON = 3.0, 4.0  # mm: distance of a dimension line to another, and to a line of the part
IN_LINE = 0.1  # mm: lines that overlap by less may be in line with each other


class Board:
    """A drawing's chords, and the boxes of its texts."""

    def __init__(self) -> None:
        self._texts: list[Label] = []
        self._drawn: Array = np.empty((0, 4))  # straight lines of the part
        self._ruled: Array = np.empty((0, 4))  # straight dimension lines
        self._swept: list[Arc] = []  # dimension lines that are arcs
        self._all: Array = np.empty((0, 4))

    def draw(self, shape: Shape) -> None:
        """Add the lines of a shape."""
        self._keep(chords(shape))
        if isinstance(shape, Contour):
            lines = _chords(piece for piece in shape.segments if isinstance(piece, Line))
            self._drawn = np.concatenate((self._drawn, lines))

    def write(self, label: Label) -> None:
        """Add a text."""
        self._texts.append(label)
        self._keep(_edges(label))

    def put(self, measure: Measure) -> None:
        """Add a dimension: its lines, arrows and text."""
        self._keep(_lines(measure))
        own = measure.lines[0]
        if isinstance(own, Line):
            self._ruled = np.concatenate((self._ruled, _chords([own])))
        elif isinstance(own, Arc):
            self._swept.append(own)
        self.write(measure.label)

    def first(self, candidates: Iterable[Measure]) -> Measure | None:
        """Return the first dimension that is free, and add it; None if none is free."""
        for measure in candidates:
            if not self._meets(measure.lines[0]) and self.is_free(measure.label, _lines(measure)):
                self.put(measure)
                return measure
        return None

    def _meets(self, own: Segment) -> bool:
        """Return True if a dimension line runs along another one, or along a line of the part."""
        if isinstance(own, Arc):
            return any(_arcs_together(own, other) for other in self._swept)
        if not isinstance(own, Line):
            return False
        near = ((self._ruled, BESIDE), (self._drawn, ON))
        return any(_runs_along(own, lines, apart) for lines, apart in near)

    def is_free(self, label: Label, lines: Array) -> bool:
        """Return True if a text and its lines meet nothing on the board."""
        gap = 0.6  # mm: distance of a text to its nearest neighbour
        if bool(_inside(label, self._all, gap).any()):
            return False
        own = np.concatenate((lines, _edges(label)))
        return not any(bool(_inside(text, own, gap).any()) for text in self._texts)

    def box(self) -> tuple[float, float, float, float]:
        """Return the bounding box of all lines and texts: x0, y0, x1, y1."""
        x, y = self._all[:, ::2], self._all[:, 1::2]
        return float(x.min()), float(y.min()), float(x.max()), float(y.max())

    def _keep(self, lines: Array) -> None:
        self._all = np.concatenate((self._all, lines))


def crosses(label: Label, lines: Array, gap: float = 0.0) -> bool:
    """Return True if chords, (n, 4), come nearer to a text's box than ``gap`` mm."""
    return bool(_inside(label, lines, gap).any())


def chords(shape: Shape) -> Array:
    """Return the chords of a shape, (n, 4)."""
    if isinstance(shape, Circle):
        return _chords(two_arcs(shape))
    assert isinstance(shape, Contour)
    return _chords(shape.segments)


def _arcs_together(a: Arc, b: Arc) -> bool:
    """Return True if two arcs run side by side with less than ``BESIDE`` between."""
    same = math.dist(a.centre, b.centre) < IN_LINE and abs(a.radius - b.radius) < BESIDE
    turn = (_middle(b) - _middle(a)) % math.tau
    off = min(turn, math.tau - turn)
    return same and (0.5 * (abs(a.sweep) + abs(b.sweep)) - off) * a.radius > IN_LINE


def _runs_along(line: Line, lines: Array, apart: float) -> bool:
    """Return True if a line runs beside one of others, (n, 4), with less than ``apart`` between."""
    (x, y), (u, v) = line
    long = math.dist(*line)
    if long < IN_LINE:
        return False
    c, s = (u - x) / long, (v - y) / long
    dx, dy = lines[:, ::2].T - x, lines[:, 1::2].T - y
    (start, end), (one, other) = dx * c + dy * s, np.abs(dy * c - dx * s)
    # a wheel of many slots has thousands of lines: reductions over pairs would take most of a sheet
    overlap = (np.minimum(start, end) < long - IN_LINE) & (np.maximum(start, end) > IN_LINE)
    return bool((overlap & (np.maximum(one, other) < apart)).any())


def _middle(arc: Arc) -> float:
    """Return the direction of an arc's middle from its centre."""
    (x, y), (u, v) = arc.centre, at(arc, 0.5)
    return math.atan2(v - y, u - x)


def _chords(pieces: Iterable[Segment]) -> Array:
    rows: list[tuple[float, float, float, float]] = []
    for piece in pieces:
        # chords of at most 1.5 mm
        count = 1 if isinstance(piece, Line) else max(1, math.ceil(segment_length(piece) / 1.5))
        points: list[Point] = [at(piece, i / count) for i in range(count + 1)]
        rows += [(*p, *q) for p, q in zip(points, points[1:], strict=False)]
    return np.array(rows).reshape(-1, 4)


def _lines(measure: Measure) -> Array:
    """Return the chords of a dimension's lines and arrows."""
    sides = [
        Line(a, b)
        for arrow in measure.arrows
        for a, b in zip(arrow.corners, (*arrow.corners[1:], arrow.corners[0]), strict=True)
    ]
    return _chords([*measure.lines, *sides])


def _edges(label: Label) -> Array:
    corners = label.corners
    return np.array([(*p, *q) for p, q in zip(corners, (*corners[1:], corners[0]), strict=True)])


def _inside(label: Label, lines: Array, gap: float) -> Array:
    """Return a mask of the chords, (n, 4), that meet the box of a text grown by ``gap``."""
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
    return np.asarray(low <= high)
