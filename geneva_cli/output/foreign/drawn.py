"""A drawing as it was read, and the pieces of its curves."""

import cmath
import math
from collections.abc import Callable, Sequence
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
    notes: tuple[str, ...] = ()
    is_exact: bool = True


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
    if len(poles) == 2:
        poles = (poles[0], *poles, poles[1])
    elif len(poles) == 3:
        a, b, c = poles
        poles = (a, a + 2.0 * (b - a) / 3.0, c + 2.0 * (b - c) / 3.0, c)
    p, q, r, s = poles
    size = max(abs(x - p) for x in poles)
    if size == 0.0:
        return []
    chord = s - p
    bend = max(abs(((x - p) * chord.conjugate()).imag) for x in (q, r))
    if abs(chord) and bend <= 1e-9 * size * abs(chord):  # all poles on the chord
        return [Line((p.real, p.imag), (s.real, s.imag))]
    # the tangents where the first or the last handle has no length
    ahead = next(x for x in (q, r, s) if x != p) - p
    behind = s - next(x for x in (r, q, p) if x != s)

    def curve(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        u = 1.0 - t
        points = p * u**3 + 3.0 * q * u * u * t + 3.0 * r * u * t * t + s * t**3
        rate = (q - p) * u * u + 2.0 * (r - q) * u * t + (s - r) * t * t
        near = np.where(t < 0.5, ahead, behind)
        rate = np.where(np.abs(rate) > 1e-12 * size, rate, near)
        return _pairs(points), _pairs(rate / np.abs(rate))

    return list(arcs(curve, 0.0, 1.0, CURVE_MM))


def _pairs(points: np.ndarray) -> np.ndarray:
    return np.column_stack((points.real, points.imag))
