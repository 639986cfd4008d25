"""A curve as arcs with common tangents, in few pieces.

A biarc joins two points with tangents: two arcs that touch. Biarcs along the curve's own tangents
have an error of k' h³ / 40 with arcs of length h, where k' is the rate of the curvature. The best
spline of arcs meets the curve at all its joints, with tangents off by k' h² / 12. Its error is the
third Bernoulli polynomial, k' h³ / 125, which takes a third fewer arcs. Its tangents lie half-way
between the curve's own and the mean of the chords on both sides.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.fit.path import Curve, CurvePath, fewest, points_of
from geneva_cli.geometry.shapes import Arc, Line
from geneva_cli.numerics.arrays import Array


class Arcs(NamedTuple):
    """Arcs end to end."""

    start: Array  # (n,) complex
    end: Array
    half: Array  # (n,) half the sweeps, radians


def arcs(curve: Curve, a: float, b: float, tolerance: float) -> list[Arc | Line]:
    """Arcs within ``tolerance`` mm of the curve, without corners; lines where it is straight."""
    path = CurvePath(curve, a, b, tolerance)
    return _joined(fewest(path, _biarcs, 3.0, 2), path.rounding)  # a biarc has 2 arcs


@np.errstate(divide="ignore", invalid="ignore")  # where a biarc's ends are one point
def _biarcs(path: CurvePath, places: Array) -> tuple[Arcs, Array]:
    """Biarcs that meet the curve at places, and the error of each in mm."""
    # 24 samples in an arc show a lobe's peak to 1 %
    z, tangents = path.inside(places, 24)
    joints, heading = np.append(z[:, 0], z[-1, -1]), np.append(tangents[::2, 0], tangents[-1, -1])
    knot, middle = joints[::2], joints[1::2]
    before, after = knot[1:-1] - middle[:-1], middle[1:] - knot[1:-1]
    angles = [np.angle(chord / heading[1:-1]) for chord in (before, after)]
    first, second = np.abs(before), np.abs(after)
    tilt = -0.5 * (angles[0] * second + angles[1] * first) / (first + second)
    heading[1:-1] *= np.exp(1j * tilt)
    # The joints of all biarcs between two points and tangents lie on a circle through the points.
    # The chosen one divides the distances to them as the curve's own point does.
    chord = np.diff(knot)
    bow = np.exp(0.5j * (np.angle(heading[:-1] / chord) - np.angle(heading[1:] / chord)))
    bow *= np.abs(middle - knot[:-1]) / np.abs(knot[1:] - middle)
    joint = knot[:-1] + chord * bow / (1.0 + bow)
    start, end = np.repeat(knot[:-1], 2), np.repeat(knot[1:], 2)
    start[1::2] = end[::2] = joint
    half = np.empty(len(start), start.real.dtype)
    half[::2] = np.angle((joint - knot[:-1]) / heading[:-1])
    half[1::2] = np.angle(heading[1:] / (knot[1:] - joint))
    arcs = Arcs(start, end, half)
    return arcs, _errors(arcs, z, tangents)


def _errors(arcs: Arcs, points: Array, tangents: Array) -> Array:
    """Greatest distance from samples of the curve (n, samples + 1) to each arc, mm."""
    # if the nearest points of the samples run along the arc, no place on it is farther away
    chord = arcs.end - arcs.start
    size = np.abs(chord)
    curvature = (2.0 * np.sin(arcs.half) / size)[:, None]
    ahead = chord / size * np.exp(-1j * arcs.half)
    # As seen from the arc's start along its tangent: an arc's centre may be at infinity.
    local = (points - arcs.start[:, None]) * ahead.conj()[:, None]
    # A point (x, y) is off the arc by the root of k d² / 2 - d + y - k (x² + y²) / 2 = 0.
    off = local.imag - 0.5 * curvature * np.abs(local) ** 2
    miss = 2.0 * np.abs(off) / (1.0 + np.sqrt(np.maximum(1.0 - 2.0 * curvature * off, 0.0)))
    past = points - arcs.end[:, None]
    beyond = (past * (chord.conj() * np.exp(-1j * arcs.half))[:, None]).real > 0.0
    miss = np.where(local.real < 0.0, np.abs(local), np.where(beyond, np.abs(past), miss))
    at_foot = 1.0 - curvature * local.imag + 1j * curvature * local.real
    along = (tangents * (ahead[:, None] * at_foot).conj()).real > 0.0
    length = np.abs(np.diff(points, axis=1)).sum(axis=1)
    return np.where(along.all(axis=1), miss.max(axis=1), length)


def _joined(arcs: Arcs, rounding: float) -> list[Arc | Line]:
    """The pieces, with neighbours on one line or one circle (up to half of it) merged."""
    chord, half = np.abs(arcs.end - arcs.start), arcs.half
    bend = np.abs(np.diff(2.0 * np.sin(half) / chord))
    # distance at which one arc would pass the joint of two
    same = bend * chord[1:] * chord[:-1] <= 4.0 * rounding
    runs: list[list[int]] = [[0]]
    for i in range(1, len(half)):
        if same[i - 1] and abs(half[runs[-1]].sum() + half[i]) < 0.5 * np.pi + 1e-9:
            runs[-1].append(i)
        else:
            runs.append([i])
    first, last = [run[0] for run in runs], [run[-1] for run in runs]
    start, end = arcs.start[first], arcs.end[last]
    bulge = np.tan(0.5 * np.add.reduceat(half, first)).astype(np.float64)
    straight = np.abs(bulge) * np.abs(end - start) <= 2.0 * rounding
    rows = zip(points_of(start), points_of(end), bulge.tolist(), straight, strict=True)
    return [Line(p, q) if line else Arc(p, q, b) for p, q, b, line in rows]
