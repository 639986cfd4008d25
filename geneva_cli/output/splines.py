"""Smoothly connected cubics as one B-spline, and so one face over all of them.

Two cubics may meet with a common tangent. A parameter in proportion to their handles then makes the
whole curve once differentiable. So no pole is needed at the joint: n cubics have 2 n + 2 poles, and
the curve is the same.
"""

import math
from collections.abc import Iterable
from itertools import accumulate
from typing import NamedTuple, TypeAlias

from geneva_cli.geometry.shapes import Arc, Cubic, Line, Point, Segment


class Spline(NamedTuple):
    """A cubic B-spline: its poles, and the ends of its pieces on the parameter, from 0 up."""

    poles: tuple[Point, ...]
    knots: tuple[float, ...]

    @property
    def start(self) -> Point:
        """The first point."""
        return self.poles[0]


Piece: TypeAlias = Line | Arc | Spline


def pieces(segments: Iterable[Segment]) -> list[Piece]:
    """The segments of a curve, with its cubics as few splines.

    >>> first = Cubic((0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 1.0))
    >>> after = Cubic((3.0, 1.0), (5.0, 3.0), (6.0, 3.0), (7.0, 3.0))
    >>> pieces([first, after])[0].knots  # handles of the second are twice as long there
    (0.0, 1.0, 3.0)
    """
    curve: list[Line | Arc | list[tuple[Cubic, float]]] = []
    for segment in segments:
        run = curve[-1] if curve else None
        interval = _interval(*run[-1], segment) if isinstance(run, list) else 0.0
        # parameters that are less even lose digits
        if isinstance(segment, Cubic) and isinstance(run, list) and 0.01 < interval < 100.0:
            run.append((segment, interval))
        else:
            curve.append([(segment, 1.0)] if isinstance(segment, Cubic) else segment)
    return [_spline(one) if isinstance(one, list) else one for one in curve]


def _interval(before: Cubic, interval: float, after: Segment) -> float:
    """The parameter interval of the next segment after ``before``; 0 if it does not continue it."""
    if not isinstance(after, Cubic):
        return 0.0
    back, on = math.dist(before.second, before.end), math.dist(after.start, after.first)
    if not min(back, on) > 1e-9:  # mm: a handle without a direction
        return 0.0
    between = tuple(
        (p * on + q * back) / (back + on) for p, q in zip(before.second, after.first, strict=True)
    )
    # 1e-11 mm: rounding by which a joint may move when the adjacent poles determine it
    return interval * on / back if math.dist(between, after.start) < 1e-11 else 0.0


def _spline(run: list[tuple[Cubic, float]]) -> Spline:
    poles = [pole for cubic, _ in run for pole in (cubic.first, cubic.second)]
    knots = tuple(accumulate((interval for _, interval in run), initial=0.0))
    return Spline((run[0][0].start, *poles, run[-1][0].end), knots)
