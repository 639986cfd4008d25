"""A curve as cubic Béziers with common tangents, in few pieces.

With handles by least squares the error is of the sixth power of the length. It is measured along
the normal, so that a point may slide along the cubic.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.fit.arcs import Curve, CurvePath, fewest, points_of
from geneva_cli.geometry.shapes import Cubic
from geneva_cli.numerics.arrays import Array

SHORTEST, LONGEST = 1e-4, 1.0  # handles, in lengths of the piece: none is lost, none loops


class FitTargets(NamedTuple):
    """Targets of the cubics: samples moved to each start and scaled by the curve's length."""

    length: Array  # (n,) mm
    points: Array  # (n, samples + 1) complex
    ahead: Array  # complex: tangents at the start; ``behind`` at the end
    behind: Array


def cubics(curve: Curve, a: float, b: float, tolerance: float) -> list[Cubic]:
    """Cubic Béziers within ``tolerance`` mm of the curve, which meet on it with its tangents."""
    corners = fewest(CurvePath(curve, a, b, tolerance), _cubics, 6.0)
    return [Cubic(*row) for row in zip(*map(points_of, corners), strict=True)]


def _cubics(path: CurvePath, places: Array) -> tuple[tuple[Array, Array, Array, Array], Array]:
    """Control points of cubics between places, and the error of each in mm."""
    # 48 samples in a piece
    z, tangent = path.inside(places, 48)
    length = np.abs(np.diff(z, axis=1)).sum(axis=1)
    points = (z - z[:, :1]) / length[:, None]
    wanted = FitTargets(length, points, tangent[:, :1], tangent[:, -1:])
    handles = _handles(wanted)
    reach = handles * length[:, None]
    first = z[:, 0] + reach[:, 0] * tangent[:, 0]
    second = z[:, -1] - reach[:, 1] * tangent[:, -1]
    return (z[:, 0], first, second, z[:, -1]), _misses(wanted, handles)


def _handles(wanted: FitTargets) -> Array:
    """Handles of the nearest cubics, (n, 2), in lengths of the piece."""
    # At a cusp, and elsewhere, the place w is nearly proportional to the cubic's own parameter.
    v = np.broadcast_to(np.linspace(0.0, 1.0, wanted.points.shape[1]), wanted.points.shape)
    u = 1.0 - v
    fixed = wanted.points - v * v * (3.0 - 2.0 * v) * wanted.points[:, -1:]
    first, second = 3.0 * v * u * u * wanted.ahead, -3.0 * v * v * u * wanted.behind
    handles = np.clip(_least_squares(first, second, fixed, 0.0), 0.05, 0.8)
    v, left = _near(wanted, handles, v)
    # the first step in the handles' difference is damped by 1e-3
    damping = np.full(len(v), 1e-3)
    # 6 steps of least squares
    for _ in range(6):
        trial = _improved(wanted, handles, v, damping)
        at, error = _near(wanted, trial, v)
        # a damping of 1e9 leaves their difference as it is
        trial = _improved(wanted, trial, at, 1e9)
        at, error = _near(wanted, trial, at)
        better = error < left
        damping *= np.where(better, 0.02, 10.0)
        handles, v = (np.where(better[:, None], *pair) for pair in ((trial, handles), (at, v)))
        left = np.minimum(error, left)
    return handles


def _misses(wanted: FitTargets, handles: Array) -> Array:
    """Distances of the samples from the cubics, mm; the piece's length if they prove nothing."""
    v = np.broadcast_to(np.linspace(0.0, 1.0, wanted.points.shape[1]), wanted.points.shape)
    # 6 Newton steps to the places nearest to the samples
    for _ in range(6):
        v = _projected(wanted, handles, v)
    miss = np.abs(wanted.points - _bezier(wanted, handles, v)[0]).max(axis=1)
    # Nearest points that run back and forth do not prove that the whole cubic is near.
    miss[(np.diff(v, axis=1) < 0.0).any(axis=1)] = 1.0
    return wanted.length * miss


def _bezier(wanted: FitTargets, handles: Array, v: Array) -> tuple[Array, Array, Array]:
    """Points of the scaled cubics and their first two derivatives, complex."""
    end = wanted.points[:, -1:]
    first, second = handles[:, :1] * wanted.ahead, end - handles[:, 1:] * wanted.behind
    third = end - 3.0 * (second - first)
    bow = 3.0 * (second - 2.0 * first)
    return (
        v * (3.0 * first + v * (bow + v * third)),
        3.0 * first + v * (2.0 * bow + v * (3.0 * third)),
        2.0 * bow + v * (6.0 * third),
    )


def _least_squares(first: Array, second: Array, wanted: Array, damping: Array | float) -> Array:
    """Real factors of two columns that come nearest to the target, in each row."""
    a, d = (np.abs(first) ** 2).sum(axis=1), (np.abs(second) ** 2).sum(axis=1)
    b = (first * second.conj()).real.sum(axis=1)
    a, d = a + 1e-30, d * (1.0 + damping) + 1e-30
    p, q = (first * wanted.conj()).real.sum(axis=1), (second * wanted.conj()).real.sum(axis=1)
    return np.stack((d * p - b * q, a * q - b * p), axis=1) / (a * d - b * b)[:, None]


def _projected(wanted: FitTargets, handles: Array, v: Array) -> Array:
    """Places on the cubics nearest to the samples, after one more step of Newton's method."""
    point, rate, bend = _bezier(wanted, handles, v)
    off = wanted.points - point
    slope = np.abs(rate) ** 2
    # at least half the slope, so that a step reduces the distance from any start
    steep = np.maximum(slope - (off * bend.conj()).real, 0.5 * slope)
    return np.clip(v + (off * rate.conj()).real / np.maximum(steep, 1e-300), 0.0, 1.0)


def _near(wanted: FitTargets, handles: Array, v: Array) -> tuple[Array, Array]:
    """Places of the samples on cubics with these handles, from those on others; squared errors."""
    for _ in range(2):
        v = _projected(wanted, handles, v)
    off = wanted.points - _bezier(wanted, handles, v)[0]
    return v, (np.abs(off) ** 2).sum(axis=1)


def _improved(wanted: FitTargets, handles: Array, v: Array, damping: Array | float) -> Array:
    """Handles with smaller squared distances along the normals.

    On a short piece both handles bow it alike, and their difference matters much less: the valley
    of the error is narrow and bent. So only the difference is damped.
    """
    u = 1.0 - v
    point, rate, _ = _bezier(wanted, handles, v)
    turned = -1j * rate.conj() / np.maximum(np.abs(rate), 1e-300)
    off = ((wanted.points - point) * turned).real
    first = 3.0 * v * u * u * (wanted.ahead * turned).real
    second = -3.0 * v * v * u * (wanted.behind * turned).real
    both, apart = _least_squares(first + second, first - second, off, damping).T
    step = np.stack((both + apart, both - apart), axis=1)
    return np.clip(handles + step, SHORTEST, LONGEST)
