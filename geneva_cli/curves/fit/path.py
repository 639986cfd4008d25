"""A smooth curve to be fitted: surveyed once, so that pieces and samples are spread as it bends.

Points and tangents are complex numbers here: rotations are products.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

    Curve: TypeAlias = Callable[[Array], tuple[Array, Array]]

CELLS = 1024  # of the survey
LEAP = 4.0  # times its neighbours' length: a cell in which the curve may leap
HALVINGS = 60  # of such a cell, to the last digits of its ends
FINEST = 64  # tolerances below that many last digits of the coordinates cannot be shown
PIECES_MAX = 200_000
TARGET = 0.995  # of the tolerance: what lies between samples is allowed for
LEAST_TURN = 0.1  # radians; below, the places on a curve are told by its length alone


class CurvePath:
    """A curve between two parameters, told by its place w from 0 to 1.

    Equal steps of w are equal parts of the length and of the turning alike: the parameter's own
    speed may go to zero at an end, and at a cusp the curvature may go to infinity.
    """

    def __init__(self, curve: Curve, a: float, b: float, tolerance: float) -> None:
        """Raises GenevaError for a tolerance that double precision cannot show at this size, and
        for a curve that leaps farther.
        """
        self.curve, self.tolerance = curve, tolerance
        self.t = np.linspace(a, b, CELLS + 1)
        points, tangents = self._complex(self.t)
        # One by one, as a caller would ask: sums over an array may round otherwise.
        self.ends = [self._complex(np.array([t])) for t in (a, b)]
        size = float(np.abs(points).max())
        if not tolerance > FINEST * np.spacing(size):
            raise self.too_fine()
        self.rounding = 4.0 * float(np.spacing(size))
        self.step = np.abs(np.diff(points))
        if self._leaps(points):
            raise GenevaError(
                f"no smooth curve within {tolerance:g} mm: it leaps, as the walls of a slot or "
                "groove do where roller and slot overlap"
            )
        self.turn = np.angle(tangents[1:] / tangents[:-1])
        self.turning = float(np.abs(self.turn).sum())
        w = np.cumsum(
            self.step / self.step.sum() + np.abs(self.turn) / max(self.turning, LEAST_TURN)
        )
        self.w = np.concatenate(([0.0], w)) / w[-1]

    def _leaps(self, points: Array) -> bool:
        """Whether the ends of a cell stay more than a tolerance apart however often it is halved.

        Looked at where a cell is that much longer than both of its neighbours.
        """
        beside = np.pad(self.step, 1)
        i = np.flatnonzero(self.step > LEAP * np.maximum(beside[:-2], beside[2:]) + self.tolerance)
        t0, t1, p0, p1 = self.t[i], self.t[i + 1], points[i], points[i + 1]
        for _ in range(HALVINGS if len(i) else 0):
            t = 0.5 * (t0 + t1)
            p = self._complex(t)[0]
            first = np.abs(p - p0) > np.abs(p1 - p)
            t0, p0 = np.where(first, t0, t), np.where(first, p0, p)
            t1, p1 = np.where(first, t, t1), np.where(first, p, p1)
        return bool((np.abs(p1 - p0) > self.tolerance).any())

    def too_fine(self) -> GenevaError:
        """The refusal of a tolerance."""
        return GenevaError(
            f"a tolerance of {self.tolerance:g} mm is finer than double precision can show "
            "at this size"
        )

    def curvature(self) -> Array:
        """The mean curvature in each cell of the survey, 1/mm; left is positive."""
        found: Array = self.turn / np.maximum(self.step, 1e-300)
        return found

    def spread(self, density: Array, count: int, floor: float) -> Array:
        """Places of ``count`` pieces with equal parts of a density given in each cell.

        ``floor`` is the share of the pieces that is spread evenly.
        """
        area = np.concatenate(([0.0], np.cumsum(density)))
        area = (1.0 - floor) * area / max(float(area[-1]), 1e-300) + floor * self.w
        found: Array = np.interp(np.linspace(0.0, area[-1], count + 1), area, self.w)
        return found

    def at(self, w: Array) -> tuple[Array, Array]:
        """Points and unit tangents at places, complex, in the shape of ``w``; exact at the ends."""
        points, tangents = self._complex(np.interp(w.ravel(), self.w, self.t))
        for side, end in enumerate(self.ends):
            there = w.ravel() == side
            points[there], tangents[there] = end
        return points.reshape(w.shape), tangents.reshape(w.shape)

    def _complex(self, t: Array) -> tuple[Array, Array]:
        points, tangents = self.curve(t)
        return points[:, 0] + 1j * points[:, 1], tangents[:, 0] + 1j * tangents[:, 1]


def inside(places: Array, count: int) -> Array:
    """``count`` + 1 even places in each interval, from end to end: (n, count + 1)."""
    share = np.arange(count + 1) / count
    out = places[:-1, None] + np.diff(places)[:, None] * share
    out[:, -1] = places[1:]
    return out


def respread(places: Array, weight: Array, floor: float) -> Array:
    """As many places, moved to where the weights of the pieces between them ask for them."""
    weight = np.maximum(weight, floor * weight.mean())
    area = np.concatenate(([0.0], np.cumsum(weight)))
    out = np.interp(np.linspace(0.0, area[-1], len(places)), area, places)
    out[0], out[-1] = places[0], places[-1]
    return out


def peaks(values: Array) -> Array:
    """The greatest size in each row, by the parabola through a sample and its neighbours."""
    sizes = np.abs(values)
    best = sizes.max(axis=1)
    row, top = np.arange(len(values)), np.clip(sizes.argmax(axis=1), 1, values.shape[1] - 2)
    before, here, after = (sizes[row, top + i] for i in (-1, 0, 1))
    bend = before - 2.0 * here + after
    rise = np.where(bend < 0.0, -((after - before) ** 2) / (8.0 * np.minimum(bend, -1e-300)), 0.0)
    # A parabola whose top lies beyond the neighbours is no witness.
    near = np.abs(after - before) <= np.abs(2.0 * bend)
    found: Array = np.maximum(best, np.where(near, here + rise, 0.0))
    return found


def points_of(z: Array) -> list[tuple[float, float]]:
    """Complex numbers as points."""
    return list(zip(z.real.tolist(), z.imag.tolist(), strict=True))
