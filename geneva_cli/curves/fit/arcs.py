"""A curve as arcs with common tangents, in nearly as few as there can be.

Biarcs that meet the curve and its tangent at their ends miss it by k' h³ / 40 with arcs of length
h, k' being the rate of the curvature. Where knots and tangents may leave the curve a little, the
best is an error that runs like the third Bernoulli polynomial, k' h³ / 125: a third fewer arcs.
So each pair of arcs is a biarc, whose ends are moved off the curve by small distances and angles;
those follow from least squares, in which the miss is a piecewise quadratic of the arc length.

How many there must be is a whole number, which each try predicts from its error: no boundary to
halve towards, as those of ``numerics.roots``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.fit.path import (
    PIECES_MAX,
    TARGET,
    CurvePath,
    inside,
    peaks,
    points_of,
    respread,
)
from geneva_cli.curves.shapes import Arc, Line
from geneva_cli.numerics.linear import gram, inverse2, product

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

ASYMPTOTIC = 72.0 * np.sqrt(3.0)  # k' h³ over the best miss: B3 has its peaks at sqrt(3) / 36
EVEN = 0.02  # share of the first knots that is spread evenly: the density may vanish
SAMPLES = 12  # in an arc, while searching
DENSE = 48  # in an arc, for the verdict: a lobe's peak is seen to 0.3 %
ROUNDS = 16  # of moving the knots and solving for their offsets
LEG = 4  # rounds after which it is seen what they have gained
FLOOR = 0.3  # of the mean weight, in moving knots
ATTEMPTS = 40
SPARE = 0.01  # share of the arcs that is not worth another attempt
BIARC_TURN = 2.7  # radians: beyond, a biarc's chord says too little


class Biarcs(NamedTuple):
    """Arcs in pairs. ``miss`` is how far they lie to the left of the curve, at its samples."""

    start: Array  # (2 n,) complex
    end: Array
    half: Array  # (2 n,) half the sweeps, radians
    points: Array  # (2 n, samples + 1) complex: of the curve
    tangents: Array
    miss: Array  # (2 n, samples + 1)


class Knots(NamedTuple):
    """Where biarcs start and end on the path, with the joints in between, and how far off it."""

    places: Array  # (2 n + 1,)
    offset: Array  # (n + 1,) to the left, mm
    tilt: Array  # (n + 1,) of the tangent, radians


def fitted_arcs(path: CurvePath) -> list[Arc | Line]:
    """Arcs with common tangents along a path, the ends' tangents being the curve's."""
    rate = np.abs(np.diff(path.curvature()))
    bent = rate * (0.5 * (path.step[1:] + path.step[:-1])) ** 2
    joint = np.cbrt(np.maximum(bent - path.rounding, 0.0))
    density = np.interp(np.arange(len(path.step)) - 0.5, np.arange(len(joint)), joint)
    least = 2 * int(np.ceil(path.turning / BIARC_TURN + 1e-9))
    count = max(_even(density.sum() / np.cbrt(ASYMPTOTIC * path.tolerance)), least)
    best, too_few = None, least - 2
    target = TARGET * path.tolerance
    for _ in range(ATTEMPTS):
        if count > PIECES_MAX:
            raise path.too_fine()
        found, worst = _attempt(path, path.spread(density, count, EVEN), target)
        enough = _even(count * min(np.cbrt(worst / path.tolerance), 2.0))  # may be infinite
        if found is not None:
            best, good = found, count
            count = max(min(enough, good - 2), too_few + 2)
        else:
            too_few = count
            count = max(count + 2, _even(count * (1.0 + SPARE)), min(enough, 2 * count))
            if best is not None:
                count = min(_even(0.5 * (too_few + good)), good)
        if best is not None and (count >= good or good - too_few <= max(2.0, SPARE * good)):
            return _joined(best, path.rounding)
    raise path.too_fine()


def _even(number: float) -> int:
    return 2 * int(np.ceil(0.5 * float(number)))


def _attempt(path: CurvePath, places: Array, target: float) -> tuple[Biarcs | None, float]:
    """Biarcs that serve, or None; and the least error of those that were tried."""
    nothing = np.zeros(len(places) // 2 + 1)
    knots = Knots(places, nothing, nothing)
    found = _biarcs(path, knots, SAMPLES)
    least = before = np.inf
    for turn in range(ROUNDS):
        for _ in range(2 if turn == 0 else 1):
            knots = _solved(knots, found)
            found = _biarcs(path, knots, SAMPLES)
        worst = peaks(found.miss)
        error = float(worst.max())
        if error <= target:
            dense = _biarcs(path, knots, DENSE)
            error = max(error, _stray(dense))
            if error <= target:
                return dense, error
        if turn % LEG == 0:
            # As gains only dwindle, too little of them is the end.
            gain, before = before - min(least, error), min(least, error)
            if before - gain * (ROUNDS - turn) / LEG > target:
                return None, before
        least = min(least, error)
        # Half the step that would do if an arc's miss were its own: its neighbours share it.
        weight = np.cbrt(np.sqrt(worst / target))
        knots = knots._replace(places=respread(knots.places, weight, FLOOR))
        found = _biarcs(path, knots, SAMPLES)
    return None, least


def _biarcs(path: CurvePath, knots: Knots, samples: int) -> Biarcs:
    z, tangent = path.at(inside(knots.places, samples))
    knot, ahead = np.append(z[:, 0], z[-1, -1]), np.append(tangent[:, 0], tangent[-1, -1])
    point = knot[::2] + 1j * knots.offset * ahead[::2]
    way = ahead[::2] * np.exp(1j * knots.tilt)
    # The joints of all biarcs between two points and tangents lie on a circle through the points;
    # the one is taken that divides the distances to them as the curve's own point does.
    chord = np.diff(point)
    bow = np.exp(0.5j * (np.angle(way[:-1] / chord) - np.angle(way[1:] / chord)))
    wanted = knot[1::2]
    bow *= np.abs(wanted - point[:-1]) / np.abs(point[1:] - wanted)
    joint = point[:-1] + chord * bow / (1.0 + bow)
    start, end = np.repeat(point[:-1], 2), np.repeat(point[1:], 2)
    start[1::2] = end[::2] = joint
    chord = end - start
    half = np.empty(len(start))
    half[::2] = np.angle(chord[::2] / way[:-1])
    half[1::2] = np.angle(way[1:] / chord[1::2])
    curvature, seen = _seen(start, chord, half, z)
    # A point (x, y) lies off the arc by the root of k d² / 2 - d + y - k (x² + y²) / 2 = 0.
    off = seen.imag - 0.5 * curvature * (seen.real**2 + seen.imag**2)
    miss = -2.0 * off / (1.0 + np.sqrt(np.maximum(1.0 - 2.0 * curvature * off, 0.0)))
    return Biarcs(start, end, half, z, tangent, miss)


def _seen(start: Array, chord: Array, half: Array, points: Array) -> tuple[Array, Array]:
    """Curvatures, and points seen from the arcs' starts along their tangents.

    So nothing is measured from a centre, which may be at infinity.
    """
    size = np.abs(chord)
    turned = np.exp(1j * half) * chord.conj() / size
    return (2.0 * np.sin(half) / size)[:, None], (points - start[:, None]) * turned[:, None]


def _stray(found: Biarcs) -> float:
    """The greatest distance from the samples to their arcs, ends and all, mm.

    Infinite where the curve runs against its arc: as it does not, the samples' feet run along the
    arc from end to end, and no place on it is further from the curve.
    """
    chord = found.end - found.start
    curvature, seen = _seen(found.start, chord, found.half, found.points)
    turned = np.exp(1j * found.half) * chord.conj() / np.abs(chord)
    at_foot = 1.0 - curvature * seen.imag + 1j * curvature * seen.real
    if not ((found.tangents * turned[:, None] * at_foot.conj()).real > 0.0).all():
        return np.inf
    past = found.points - found.end[:, None]
    beyond = (past * (chord.conj() * np.exp(-1j * found.half))[:, None]).real > 0.0
    distance = np.where(seen.real < 0.0, np.abs(seen), np.abs(found.miss))
    return float(peaks(np.where(beyond, np.abs(past), distance)).max())


def _solved(knots: Knots, found: Biarcs) -> Knots:
    """The offsets and tilts with which the squares of the misses are least."""
    count = len(knots.offset) - 1
    if count == 1:
        return knots  # both ends are held
    step = np.abs(np.diff(found.points, axis=1)).reshape(count, 2, -1)
    first, length = step[:, 0].sum(axis=1), step.sum(axis=(1, 2))
    joint = (first / length)[:, None]
    along = np.zeros((count, 2, step.shape[2] + 1))
    np.cumsum(step, axis=2, out=along[:, :, 1:])
    along[:, 1] += first[:, None]
    x = along.reshape(count, -1) / length[:, None]
    before, after = x <= joint, 1.0 - x
    shapes = []
    # The quadratics on both sides of the joint that have these values and slopes at the ends
    for y0, slope0, y1, slope1 in np.eye(4):
        middle = 2.0 * (y1 - y0) - slope0 * joint - slope1 * (1.0 - joint)
        left = y0 + slope0 * x + (middle - slope0) * x * x / (2.0 * joint)
        right = y1 - slope1 * after + (slope1 - middle) * after * after / (2.0 * (1.0 - joint))
        shapes.append(np.where(before, left, right))
    shape = np.stack(shapes, axis=2)
    # In the mean length, a tilt is as large as an offset.
    unit = float(length.mean())
    shape[..., 1::2] *= (length / unit)[:, None, None]
    square = gram(shape, shape)
    pull = -gram(shape, found.miss.reshape(count, -1, 1))[..., 0]
    diagonal = square[:-1, 2:, 2:] + square[1:, :2, :2]
    right = pull[:-1, 2:] + pull[1:, :2]
    moved = _block_tridiagonal(diagonal, square[1:-1, :2, 2:], right)
    offset, tilt = knots.offset.copy(), knots.tilt.copy()
    offset[1:-1] += moved[:, 0]
    tilt[1:-1] += moved[:, 1] / unit
    return knots._replace(offset=offset, tilt=tilt)


def _block_tridiagonal(diagonal: Array, upper: Array, right: Array) -> Array:
    """Solve a symmetric system of 2 x 2 blocks: every other unknown is put in, again and again.

    ``diagonal`` is (n, 2, 2), ``upper`` (n - 1, 2, 2) the blocks above it, ``right`` (n, 2).
    """
    out: Array = np.empty_like(right)
    if len(right) == 1:
        out[...] = product(inverse2(diagonal), right[..., None])[..., 0]
        return out
    odd = len(right) // 2  # how many unknowns go out: the second, the fourth, ...
    before, after = upper[::2], upper[1::2]  # from an even one to the next odd one, and back
    put = inverse2(diagonal[1::2])
    lower = before.transpose(0, 2, 1)
    kept = diagonal[::2].copy()
    rest = right[::2].copy()
    ahead = product(before, put)
    kept[:odd] -= product(ahead, lower)
    rest[:odd] -= product(ahead, right[1::2, :, None])[..., 0]
    more = len(after)
    back = product(after.transpose(0, 2, 1), put[:more])
    kept[1 : more + 1] -= product(back, after)
    rest[1 : more + 1] -= product(back, right[1::2, :, None][:more])[..., 0]
    even = _block_tridiagonal(kept, -product(ahead[:more], after), rest)
    known = right[1::2, :, None] - product(lower, even[:odd, :, None])
    known[:more] -= product(after, even[1 : more + 1, :, None])
    out[::2], out[1::2] = even, product(put, known)[..., 0]
    return out


def _joined(found: Biarcs, rounding: float) -> list[Arc | Line]:
    """The pieces; neighbours on the same circle, up to half of it, or on the same line made one."""
    chord = np.abs(found.end - found.start)
    half = found.half
    bend = np.abs(np.diff(2.0 * np.sin(half) / chord))
    # How far from their joint one arc in place of two would pass
    same = bend * chord[1:] * chord[:-1] <= 4.0 * rounding
    runs: list[list[int]] = [[0]]
    for i in range(1, len(half)):
        if same[i - 1] and abs(half[runs[-1]].sum() + half[i]) < 0.5 * np.pi + 1e-9:
            runs[-1].append(i)
        else:
            runs.append([i])
    first, last = [run[0] for run in runs], [run[-1] for run in runs]
    start, end = found.start[first], found.end[last]
    bulge = np.tan(0.5 * np.add.reduceat(half, first))
    straight = np.abs(bulge) * np.abs(end - start) <= 2.0 * rounding
    rows = zip(points_of(start), points_of(end), bulge.tolist(), straight, strict=True)
    return [Line(p, q) if line else Arc(p, q, b) for p, q, b, line in rows]
