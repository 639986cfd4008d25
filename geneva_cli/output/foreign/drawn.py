"""A drawing as it was read, and the pieces of its curves."""

import cmath
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.fit import arcs
from geneva_cli.geometry.shapes import Arc, Line, Point, about

CURVE_MM = 1e-4  # greatest distance of the arcs that replace a curve which is no arc


class Drawn(NamedTuple):
    """Lines and arcs of a drawing, mm, and what a user should know about how they were read.

    ``is_exact`` is False if curves were replaced by arcs.
    """

    pieces: tuple[Line | Arc, ...]
    notes: tuple[str, ...] = ()
    is_exact: bool = True


def arc_pieces(centre: Point, radius: float, start: float, sweep: float) -> list[Line | Arc]:
    """Return an arc from a direction on, radians, in parts of at most half a turn."""
    count = max(1, math.ceil(abs(sweep) / math.pi - 1e-12))
    return [about(centre, radius, start + sweep * i / count, sweep / count) for i in range(count)]


def ellipse_pieces(
    centre: complex, axes: tuple[complex, complex], span: tuple[float, float], unit: float = 1.0
) -> list[Line | Arc]:
    """Return an ellipse centre + major cos t + minor sin t from one parameter on, as arcs.

    Both half ``axes``, which may be skewed, are complex numbers. ``span`` has the first parameter
    and how far it goes on, and ``unit`` the millimetres in a unit of the drawing.
    """
    (major, minor), (start, sweep) = axes, span
    way = math.copysign(1.0, (major.conjugate() * minor).imag)
    if abs(minor - way * 1j * major) <= 1e-9 * abs(major):  # a circle
        at = centre.real, centre.imag
        return arc_pieces(at, abs(major), cmath.phase(major) + way * start, way * sweep)

    def curve(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        points = centre + major * np.cos(t) + minor * np.sin(t)
        tangents = minor * np.cos(t) - major * np.sin(t)
        return _pairs(points), _pairs(math.copysign(1.0, sweep) * tangents / np.abs(tangents))

    return list(arcs(curve, start, start + sweep, CURVE_MM / unit))


def bezier_pieces(poles: Sequence[complex]) -> list[Line | Arc]:
    """Return a quadratic or cubic Bézier curve as arcs within ``CURVE_MM``."""
    if len(poles) == 3:
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
