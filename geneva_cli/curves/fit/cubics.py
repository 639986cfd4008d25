"""A curve as cubic Béziers with common tangents, in few pieces.

Each starts and ends on the curve, along its tangents. Hermite's handles, thirds of the length,
miss by the fourth power of the length; the handles of least squares by the sixth, as the error
is measured along the normal: where along the cubic a point lies does not matter.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.fit.path import CurvePath, fewest, points_of
from geneva_cli.curves.shapes import Cubic

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

SAMPLES = 48  # in a piece
STEPS = 6  # of least squares
FEET = 6  # steps of Newton's to the places nearest to the samples
DAMPING = 1e-3  # of the first step in the handles' difference
STIFF = 1e9  # the damping that leaves their difference as it is
SHORTEST, LONGEST = 1e-4, 1.0  # handles, in lengths of the piece: none is lost, none loops
ORDER = 6.0


class FitTargets(NamedTuple):
    """What cubics are to go through, moved to their start and scaled by the curve's length."""

    length: Array  # (n,) mm
    points: Array  # (n, samples + 1) complex
    ahead: Array  # (n, 1) complex: the tangents at the start, and the end
    behind: Array


class FitState(NamedTuple):
    """Handles in lengths of the piece, the samples' places on the cubics, what is left, squared."""

    handles: Array  # (n, 2)
    v: Array  # (n, samples + 1)
    left: Array  # (n,)

    def better(self, other: FitState) -> FitState:
        """In each row the one with less left."""
        mine = (self.left < other.left)[:, None]
        return FitState(
            np.where(mine, self.handles, other.handles),
            np.where(mine, self.v, other.v),
            np.minimum(self.left, other.left),
        )


def fitted_cubics(path: CurvePath) -> list[Cubic]:
    """Cubics with common tangents along a path, the ends' tangents being the curve's."""
    corners = fewest(path, _cubics, ORDER)
    return [Cubic(*row) for row in zip(*map(points_of, corners), strict=True)]


def _cubics(path: CurvePath, places: Array) -> tuple[tuple[Array, Array, Array, Array], Array]:
    """The control points of cubics between places, and how far each strays from the curve, mm."""
    z, tangent = path.inside(places, SAMPLES)
    length = np.abs(np.diff(z, axis=1)).sum(axis=1)
    points = (z - z[:, :1]) / length[:, None]
    wanted = FitTargets(length, points, tangent[:, :1], tangent[:, -1:])
    handles = _handles(wanted)
    reach = handles * length[:, None]
    first = z[:, 0] + reach[:, 0] * tangent[:, 0]
    second = z[:, -1] - reach[:, 1] * tangent[:, -1]
    return (z[:, 0], first, second, z[:, -1]), _misses(wanted, handles)


def _handles(wanted: FitTargets) -> Array:
    """The handles of the nearest cubics.

    Least squares in two unknowns a piece (Levenberg and Marquardt's), no root of one variable.
    """
    # At a cusp the place w goes as the cubic's own parameter does, and elsewhere too.
    even = np.broadcast_to(np.linspace(0.0, 1.0, wanted.points.shape[1]), wanted.points.shape)
    state = _seen(wanted, _first_handles(wanted, even), even)
    damping = np.full(len(even), DAMPING)
    for _ in range(STEPS):
        trial = _seen(wanted, _improved(wanted, state, damping), state.v)
        trial = _seen(wanted, _improved(wanted, trial, STIFF), trial.v)
        damping *= np.where(trial.left < state.left, 0.02, 10.0)
        state = trial.better(state)
    return state.handles


def _misses(wanted: FitTargets, handles: Array) -> Array:
    """How far the samples lie from the cubics, mm; the length, where that proves nothing."""
    v = np.broadcast_to(np.linspace(0.0, 1.0, wanted.points.shape[1]), wanted.points.shape)
    for _ in range(FEET):
        v = _projected(wanted, handles, v)
    miss = np.abs(wanted.points - _bezier(wanted, handles, v)[0]).max(axis=1)
    # Feet that run back and forth are no proof that the whole cubic is near.
    miss[(np.diff(v, axis=1) < 0.0).any(axis=1)] = 1.0
    out: Array = wanted.length * miss
    return out


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


def _first_handles(wanted: FitTargets, v: Array) -> Array:
    """The handles with which the cubics are nearest to the samples at given parameters."""
    u = 1.0 - v
    fixed = wanted.points - v * v * (3.0 - 2.0 * v) * wanted.points[:, -1:]
    first, second = 3.0 * v * u * u * wanted.ahead, -3.0 * v * v * u * wanted.behind
    return np.clip(_least_squares(first, second, fixed, 0.0), 0.05, 0.8)


def _least_squares(first: Array, second: Array, wanted: Array, damping: Array | float) -> Array:
    """The real factors of two columns that are nearest to what is wanted, in each row.

    The second one is held back by the damping.
    """
    a, d = (np.abs(first) ** 2).sum(axis=1), (np.abs(second) ** 2).sum(axis=1)
    b = (first * second.conj()).real.sum(axis=1)
    a, d = a + 1e-30, d * (1.0 + damping) + 1e-30
    p, q = (first * wanted.conj()).real.sum(axis=1), (second * wanted.conj()).real.sum(axis=1)
    solved: Array = np.stack((d * p - b * q, a * q - b * p), axis=1) / (a * d - b * b)[:, None]
    return solved


def _projected(wanted: FitTargets, handles: Array, v: Array) -> Array:
    """The places on the cubics nearest to the samples, one step of Newton's closer.

    Not to the last bit and in no bracket, as ``numerics.roots_many`` would: a few steps serve, with
    the handles still moving, and each must lead to a lesser distance from wherever it starts.
    """
    point, rate, bend = _bezier(wanted, handles, v)
    off = wanted.points - point
    slope = np.abs(rate) ** 2
    # Half the slope at least: a step towards less, wherever the start
    steep = np.maximum(slope - (off * bend.conj()).real, 0.5 * slope)
    out: Array = np.clip(v + (off * rate.conj()).real / np.maximum(steep, 1e-300), 0.0, 1.0)
    return out


def _seen(wanted: FitTargets, handles: Array, v: Array) -> FitState:
    """The samples' places on these cubics, from places on others, and what is left."""
    for _ in range(2):
        v = _projected(wanted, handles, v)
    off = wanted.points - _bezier(wanted, handles, v)[0]
    return FitState(handles, v, (np.abs(off) ** 2).sum(axis=1))


def _improved(wanted: FitTargets, state: FitState, damping: Array | float) -> Array:
    """Handles with smaller squares of the distances along the normals.

    On a short piece both handles bow it in the same way, and their difference matters much less:
    the valley is narrow and bent. Only the difference is damped.
    """
    v, u = state.v, 1.0 - state.v
    point, rate, _ = _bezier(wanted, state.handles, v)
    turned = -1j * rate.conj() / np.maximum(np.abs(rate), 1e-300)
    off = ((wanted.points - point) * turned).real
    first = 3.0 * v * u * u * (wanted.ahead * turned).real
    second = -3.0 * v * v * u * (wanted.behind * turned).real
    both, apart = _least_squares(first + second, first - second, off, damping).T
    step = np.stack((both + apart, both - apart), axis=1)
    out: Array = np.clip(state.handles + step, SHORTEST, LONGEST)
    return out
