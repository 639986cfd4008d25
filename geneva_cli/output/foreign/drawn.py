"""A drawing as it was read, and the pieces of its curves."""

import cmath
import math
from collections.abc import Callable, Sequence
from itertools import chain, pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.fit import arcs
from geneva_cli.geometry.shapes import Arc, Line, about

CURVE_MM = 1e-4  # greatest distance of the arcs that replace a curve which is no arc


class Drawn(NamedTuple):
    """Lines and arcs of a drawing, mm, and what a user should know about how they were read.

    ``is_exact`` is False if curves were replaced by arcs.
    """

    pieces: tuple[Line | Arc, ...]
    notes: tuple[str, ...]
    is_exact: bool


class Ellipse(NamedTuple):
    """A part of an ellipse centre + major cos t + minor sin t, from the parameter ``start`` on.

    Its half axes, which may be skewed, are complex numbers.
    """

    centre: complex
    major: complex
    minor: complex
    start: float = 0.0
    sweep: float = math.tau


# a part of an ellipse, or the poles of a line or a Bézier curve, as complex numbers
Curve: TypeAlias = Ellipse | Sequence[complex]
Traced: TypeAlias = tuple[list[Line | Arc], bool]
Frame: TypeAlias = Callable[[complex], complex]  # where a point of a drawing is, mm


def drawing(rows: Sequence[Traced], notes: tuple[str, ...]) -> Drawn:
    """Return the drawing of some curves as they were traced."""
    pieces = tuple(chain.from_iterable(own for own, _ in rows))
    return Drawn(pieces, notes, all(is_exact for _, is_exact in rows))


def traced(curve: Curve, frame: Frame) -> Traced:
    """Return a curve as lines and arcs within ``CURVE_MM``, and whether they are the curve."""
    if not isinstance(curve, Ellipse):
        return _bezier([*map(frame, curve)]), len(curve) == 2
    major, minor = (frame(half) - frame(0j) for half in curve[1:3])
    if abs((major.conjugate() * minor).imag) <= 1e-9 * max(abs(major), abs(minor)) ** 2:
        raise GenevaError("a circle or ellipse has no width: remove it")
    return _ellipse(Ellipse(frame(curve.centre), major, minor, *curve[3:]))


def _ellipse(own: Ellipse) -> Traced:
    centre, major, minor, start, sweep = own
    way = math.copysign(1.0, (major.conjugate() * minor).imag)
    if abs(minor - way * 1j * major) <= 1e-9 * abs(major):  # a circle
        first, at = cmath.phase(major) + way * start, (centre.real, centre.imag)
        count = max(1, math.ceil(abs(sweep) / math.pi - 1e-12))  # parts of at most half a turn
        part = way * sweep / count
        return [about(at, abs(major), first + part * i, part) for i in range(count)], True

    def curve(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        points = centre + major * np.cos(t) + minor * np.sin(t)
        tangents = minor * np.cos(t) - major * np.sin(t)
        return _pairs(points), _pairs(math.copysign(1.0, sweep) * tangents / np.abs(tangents))

    return list(arcs(curve, start, start + sweep, CURVE_MM)), False


def _bezier(poles: Sequence[complex]) -> list[Line | Arc]:
    start, *_, end = poles
    chord, size = end - start, max(abs(pole - start) for pole in poles)
    if size == 0.0:
        return []
    bend = max(abs(((pole - start) * chord.conjugate()).imag) for pole in poles)
    if abs(chord) and bend <= 1e-9 * size * abs(chord):  # all poles on the chord
        return [Line((start.real, start.imag), (end.real, end.imag))]
    # the tangents where the first or the last handle has no length
    ahead = next(pole for pole in poles if pole != start) - start
    behind = end - next(pole for pole in reversed(poles) if pole != end)

    def curve(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        points = [pole + 0.0 * t for pole in poles]
        while len(points) > 2:  # de Casteljau's construction
            points = [a + t * (b - a) for a, b in pairwise(points)]
        p, q = points
        rate = np.where(np.abs(q - p) > 1e-12 * size, q - p, np.where(t < 0.5, ahead, behind))
        return _pairs(p + t * (q - p)), _pairs(rate / np.abs(rate))

    return list(arcs(curve, 0.0, 1.0, CURVE_MM))


def _pairs(points: np.ndarray) -> np.ndarray:
    return np.column_stack((points.real, points.imag))
