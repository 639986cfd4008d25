"""Dimensions as they are drawn (ISO 129-1), each as several candidates, the best first.

All lengths are in millimetres on paper, except ``value``, which is that of the part.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from geneva_cli.geometry.shapes import ORIGIN, Circle, Line, Point, Segment, about, two_arcs
from geneva_cli.geometry.sheet import (
    ARROW,
    BELOW,
    LARGE,
    SMALL,
    Arrow,
    Label,
    Measure,
    polar,
    width,
)

PAST = 1.5  # length of an extension line beyond the dimension line
CLEAR = 0.8  # gap from the outline to an extension line, and from a line to its text
LENGTH = ARROW[0]


def linear(
    ends: tuple[Point, Point],
    turn: float,
    levels: Iterable[float],
    text: str,
    value: float,
) -> Iterator[Measure]:
    """Yield candidates of a distance in the direction ``turn``, with its line at some levels.

    A level is a coordinate normal to that direction, from the origin.
    """
    u, n = _axes(turn)
    a, b = sorted((_dot(p, u), _dot(p, n)) for p in ends)
    for level in levels:
        for place in (0.5, 0.25, 0.75, 0.0, 1.0, 2.0, -1.0):
            mark = _linear(a, b, level, turn, place, text)
            if mark is None:
                continue
            lines, arrows, label = mark
            points = (*(_at(u, n, *p) for p in (a, b)), _at(u, n, b[0], level))
            yield Measure("length", points, value, label, lines, arrows, turn)


def _linear(
    a: Point, b: Point, level: float, turn: float, place: float, text: str
) -> tuple[tuple[Segment, ...], tuple[Arrow, ...], Label] | None:
    """Return one candidate; None where the text does not fit between the arrows.

    ``place`` is the fraction of the free length before the text. Below 0 or above 1 the text stands
    beyond one end.
    """
    u, n = _axes(turn)
    long, length = width(text) * SMALL, b[0] - a[0]
    spare = length - long - 2.0 * (LENGTH + CLEAR)
    if 0.0 <= place <= 1.0 and spare < 0.0:
        return None
    inside = length > 3.0 * LENGTH
    low, high = a[0], b[0]
    if not inside:
        low, high = low - 2.5 * LENGTH, high + 2.5 * LENGTH
    start = a[0] + LENGTH + CLEAR + place * spare
    if place > 1.0:
        start = b[0] + (0.5 if inside else 2.5) * LENGTH + CLEAR
        high = start + long + CLEAR
    elif place < 0.0:
        start = a[0] - (0.5 if inside else 2.5) * LENGTH - CLEAR - long
        low = start - CLEAR
    lines = [Line(_at(u, n, low, level), _at(u, n, high, level))]
    for along, across in (a, b):
        side = math.copysign(1.0, level - across)
        if abs(level - across) > CLEAR + PAST:
            begin, end = across + side * CLEAR, level + side * PAST
            lines.append(Line(_at(u, n, along, begin), _at(u, n, along, end)))
    turns = (turn + math.pi, turn) if inside else (turn, turn + math.pi)
    arrows = tuple(
        Arrow(_at(u, n, along, level), out) for (along, _), out in zip((a, b), turns, strict=True)
    )
    return tuple(lines), arrows, _on_line(start, start + long, level, turn, text)


def _on_line(start: float, end: float, level: float, turn: float, text: str) -> Label:
    """Return the text above its line, readable from below or from the right."""
    u, n = _axes(turn)
    off = CLEAR + BELOW * SMALL
    if math.cos(turn) > 1e-9 or (abs(math.cos(turn)) <= 1e-9 and math.sin(turn) > 0.0):
        return Label(text, _at(u, n, start, level + off), SMALL, turn)
    readable = math.remainder(turn + math.pi, math.tau)
    return Label(text, _at(u, n, end, level - off), SMALL, readable)


def angular(
    legs: tuple[float, float],
    begin: float,
    radii: Iterable[float],
    text: str,
    value: float,
) -> Iterator[Measure]:
    """Yield candidates of an angle about the axis, counterclockwise from leg to leg, on arcs.

    Angles are in radians. The extension lines begin at the distance ``begin`` from the axis. An arc
    goes on to a text beyond its legs.
    """
    first, last = legs
    wide = last - first
    for radius in radii:
        inside = radius * wide > 3.0 * LENGTH
        spare = 0.0 if inside else 2.5 * LENGTH / radius
        sides = [Line(polar(ORIGIN, begin, leg), polar(ORIGIN, radius + PAST, leg)) for leg in legs]
        tilt = 0.5 * LENGTH / radius  # an arrow's back lies on the arc
        quarter = 0.5 * math.pi
        turns = (
            (first - quarter + tilt, last + quarter - tilt)
            if inside
            else (first + quarter - tilt, last - quarter + tilt)
        )
        arrows = tuple(
            Arrow(polar(ORIGIN, radius, leg), turn) for leg, turn in zip(legs, turns, strict=True)
        )
        middle = 0.5 * (first + last)
        points = (
            ORIGIN,
            *(polar(ORIGIN, begin, leg) for leg in legs),
            polar(ORIGIN, radius, middle),
        )
        for fraction in (0.5, 0.3, 0.7, -0.3, 1.3):
            at = first + fraction * wide if inside else middle
            start, end = min(first - spare, at), max(last + spare, at)
            arc = about(ORIGIN, radius, start, end - start)
            label = _clear_of(polar(ORIGIN, radius, at), at, text)
            yield Measure("angular", points, value, label, (arc, *sides), arrows)


def _clear_of(p: Point, angle: float, text: str) -> Label:
    """Return an upright text whose box keeps clear of a point, in a direction from it."""
    half = 0.5 * width(text) * SMALL, 0.7 * SMALL
    away = half[0] * abs(math.cos(angle)) + half[1] * abs(math.sin(angle)) + 2.0 * CLEAR
    x, y = polar(p, away, angle)
    return Label(text, (x - half[0], y - 0.4 * SMALL), SMALL)


def diameter(
    centre: Point, radius: float, angles: Iterable[float], text: str, value: float
) -> Iterator[Measure]:
    """Yield candidates of a diameter, with a leader to the circle in one of some directions."""
    for tip, angle, end, label in _leaders(centre, radius, angles, text):
        points = (polar(centre, -radius, angle), tip)
        yield _led("diameter", points, value, tip, end, label)


def radius(
    centre: Point, reach: float, angles: Iterable[float], text: str, value: float
) -> Iterator[Measure]:
    """Yield candidates of a radius, with a leader to the circle in one of some directions."""
    for tip, _, end, label in _leaders(centre, reach, angles, text):
        yield _led("radius", (centre, tip), value, tip, end, label)


def note(tip: Point, text: str) -> Iterator[Measure]:
    """Yield candidates of a text with a leader to a point."""
    for _, _, end, label in _leaders(tip, 0.0, around(), text):
        yield _led("note", (tip,), 0.0, tip, end, label)


def balloon(tip: Point, text: str) -> Iterator[Measure]:
    """Yield candidates of a number in a circle, with a leader to a point, short ones first."""
    radius = 4.0  # mm: two digits fit in
    for length in (8.0, 12.0, 18.0, 27.0, 40.0, 60.0, 90.0):
        for angle in around():
            centre, end = polar(tip, length + radius, angle), polar(tip, length, angle)
            start = centre[0] - 0.5 * width(text) * SMALL, centre[1] - 0.5 * SMALL
            circle = two_arcs(Circle("", centre, radius))
            arrow = Arrow(tip, angle + math.pi)
            label = Label(text, start, SMALL)
            yield Measure("note", (tip,), 0.0, label, (Line(end, tip), *circle), (arrow,))


def section(end: Point, outwards: float, letter: str) -> Iterator[Measure]:
    """Yield candidates of a section's mark beyond one end of its level line, near ones first.

    An arrow points upwards, in which direction the section is seen. ``outwards`` is 1 or -1.
    """
    for far in range(4, 80, 4):  # mm
        x, y = end[0] + outwards * far, end[1]
        lines = Line((x, y - 10.0), (x, y)), Line((x - 3.0 * outwards, y), (x + outwards, y))
        start = x - 0.5 * width(letter) * LARGE, y - 12.0 - LARGE
        arrow = Arrow((x, y), 0.5 * math.pi)
        yield Measure("note", (end,), 0.0, Label(letter, start, LARGE), lines, (arrow,))


def around() -> list[float]:
    """Return directions all round, oblique ones first."""
    directions = [0.25 * math.pi + k * math.tau / 16 for k in range(16)]
    return sorted(directions, key=lambda a: round(abs(abs(math.sin(2.0 * a)) - 0.9), 6))


def within(start: float, end: float, count: int = 9) -> list[float]:
    """Return directions between two, the middle ones first."""
    fractions = sorted(((k + 0.5) / count for k in range(count)), key=lambda s: abs(s - 0.5))
    angles = [start + s * (end - start) for s in fractions]
    # leaders within 0.14 radians of horizontal or vertical would lie on centre lines
    return sorted(angles, key=lambda a: abs(math.sin(2.0 * a)) < 2.0 * 0.14)


def _leaders(
    centre: Point, reach: float, angles: Iterable[float], text: str
) -> Iterator[tuple[Point, float, Point, Label]]:
    """Yield tip, direction, bend and text of leaders, short ones first."""
    directions = list(angles)
    long = width(text) * SMALL
    for length in (6.0, 9.0, 13.0, 18.0, 24.0, 32.0, 42.0, 55.0, 72.0, 95.0, 125.0, 160.0):
        for angle in directions:
            tip = polar(centre, reach, angle)
            for out in (1.0, -1.0) if length < 2.0 * reach else (1.0,):
                end = polar(tip, out * length, angle)
                right = out * math.cos(angle) >= 0.0
                start = end[0] + CLEAR if right else end[0] - CLEAR - long
                yield tip, angle, end, Label(text, (start, end[1] + CLEAR + BELOW * SMALL), SMALL)


def _led(
    kind: str, points: tuple[Point, ...], value: float, tip: Point, end: Point, label: Label
) -> Measure:
    """Return a dimension with a leader from the tip to the line under its text, and that line."""
    left, right = label.at[0] - CLEAR, label.at[0] + label.width + CLEAR
    far = right if abs(end[0] - left) < abs(end[0] - right) else left
    lines = (Line(end, tip), Line(end, (far, end[1])))
    turn = math.atan2(tip[1] - end[1], tip[0] - end[0])
    return Measure(kind, points, value, label, lines, (Arrow(tip, turn),))


def _axes(turn: float) -> tuple[Point, Point]:
    c, s = math.cos(turn), math.sin(turn)
    return (c, s), (-s, c)


def _dot(p: Point, q: Point) -> float:
    return p[0] * q[0] + p[1] * q[1]


def _at(u: Point, n: Point, along: float, across: float) -> Point:
    return along * u[0] + across * n[0], along * u[1] + across * n[1]
