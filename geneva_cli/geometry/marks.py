"""Dimensions as they are drawn (ISO 129-1), each as several candidates, the best first.

All lengths are in millimetres on paper, except ``value``, which is that of the part.
"""

import cmath
import math
from collections.abc import Iterable, Iterator

from geneva_cli.geometry import sheet
from geneva_cli.geometry.shapes import ORIGIN, Circle, Line, Point, about, polar, two_arcs

PAST = 1.5  # length of an extension line beyond the dimension line
CLEAR = 0.8  # gap from the outline to an extension line, and from a line to its text
LENGTH = sheet.ARROW[0]


def linear(
    ends: tuple[Point, Point], turn: float, levels: Iterable[float], text: str, value: float
) -> Iterator[sheet.Measure]:
    """Yield candidates of a distance in the direction ``turn``, with its line at some levels."""
    u = cmath.rect(1.0, turn)

    def at(along: float, across: float) -> Point:
        place = complex(along, across) * u
        return place.real, place.imag

    seen = (complex(*p) * u.conjugate() for p in ends)
    a, b = sorted((p.real, p.imag) for p in seen)
    long, length = sheet.width(text) * sheet.SMALL, b[0] - a[0]
    inside = length > 3.0 * LENGTH
    beyond = 0.0 if inside else 2.5 * LENGTH  # of the dimension line
    turns = (turn + math.pi, turn) if inside else (turn, turn + math.pi)
    # where the text begins: between the arrows at fractions of the free length, or beyond one end
    spare, aside = length - long - 2.0 * (LENGTH + CLEAR), (beyond or 0.5 * LENGTH) + CLEAR
    fractions = (0.5, 0.25, 0.75, 0.0, 1.0) if spare >= 0.0 else ()
    starts = [a[0] + LENGTH + CLEAR + fraction * spare for fraction in fractions]
    starts += [b[0] + aside, a[0] - aside - long]
    # it is above its line, readable from below or from the right
    down = u.real < -1e-9 or (u.real <= 1e-9 and u.imag <= 0.0)
    off = (CLEAR + sheet.BELOW * sheet.SMALL) * (-1.0 if down else 1.0)
    readable = math.remainder(turn + math.pi, math.tau) if down else turn
    for level in levels:
        arrows = sheet.Arrow(at(a[0], level), turns[0]), sheet.Arrow(at(b[0], level), turns[1])
        extensions = []
        for along, across in (a, b):
            side = math.copysign(1.0, level - across)
            if abs(level - across) > CLEAR + PAST:
                begin, end = across + side * CLEAR, level + side * PAST
                extensions.append(Line(at(along, begin), at(along, end)))
        points = at(*a), at(*b), at(b[0], level)
        for start in starts:
            low, high = min(a[0] - beyond, start - CLEAR), max(b[0] + beyond, start + long + CLEAR)
            first = at(start + long if down else start, level + off)
            label = sheet.Label(text, first, sheet.SMALL, readable)
            lines = (Line(at(low, level), at(high, level)), *extensions)
            yield sheet.Measure("length", points, value, label, lines, arrows, turn)


def angular(
    legs: tuple[float, float], begin: float, radius: float, text: str, value: float
) -> Iterator[sheet.Measure]:
    """Yield candidates of an angle about the axis, counterclockwise from leg to leg, on an arc.

    The extension lines begin at the distance ``begin``. The arc goes on to a text beyond its legs.
    """
    first, last = legs
    wide, middle = last - first, 0.5 * (first + last)
    inside = radius * wide > 3.0 * LENGTH
    spare = 0.0 if inside else 2.5 * LENGTH / radius
    starts = [polar(ORIGIN, begin, leg) for leg in legs]
    sides = [Line(p, polar(ORIGIN, radius + PAST, a)) for p, a in zip(starts, legs, strict=True)]
    # an arrow's back lies on the arc
    lean = (0.5 * math.pi - 0.5 * LENGTH / radius) * (1.0 if inside else -1.0)
    turned = (first, first - lean), (last, last + lean)
    arrows = tuple(sheet.Arrow(polar(ORIGIN, radius, leg), turn) for leg, turn in turned)
    points = ORIGIN, *starts, polar(ORIGIN, radius, middle)
    for fraction in (0.5, 0.3, 0.7, -0.3, 1.3):
        at = first + fraction * wide if inside else middle
        start, end = min(first - spare, at), max(last + spare, at)
        arc = about(ORIGIN, radius, start, end - start)
        # an upright text whose box keeps clear of the arc
        half = 0.5 * sheet.width(text) * sheet.SMALL, 0.7 * sheet.SMALL
        away = half[0] * abs(math.cos(at)) + half[1] * abs(math.sin(at)) + 2.0 * CLEAR
        x, y = polar(polar(ORIGIN, radius, at), away, at)
        label = sheet.Label(text, (x - half[0], y - 0.4 * sheet.SMALL), sheet.SMALL)
        yield sheet.Measure("angular", points, value, label, (arc, *sides), arrows)


def balloon(tip: Point, text: str) -> Iterator[sheet.Measure]:
    """Yield candidates of a number in a circle, with a leader to a point, short ones first."""
    radius = 4.0  # mm: two digits fit in
    for length in (8.0, 12.0, 18.0, 27.0, 40.0, 60.0, 90.0):
        for angle in around():
            centre, end = polar(tip, length + radius, angle), polar(tip, length, angle)
            start = centre[0] - 0.5 * sheet.width(text) * sheet.SMALL, centre[1] - 0.5 * sheet.SMALL
            circle = two_arcs(Circle("", centre, radius))
            arrow = sheet.Arrow(tip, angle + math.pi)
            label = sheet.Label(text, start, sheet.SMALL)
            yield sheet.Measure("note", (tip,), 0.0, label, (Line(end, tip), *circle), (arrow,))


def section(end: Point, outwards: float, letter: str) -> Iterator[sheet.Measure]:
    """Yield candidates of a section's mark beyond an end of its line, right (1) or left (-1)."""
    for far in range(4, 80, 4):  # mm
        x, y = end[0] + outwards * far, end[1]
        lines = Line((x, y - 10.0), (x, y)), Line((x - 3.0 * outwards, y), (x + outwards, y))
        start = x - 0.5 * sheet.width(letter) * sheet.LARGE, y - 12.0 - sheet.LARGE
        arrow, label = sheet.Arrow((x, y), 0.5 * math.pi), sheet.Label(letter, start, sheet.LARGE)
        yield sheet.Measure("note", (end,), 0.0, label, lines, (arrow,))


def around() -> list[float]:
    """Return directions all round, oblique ones first."""
    directions = [0.25 * math.pi + k * math.tau / 16 for k in range(16)]
    return sorted(directions, key=lambda a: round(abs(abs(math.sin(2.0 * a)) - 0.9), 6))


def within(start: float, end: float) -> list[float]:
    """Return directions between two, the middle ones first."""
    angles = [start + k / 18 * (end - start) for k in (9, 7, 11, 5, 13, 3, 15, 1, 17)]
    # leaders within 0.14 radians of horizontal or vertical would lie on centre lines
    return sorted(angles, key=lambda a: abs(math.sin(2.0 * a)) < 2.0 * 0.14)


def led(
    kind: str, centre: Point, reach: float, angles: Iterable[float], text: str, value: float = 0.0
) -> Iterator[sheet.Measure]:
    """Yield candidates with a leader to a circle, and a line under the text, short ones first.

    They are a "diameter", a "radius", or a "note" on a point, with ``reach`` 0.
    """
    directions, long = list(angles), sheet.width(text) * sheet.SMALL
    for length in (6.0, 9.0, 13.0, 18.0, 24.0, 32.0, 42.0, 55.0, 72.0, 95.0, 125.0, 160.0):
        for angle in directions:
            tip = polar(centre, reach, angle)
            points = {"diameter": (polar(centre, -reach, angle), tip), "radius": (centre, tip)}
            for out in (1.0, -1.0) if length < 2.0 * reach else (1.0,):
                end = polar(tip, out * length, angle)
                right = out * math.cos(angle) >= 0.0
                start = end[0] + CLEAR if right else end[0] - CLEAR - long
                first = start, end[1] + CLEAR + sheet.BELOW * sheet.SMALL
                label = sheet.Label(text, first, sheet.SMALL)
                far = start + long + CLEAR if right else start - CLEAR
                lines = (Line(end, tip), Line(end, (far, end[1])))
                arrow = sheet.Arrow(tip, angle + math.pi if out > 0.0 else angle)
                yield sheet.Measure(kind, points.get(kind, (tip,)), value, label, lines, (arrow,))
