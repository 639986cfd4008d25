"""A smooth curve to be fitted, and the fewest pieces that stay within its tolerance.

Points and tangents are complex numbers here, so that a product rotates one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias, TypeVar

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.numerics.arrays import Array

Curve: TypeAlias = Callable[[Array], tuple[Array, Array]]

PIECES_MAX = 100_000
# Processors differ in the last bits of sines and products. Steps as coarse as these hide that, so
# that joints are at the same places everywhere.
PLACE = 2.0**-26  # of the whole path
WEIGHT = 2.0**-7

Pieces = TypeVar("Pieces")


class CurvePath:
    """A curve between two parameters; a place on it is a number w from 0 to 1.

    Equal steps of w are equal fractions of length plus turning. So the speed of the curve's own
    parameter may go to zero at an end, and the curvature may go to infinity at a cusp.
    """

    def __init__(self, curve: Curve, a: float, b: float, tolerance: float) -> None:
        """Raise GenevaError for a tolerance finer than double precision, or a curve that leaps."""
        self.curve, self.tolerance = curve, tolerance
        # the survey has 1024 cells
        self.t = np.linspace(a, b, 1025)
        points, tangents = self._complex(self.t)
        # evaluated one by one as a caller would, since sums over an array may round differently
        self.ends = [self._complex(np.array([t])) for t in (a, b)]
        spacing = float(np.spacing(np.abs(points).max()))
        # a tolerance below 64 last digits of the coordinates cannot be shown
        if not tolerance > 64 * spacing:
            raise _too_fine(tolerance)
        self.rounding = 4.0 * spacing
        step = np.abs(np.diff(points))
        if self._leaps(points, step):
            raise GenevaError(
                f"no smooth curve within {tolerance:g} mm: it leaps, as walls of a slot or "
                "groove do if roller and slot overlap"
            )
        turn = np.abs(np.angle(tangents[1:] / tangents[:-1]))
        # below 0.1 radians the places on a curve follow its length alone
        w = np.cumsum(step / step.sum() + turn / max(float(turn.sum()), 0.1))
        self.w = np.round(np.concatenate(([0.0], w)) / (w[-1] * PLACE)) * PLACE
        self.kind: type[np.complexfloating] = np.complex128

    def _leaps(self, points: Array, step: Array) -> bool:
        """True if the ends of a cell stay more than a tolerance apart after all halvings."""
        padded = np.pad(step, 1)
        # in a cell 4 times as long as its neighbours the curve may leap
        i = np.flatnonzero(step > 4.0 * np.maximum(padded[:-2], padded[2:]) + self.tolerance)
        t0, t1, p0, p1 = self.t[i], self.t[i + 1], points[i], points[i + 1]
        # 60 halvings reach the last digits of such a cell's ends
        for _ in range(60 if len(i) else 0):
            t = 0.5 * (t0 + t1)
            p = self._complex(t)[0]
            first = np.abs(p - p0) > np.abs(p1 - p)
            t0, p0 = np.where(first, t0, t), np.where(first, p0, p)
            t1, p1 = np.where(first, t, t1), np.where(first, p, p1)
        return bool((np.abs(p1 - p0) > self.tolerance).any())

    def inside(self, places: Array, count: int) -> tuple[Array, Array]:
        """Points and unit tangents at even places in each interval: (n, count + 1)."""
        w = places[:-1, None] + np.diff(places)[:, None] * (np.arange(count + 1) / count)
        w[:, -1] = places[1:]
        points, tangents = self._complex(np.interp(w.ravel(), self.w, self.t))
        for i, end in zip((0, -1), self.ends, strict=True):
            points[i], tangents[i] = (v[0] for v in end)
        points, tangents = points.astype(self.kind), tangents.astype(self.kind)
        return points.reshape(w.shape), tangents.reshape(w.shape)

    def _complex(self, t: Array) -> tuple[Array, Array]:
        points, tangents = self.curve(t)
        return points[:, 0] + 1j * points[:, 1], tangents[:, 0] + 1j * tangents[:, 1]


def fewest(
    path: CurvePath,
    fit: Callable[[CurvePath, Array], tuple[Pieces, Array]],
    order: float,
    unit: int = 1,
) -> Pieces:
    """Return the fewest pieces that stay within the path's tolerance, or nearly the fewest.

    ``fit`` returns the pieces between places on the path, and the error of each in mm. Their
    number is a multiple of ``unit``. An error is proportional to the length of the piece to the
    power of ``order``. Its root over that of the tolerance is the piece's weight, and the sum of
    the weights predicts the number of pieces.
    """
    best, count, too_few, enough = None, unit, 0, PIECES_MAX
    places, weights = np.array([0.0, 1.0]), np.ones(1)
    # at most 40 numbers of pieces are tried
    for _ in range(40):
        # the places of one number of pieces move at most 10 times
        for _ in range(10):
            places = _respread(places, weights, count)
            _, errors = fit(path, places)
            # one hundredth of the tolerance is for what lies between samples
            weights = (errors / (0.99 * path.tolerance)) ** (1.0 / order)
            weights = np.maximum(np.ceil(weights / WEIGHT), 1.0) * WEIGHT
            worst, mean = weights.max(), weights.mean()
            # if the worst weight is 1.25 of the mean or less, there are too few pieces
            if worst <= 1.0 or (mean > 1.0 and worst <= 1.25 * mean):
                break
        if worst <= 1.0:
            best, enough = places, count
        else:
            too_few = count
        # a hundredth of the pieces is not worth another attempt
        step = unit * (1 + int(0.01 * count / unit))
        if best is not None and enough - too_few <= step:
            # products of long numbers are the same on all processors of a family, as doubles
            path.kind = np.clongdouble
            return fit(path, best)[0]
        need = unit * int(np.ceil(min(weights.sum(), PIECES_MAX) / unit))
        count = min(max(need, too_few + step), enough - unit)
    raise _too_fine(path.tolerance)


def _too_fine(tolerance: float) -> GenevaError:
    text = f"a tolerance of {tolerance:g} mm is finer than double precision can show at this size"
    return GenevaError(text)


def _respread(places: Array, weights: Array, count: int) -> Array:
    """Places of ``count`` pieces, each with an equal part of the weights of the present pieces."""
    # at least 0.05 of the mean weight, or of 1: an inflection needs pieces too, and rounding is no
    # weight; the root, since an arc's error is its neighbours' too
    weights = np.sqrt(np.maximum(weights, 0.05 * max(weights.mean(), 1.0)))
    area = np.concatenate(([0.0], np.cumsum(weights)))
    return np.interp(np.linspace(0.0, area[-1], count + 1), area, places)


def points_of(z: Array) -> list[tuple[float, float]]:
    """Convert complex numbers to points."""
    z = z.astype(np.complex128)
    return list(zip(z.real.tolist(), z.imag.tolist(), strict=True))
