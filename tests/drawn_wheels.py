"""Wheels and cranks drawn by hand for tests: slots, rims and recesses as plain arcs and lines."""

import math

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.shapes import Arc, Circle, Line, at, closed, two_arcs

TAU = math.tau


def polar(radius, angle):
    return radius * math.cos(angle), radius * math.sin(angle)


def drawn_wheel(z, bottom, half, rim, recess=None):
    """An external wheel with straight slots along the x axis and on; ``recess`` is (L, radius)."""
    corner = math.asin(half / rim)
    pieces = []
    for k in range(z):
        turn = TAU * k / z
        points = [(math.sqrt(rim**2 - half**2), -half), (bottom, -half), (bottom, half)]
        points.append((points[0][0], half))
        spots = [polar(math.hypot(*p), math.atan2(p[1], p[0]) + turn) for p in points]
        pieces += [Line(*spots[:2]), Arc(spots[1], spots[2], -1.0), Line(*spots[2:])]
        first, last = turn + corner, turn + TAU / z - corner
        middle = turn + math.pi / z
        if recess is None:
            pieces.append(rim_arc(rim, first, last))
            continue
        L, r = recess
        opening = math.acos((L * L + rim * rim - r * r) / (2.0 * L * rim))
        a, b = middle - opening, middle + opening
        centre = polar(L, middle)
        start, end = polar(rim, a), polar(rim, b)
        directions = [math.atan2(p[1] - centre[1], p[0] - centre[0]) for p in (start, end)]
        sweep = math.remainder(directions[1] - directions[0], TAU)
        pieces += [
            rim_arc(rim, first, a),
            Arc(start, end, math.tan(sweep / 4.0)),
            rim_arc(rim, b, last),
        ]
    return closed("WHEEL", pieces)


def rim_arc(rim, start, end):
    return Arc(polar(rim, start), polar(rim, end), math.tan((end - start) / 4.0))


def disc(x, y, radius):
    return closed("CRANK", two_arcs(Circle("CRANK", (x, y), radius)))


def outline(*contours):
    return Polyarc(contours)


def corners(contour, count=24):
    """Points of a contour, ``count`` on each arc."""
    out = []
    for piece in contour.segments:
        n = count if isinstance(piece, Arc) else 1
        out += [at(piece, i / n) for i in range(n)]
    return out
