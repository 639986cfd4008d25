"""A view: one part at a scale, and its dimensions around it."""

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from heapq import merge
from itertools import pairwise, product
from typing import TypeVar

import numpy as np

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.paper import Block
from geneva_cli.drawings.sheet.sized import Fits, degrees
from geneva_cli.geometry import marks, shapes
from geneva_cli.geometry.board import Board
from geneva_cli.geometry.shapes import Arc, Circle, Point, Segment, Shape
from geneva_cli.geometry.sheet import CENTRE, LARGE, SMALL, Label, Measure, line
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.table import in_decimals as length

FIRST, NEXT = 8.0, 7.0  # mm: from the outline to the first dimension line, and between lines
RANKS = 14  # rows of dimension lines that are tried
OVER = 3.0  # mm: length of a centre line beyond its part

T = TypeVar("T")


class View:
    """One part at a scale; points and lengths are in the part's own millimetres.

    Draw all lines before the first dimension: dimensions are placed outside of them.
    """

    def __init__(self, title: str, scale: float, fits: Fits) -> None:
        self.title, self.scale = title, scale
        self.fits = fits  # how the part's sizes are written
        self.shapes: list[Shape] = []
        self.measures: list[Measure] = []
        self.notes: list[str] = []  # below the title: remarks, and dimensions that did not fit
        self.board = Board()

    def draw(self, layer: shapes.Layer, *of_part: Shape) -> None:
        """Draw shapes on a layer."""
        for shape in of_part:
            self._draw(shapes.placed(shape, scale=self.scale)._replace(layer=layer))

    def cross(self, centre: Point, reach: float, turn: float = 0.0) -> None:
        """Draw both centre lines of a circle."""
        over = self.scale * reach + OVER
        for angle in (turn, turn + 0.5 * math.pi):
            ends = (shapes.polar(self._at(centre), side * over, angle) for side in (-1.0, 1.0))
            self._draw(line(CENTRE, *ends))

    def centre_line(self, start: Point, end: Point) -> None:
        """Draw a centre line from one point to another, and a little beyond both."""
        angle = math.atan2(end[1] - start[1], end[0] - start[0])
        a, b = self._at(start), self._at(end)
        self._draw(line(CENTRE, shapes.polar(a, -OVER, angle), shapes.polar(b, OVER, angle)))

    def linear(
        self, p: Point, q: Point, turn: float, text: str = "", where: str = "", near: bool = False
    ) -> None:
        """Draw a distance in a direction, by default its length alone, with ``where`` in a note.

        ``near`` allows a line inside the part's outline.
        """
        ends = self._at(p), self._at(q)
        if turn < SAME_ON_SHEET - math.pi:  # rounding does not choose between -180 and 180 degrees
            turn += math.tau
        value = abs((q[0] - p[0]) * math.cos(turn) + (q[1] - p[1]) * math.sin(turn))
        text, levels = text or length(value), list(self._levels(turn, ends if near else ()))
        self._put(marks.linear(ends, turn, levels, text, value), f"{text} {where}".rstrip())

    def radial(self, p: Point, text: str) -> None:
        """Draw the distance of a point from the origin, inside the part's outline."""
        self.linear((0.0, 0.0), p, math.atan2(p[1], p[0]), text, near=True)

    def places(
        self, centres: Iterable[Point], base: Point, notes: tuple[str, str] = ("", "")
    ) -> None:
        """Draw the distances of points from a base across and up, each once; nearest ones first."""
        points = list(centres)
        for k, turn in ((0, 0.0), (1, 0.5 * math.pi)):
            texts = {length(0.0)}
            for p in sorted(points, key=lambda p: abs(p[k] - base[k])):
                text = length(abs(p[k] - base[k]))
                if text not in texts:
                    texts.add(text)
                    self.linear(base, p, turn, text, notes[k])

    def angles(
        self,
        pairs: Iterable[tuple[float, float]],
        reach: float,
        off: str = "",
        most: float = math.tau,
    ) -> None:
        """Draw the angles, above 0 and below ``most``, between the directions of pairs."""
        shown = ((degrees(b - a) + off, (a, b)) for a, b in pairs if SAME_ON_SHEET < b - a < most)
        for text, some in grouped(shown):
            self.angular(some, reach, reach, text)

    def angular(
        self, pairs: Iterable[tuple[float, float]], begin: float, radius: float, text: str
    ) -> None:
        """Draw an angle about the origin, between one of some pairs of legs, counterclockwise."""
        reach = self.scale * radius
        radii = [reach + FIRST + k * NEXT for k in range(RANKS)]
        start = self.scale * begin + marks.CLEAR
        candidates = (
            mark
            for wide, legs in product(radii, pairs)
            for mark in marks.angular(legs, start, wide, text, math.degrees(legs[1] - legs[0]))
        )
        self._put(candidates, text)

    def radius(self, arcs: Sequence[Arc], text: str) -> None:
        """Draw the radius of one of some arcs."""
        self.diameter(arcs, text, kind="radius")

    def diameter(
        self, rounds: Sequence[Circle | Arc], text: str, where: str = "", kind: str = "diameter"
    ) -> None:
        """Draw the diameter of one of some circles or arcs; ``where`` is added in a note."""
        candidates = []
        # at most 48 equal ones are tried: without a limit the time grows as z squared
        for one in rounds[:: 1 + len(rounds) // 49]:
            turns = marks.around() if isinstance(one, Circle) else marks.within(*shapes.legs(one))
            reach, value = self.scale * one.radius, one.radius * (1.0 + (kind == "diameter"))
            candidates.append(marks.led(kind, self._at(one.centre), reach, turns, text, value))
        self._put(_short_first(candidates), f"{text} {where}".rstrip())

    def radii(self, pieces: Iterable[Segment], besides: float = -1.0) -> None:
        """Draw each radius of the arcs among some pieces, but one, once."""
        arcs = (piece for piece in pieces if isinstance(piece, Arc))
        others = (arc for arc in arcs if abs(arc.radius - besides) > SAME_ON_SHEET)
        # equal radii to 1e-6 mm, so that rounding does not part them
        for text, some in grouped((sized.plain(round(arc.radius, 6), "R "), arc) for arc in others):
            self.radius(some, text)

    def note(self, tip: Point, text: str) -> None:
        """Draw a text that points at a place."""
        self._put(marks.led("note", self._at(tip), 0.0, marks.around(), text), text)

    def balloons(self, tips: Mapping[int, Iterable[Point]]) -> None:
        """Draw each item's number in a circle that points at one of its places."""
        for item, places in sorted(tips.items()):
            candidates = _short_first(marks.balloon(self._at(tip), f"{item}") for tip in places)
            # the gap keeps the circle clear of lines, too
            self._put(candidates, f"item {item} is not marked", gap=3.1)

    def section(self, left: Point, right: Point, letter: str) -> None:
        """Draw where a section along a level line is, between two points and beyond."""
        for end, outwards in ((left, -1.0), (right, 1.0)):
            self._put(marks.section(self._at(end), outwards, letter), f"section {letter}")

    def block(self) -> Block:
        """Return the view with its title below it."""
        x0, y0, x1, y1 = self.board.box()
        labels: list[Label] = []
        low = y0
        for text, height in ((self.title, LARGE), *((note, SMALL) for note in self.notes)):
            low -= 2.2 * height
            wide = Label(text, (0.0, 0.0), height).width
            at = 0.5 * (x0 + x1 - wide)
            labels.append(Label(text, (at, low), height))
            x0, x1 = min(x0, at), max(x1, at + wide)
        box = shapes.Box(x0, low - SMALL, x1, y1)
        return Block(box, tuple(self.shapes), tuple(labels), tuple(self.measures))

    def _put(self, candidates: Iterable[Measure], text: str, gap: float = 0.6) -> None:
        """Add the first candidate that fits, or else a note."""
        measure = self.board.first(candidates, gap)
        if measure is None:
            self.notes.append(text)
        else:
            self.measures.append(measure)

    def _draw(self, shape: Shape) -> None:
        self.shapes.append(shape)
        self.board.draw(shape)

    def _levels(self, turn: float, near: tuple[Point, ...]) -> Iterator[float]:
        """Yield levels for a dimension line, normal to its direction, nearest first."""
        places = np.array([complex(*p) for p in near]) if near else self.board.part[:, 0]
        across = (places * cmath.rect(1.0, -turn)).imag
        low, high = float(across.min()), float(across.max())
        for k in range(2 * RANKS if near else RANKS):
            off = FIRST + (0.5 if near else 1.0) * k * NEXT
            # rounded to 1e-6 mm, so that rounding does not choose between equal distances
            yield from sorted((low - off, high + off), key=lambda level: round(abs(level), 6))

    def _at(self, p: Point) -> Point:
        return self.scale * p[0], self.scale * p[1]


def turns(angles: Sequence[float]) -> Iterator[tuple[float, float]]:
    """Return each direction and the next one, through a whole turn."""
    return pairwise([*angles, angles[0] + math.tau])


def _short_first(rows: Iterable[Iterator[Measure]]) -> Iterator[Measure]:
    """Yield candidates of all rows, in the order of their leaders' length."""
    return merge(*rows, key=lambda m: round(math.dist(*m.lines[0]), 6))


def grouped(named: Iterable[tuple[str, T]]) -> Iterator[tuple[str, list[T]]]:
    """Yield each text once, with the number of its things before it, and these things.

    >>> list(grouped([("R 2", "a"), ("R 5", "b"), ("R 2", "c")]))
    [('2× R 2', ['a', 'c']), ('R 5', ['b'])]
    """
    groups: dict[str, list[T]] = {}
    for text, one in named:
        groups.setdefault(text, []).append(one)
    return ((times(len(some), text), some) for text, some in groups.items())


def times(count: int, text: str) -> str:
    """Return a text with the number of times that the size occurs (ISO 129-1)."""
    return f"{count}× {text}" if count > 1 else text
