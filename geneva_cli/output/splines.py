"""Smoothly connected cubics as one B-spline, and so one face over all of them.

Two cubics may meet with a common tangent. A parameter in proportion to their handles then makes the
whole curve once differentiable. So no pole is needed at the joint: n cubics have 2 n + 2 poles, and
the curve is the same. A short arc next to a cubic, such as at the end of a wall in a mouth, also
becomes a cubic, within rounding, so that no sliver of a face is left for it.
"""

import math
from collections.abc import Iterable
from itertools import accumulate
from typing import NamedTuple, TypeAlias

from geneva_cli.geometry.shapes import Arc, Cubic, Line, Point, Segment, as_cubic


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
    curve: list[Piece] = []
    run: list[Cubic] = []
    intervals: list[float] = []
    uneven = 100.0  # greatest ratio of a spline's parameter intervals to its first
    for segment in _softened(list(segments)):
        interval = _interval(run[-1], segment, intervals[-1]) if run else 0.0
        if run and not 1.0 / uneven < interval < uneven:
            interval = 0.0
            curve.append(_spline(run, intervals))
            run, intervals = [], []
        if isinstance(segment, Cubic):
            run.append(segment)
            intervals.append(interval or 1.0)
        else:
            curve.append(segment)
    return [*curve, _spline(run, intervals)] if run else curve


def _softened(segments: list[Segment]) -> list[Segment]:
    """The segments, with short arcs as cubics where they join one."""
    softened = list(segments)
    for i, arc in enumerate(segments):
        # The cubic of an arc errs by 4/27 of the bulge's sixth power: here 1e-12 of the radius.
        if not isinstance(arc, Arc) or abs(arc.bulge) > 0.0137:
            continue
        cubic = as_cubic(arc)
        before = softened[i - 1] if i else None
        after = segments[i + 1] if i + 1 < len(segments) else None
        if (isinstance(before, Cubic) and _interval(before, cubic, 1.0)) or (
            after is not None and _interval(cubic, after, 1.0)
        ):
            softened[i] = cubic
    return softened


def _interval(before: Cubic, after: Segment, interval: float) -> float:
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


def _spline(run: list[Cubic], intervals: list[float]) -> Spline:
    poles = [pole for cubic in run for pole in (cubic.first, cubic.second)]
    knots = tuple(accumulate(intervals, initial=0.0))
    return Spline((run[0].start, *poles, run[-1].end), knots)
