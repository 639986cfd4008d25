"""The convex hull of caps of a sphere: their shortest common boundary.

As on a plane (``hull``), it has arcs of the caps' rims, and great circles that touch two caps.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from geneva_cli.geometry.sphere import (
    Region,
    SphereArc,
    Vector,
    combined,
    cross,
    dot,
    square_to,
    unit,
)
from geneva_cli.numerics.tolerances import SAME_LENGTH


class Cap(NamedTuple):
    """All points within an angle of a point."""

    middle: Vector
    angle: float

    @property
    def region(self) -> Region:
        """The cap as a region."""
        sideways = square_to(self.middle)
        rim = combined(self.middle, math.cos(self.angle), sideways, math.sin(self.angle))
        return Region((SphereArc(self.middle, self.angle, rim, rim),), self.middle)


class Tangent(NamedTuple):
    """A great circle from one cap to another, with all caps on its left."""

    pole: Vector
    to: int
    start: Vector
    end: Vector


def convex_hull(caps: Sequence[Cap]) -> Region:
    """Convex hull of caps that lie within a quarter of the sphere from the first one's middle.

    >>> from geneva_cli.geometry.sphere import place
    >>> two = convex_hull([Cap((0.0, 0.0, 1.0), 0.2), Cap(place(0.6, 0.0), 0.1)])
    >>> [round(arc.angle, 3) for arc in two.boundary]
    [1.571, 0.1, 1.571, 0.2]
    """
    leaving = [list(_tangents(i, caps)) for i in range(len(caps))]
    first = next((tangents[0] for tangents in leaving if tangents), None)
    if first is None:  # one cap holds all others
        return max(caps, key=lambda cap: cap.angle).region
    boundary: list[SphereArc] = []
    here = first
    while True:
        middle, angle = caps[here.to]
        after = min(leaving[here.to], key=lambda t: _turn(middle, here.end, t.start))
        boundary.append(SphereArc(here.pole, 0.5 * math.pi, here.start, here.end))
        boundary.append(SphereArc(middle, angle, here.end, after.start))
        if after is first:
            return Region(tuple(boundary), caps[0].middle)
        here = after


def _tangents(i: int, caps: Sequence[Cap]) -> Iterator[Tangent]:
    """Tangents that leave a cap; of several on one great circle, the one to the farthest cap."""
    candidates: list[tuple[float, Tangent]] = []
    for j in range(len(caps)):
        pole = _pole(caps[i], caps[j]) if j != i else None
        if pole is None or any(dot(pole, c.middle) < math.sin(c.angle) - SAME_LENGTH for c in caps):
            continue
        ends = [unit(combined(caps[k].middle, 1.0, pole, -math.sin(caps[k].angle))) for k in (i, j)]
        candidates.append((dot(*ends), Tangent(pole, j, *ends)))
    for near, one in candidates:
        if not any(far < near and _same(one.pole, other.pole) for far, other in candidates):
            yield one


def _pole(one: Cap, other: Cap) -> Vector | None:
    """Pole of the great circle from one cap to another that has both on its left, or None.

    Its distance from each middle is a quarter of the sphere minus the cap's angle.
    """
    g = dot(one.middle, other.middle)
    square = 1.0 - g * g
    s, t = math.sin(one.angle), math.sin(other.angle)
    if square <= 0.0:
        return None
    a, b = (s - g * t) / square, (t - g * s) / square
    left = (1.0 - (a * s + b * t)) / square
    if left <= SAME_LENGTH * SAME_LENGTH:
        return None  # one cap holds the other
    both = combined(one.middle, a, other.middle, b)
    return unit(combined(both, 1.0, cross(one.middle, other.middle), math.sqrt(left)))


def _turn(middle: Vector, start: Vector, end: Vector) -> float:
    """Angle about a middle from one point of a rim to another, counterclockwise."""
    return SphereArc(middle, 0.0, start, end).sweep


def _same(one: Vector, other: Vector) -> bool:
    return math.dist(one, other) < SAME_LENGTH
