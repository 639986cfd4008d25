"""Smoothly connected cubics as one B-spline, and so one face over all of them.

Two cubics may meet with a common tangent. A parameter in proportion to their handles then makes the
whole curve once differentiable. So no pole is needed at the joint: n cubics have 2 n + 2 poles, and
the curve is the same. A short arc next to a cubic, such as at the end of a wall in a mouth, also
becomes a cubic, within rounding, so that no sliver of a face is left for it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple, TypeAlias

from geneva_cli.curves.measure import directions
from geneva_cli.curves.shapes import Arc, Cubic, Line, Point, Segment
from geneva_cli.curves.sheet import polar

# mm: rounding by which a joint may move when the poles beside it determine it
SAME = 1e-11
SHORT = 0.0137  # tan(sweep/4) of an arc whose cubic errs by 4/27 of the sixth power: 1e-12 R
UNEVEN = 1e3  # greatest ratio of adjacent parameter intervals in one spline


class Spline(NamedTuple):
    """A cubic B-spline: its poles, and the ends of its pieces on the parameter, from 0 up."""

    poles: tuple[Point, ...]
    knots: tuple[float, ...]

    @property
    def start(self) -> Point:
        """The first point."""
        return self.poles[0]

    @property
    def end(self) -> Point:
        """The last point."""
        return self.poles[-1]


Piece: TypeAlias = Line | Arc | Spline


def pieces(segments: Iterable[Segment]) -> list[Piece]:
    """The segments of a curve, with its cubics as few splines.

    >>> first = Cubic((0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 1.0))
    >>> after = Cubic((3.0, 1.0), (5.0, 3.0), (6.0, 3.0), (7.0, 3.0))
    >>> pieces([first, after])[0].knots  # handles of the second are twice as long there
    (0.0, 1.0, 3.0)
    """
    found: list[Piece] = []
    run: list[Cubic] = []
    shares: list[float] = []
    for segment in _softened(list(segments)):
        share = _share(run[-1], segment, shares[-1]) if run else 0.0
        if run and not share:
            found.append(_spline(run, shares))
            run, shares = [], []
        if isinstance(segment, Cubic):
            run.append(segment)
            shares.append(share or 1.0)
        else:
            found.append(segment)
    return [*found, _spline(run, shares)] if run else found


def _softened(segments: list[Segment]) -> list[Segment]:
    """The segments, with short arcs as cubics where they join one."""
    found = list(segments)
    for i, arc in enumerate(segments):
        if not isinstance(arc, Arc) or abs(arc.bulge) > SHORT:
            continue
        cubic = _cubic(arc)
        before, after = found[i - 1] if i else None, segments[i + 1] if i + 1 < len(found) else None
        if (isinstance(before, Cubic) and _share(before, cubic, 1.0)) or (
            after is not None and _share(cubic, after, 1.0)
        ):
            found[i] = cubic
    return found


def _cubic(arc: Arc) -> Cubic:
    """The cubic with an arc's ends and tangents, and its middle."""
    first, last = directions(arc)
    handle = 4.0 / 3.0 * abs(arc.bulge) * arc.radius
    return Cubic(arc.start, polar(arc.start, handle, first), polar(arc.end, -handle, last), arc.end)


def _share(before: Cubic, after: Segment, share: float) -> float:
    """The parameter interval of the next segment after ``before``; 0 if it does not continue it."""
    if not isinstance(after, Cubic):
        return 0.0
    back, on = math.dist(before.second, before.end), math.dist(after.start, after.first)
    if not back < UNEVEN * on < UNEVEN * UNEVEN * back:
        return 0.0
    between = tuple(
        (p * on + q * back) / (back + on) for p, q in zip(before.second, after.first, strict=True)
    )
    return share * on / back if math.dist(between, after.start) < SAME else 0.0


def _spline(run: list[Cubic], shares: list[float]) -> Spline:
    poles = [pole for cubic in run for pole in (cubic.first, cubic.second)]
    knots = [0.0]
    for share in shares:
        knots.append(knots[-1] + share)
    return Spline((run[0].start, *poles, run[-1].end), tuple(knots))
