"""A smooth parametric curve in the fewest pieces that stay within a tolerance: arcs or cubics.

A curve is a function of n parameters, from a to b > a. It returns points (n, 2) in millimetres and
unit tangents (n, 2), here as complex numbers. Callers split it at corners and cusps; its speed may
go to zero at an end. Pieces have common tangents.

Biarcs along the curve's own tangents have an error of k' h³ / 40 with arcs of length h, where k' is
the rate of the curvature. With tangents half-way between the curve's own and the mean of the chords
on both sides it is k' h³ / 125, with a third fewer arcs. Of cubics with handles by least squares
the error is of the sixth power of the length. It is measured along the normal, so that a point may
slide along the cubic.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias, TypeVar

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Arc, Cubic, Line, Segment
from geneva_cli.numerics.arrays import Array

Curve: TypeAlias = Callable[[Array], tuple[Array, Array]]
Writer: TypeAlias = Callable[[Curve, float, float], Sequence[Segment]]  # fits a curve from a to b

PIECES_MAX = 200_000  # of a curve between two ends
# Processors differ in the last bits of sines and products. Steps as coarse as these hide that, so
# that joints are at the same places everywhere.
PLACE = 2.0**-26  # of the whole path
WEIGHT = 2.0**-7

SHORTEST, LONGEST = 1e-4, 1.0  # handles, in lengths of the piece: none is lost, none loops

Pieces = TypeVar("Pieces")
# pieces between places on a path, and the error of each, mm
Fit: TypeAlias = "Callable[[CurvePath, Array], tuple[Pieces, Array]]"


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
        # a cell 4 times as long as its neighbours may leap: its ends stay more than a tolerance
        # apart in 60 halvings, which reach their last digits
        padded = np.pad(step, 1)
        i = np.flatnonzero(step > 4.0 * np.maximum(padded[:-2], padded[2:]) + tolerance)
        t0, t1, p0, p1 = self.t[i], self.t[i + 1], points[i], points[i + 1]
        for _ in range(60 if len(i) else 0):
            t = 0.5 * (t0 + t1)
            at = self._complex(t)[0]
            first = np.abs(at - p0) > np.abs(p1 - at)
            t0, p0 = np.where(first, t0, t), np.where(first, p0, at)
            t1, p1 = np.where(first, t, t1), np.where(first, at, p1)
        if (np.abs(p1 - p0) > tolerance).any():
            text = "it leaps, as walls of a slot or groove do if roller and slot overlap"
            raise GenevaError(f"no smooth curve within {tolerance:g} mm: {text}")
        turn = np.abs(np.angle(tangents[1:] / tangents[:-1]))
        # below 0.1 radians the places on a curve follow its length alone
        w = np.cumsum(step / step.sum() + turn / max(float(turn.sum()), 0.1))
        self.w = np.round(np.concatenate(([0.0], w)) / (w[-1] * PLACE)) * PLACE
        self.kind: type[np.complexfloating] = np.complex128

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


def _fitted(path: CurvePath, fit: Fit[Pieces], order: float, unit: int) -> Pieces:
    """Return the fewest pieces within the path's tolerance."""
    places = fewest(lambda at: fit(path, at)[1], path.tolerance, order, unit)
    # products of long numbers are the same on all processors of a family, as doubles
    path.kind = np.clongdouble
    return fit(path, places)[0]


def fewest(
    errors: Callable[[Array], Array],
    tolerance: float,
    order: float,
    unit: int = 1,
    spare: float = 0.01,
) -> Array:
    """Return the places, from 0 to 1, of the fewest pieces within a tolerance, or nearly so.

    ``errors`` returns the error of each piece between places, in mm. Their number is a multiple of
    ``unit``, and a fraction ``spare`` of it is not worth another attempt. An error is proportional
    to the length of the piece to the power of ``order``. Its root over that of the tolerance is the
    piece's weight, and the sum of the weights predicts the number of pieces. Raises GenevaError for
    a tolerance that needs more than ``PIECES_MAX`` of them.
    """
    best, count, too_few, enough = None, unit, 0, PIECES_MAX
    places, weights = np.array([0.0, 1.0]), np.ones(1)
    # at most 40 numbers of pieces are tried
    for _ in range(40):
        # the places of one number of pieces move at most 10 times
        for _ in range(10):
            # ``count`` pieces, each with an equal part of the weights of the present pieces: at
            # least 0.05 of the mean weight, or of 1, since an inflection needs pieces too, and
            # rounding is no weight; the root, since an arc's error is its neighbours' too
            share = np.sqrt(np.maximum(weights, 0.05 * max(weights.mean(), 1.0)))
            area = np.concatenate(([0.0], np.cumsum(share)))
            places = np.interp(np.linspace(0.0, area[-1], count + 1), area, places)
            # one hundredth of the tolerance is for what lies between samples
            weights = (errors(places) / (0.99 * tolerance)) ** (1.0 / order)
            weights = np.maximum(np.ceil(weights / WEIGHT), 1.0) * WEIGHT
            worst, mean = weights.max(), weights.mean()
            # if the worst weight is 1.25 of the mean or less, there are too few pieces
            if worst <= 1.0 or (mean > 1.0 and worst <= 1.25 * mean):
                break
        if worst <= 1.0:
            best, enough = places, count
        else:
            too_few = count
        step = unit * (1 + int(spare * count / unit))
        if best is not None and enough - too_few <= step:
            return best
        need = unit * int(np.ceil(weights.sum() / unit))
        # the first estimate, by one piece, may be far too high
        if need > PIECES_MAX and count > unit:
            least = tolerance * float((weights.sum() / PIECES_MAX) ** order)
            # four times: where chords have half of what is typed, one digit still suffices
            text = f"pieces: use for example --tolerance {4.0 * least:.1g}"
            raise GenevaError(
                f"a tolerance of {tolerance:g} mm takes more than {PIECES_MAX} {text}"
            )
        count = min(max(need, too_few + step), enough - unit, 1000 * count)
    raise _too_fine(tolerance)


def _too_fine(tolerance: float) -> GenevaError:
    text = f"a tolerance of {tolerance:g} mm is finer than double precision can show at this size"
    return GenevaError(text)


def points_of(z: Array) -> list[tuple[float, float]]:
    """Convert complex numbers to points."""
    z = z.astype(np.complex128)
    return list(zip(z.real.tolist(), z.imag.tolist(), strict=True))


class Arcs(NamedTuple):
    """Arcs end to end."""

    start: Array  # (n,) complex
    end: Array
    half: Array  # (n,) half the sweeps, radians


def arcs(curve: Curve, a: float, b: float, tolerance: float) -> list[Arc | Line]:
    """Arcs within ``tolerance`` mm of the curve, without corners; lines where it is straight."""
    path = CurvePath(curve, a, b, tolerance)
    return _joined(_fitted(path, _biarcs, 3.0, 2), path.rounding)  # a biarc has 2 arcs


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


class FitTargets(NamedTuple):
    """Targets of the cubics: samples moved to each start and scaled by the curve's length."""

    points: Array  # (n, samples + 1) complex
    ahead: Array  # complex: tangents at the start; ``behind`` at the end
    behind: Array


def cubics(curve: Curve, a: float, b: float, tolerance: float) -> list[Cubic]:
    """Cubic Béziers within ``tolerance`` mm of the curve, which meet on it with its tangents."""
    corners = _fitted(CurvePath(curve, a, b, tolerance), _cubics, 6.0, 1)
    return [Cubic(*row) for row in zip(*map(points_of, corners), strict=True)]


def _cubics(path: CurvePath, places: Array) -> tuple[tuple[Array, Array, Array, Array], Array]:
    """Control points of cubics between places, and the error of each in mm."""
    # 48 samples in a piece
    z, tangent = path.inside(places, 48)
    length = np.abs(np.diff(z, axis=1)).sum(axis=1)
    points = (z - z[:, :1]) / length[:, None]
    wanted = FitTargets(points, tangent[:, :1], tangent[:, -1:])
    handles = _handles(wanted)
    reach = handles * length[:, None]
    first = z[:, 0] + reach[:, 0] * tangent[:, 0]
    second = z[:, -1] - reach[:, 1] * tangent[:, -1]
    even = np.broadcast_to(np.linspace(0.0, 1.0, points.shape[1]), points.shape)
    v, off = _near(wanted, handles, even, 6)
    miss = off.max(axis=1)
    # Nearest points that run back and forth do not prove that the whole cubic is near.
    miss[(np.diff(v, axis=1) < 0.0).any(axis=1)] = 1.0
    return (z[:, 0], first, second, z[:, -1]), length * miss


def _handles(wanted: FitTargets) -> Array:
    """Handles of the nearest cubics, (n, 2), in lengths of the piece."""
    # At a cusp, and elsewhere, the place w is nearly proportional to the cubic's own parameter.
    v = np.broadcast_to(np.linspace(0.0, 1.0, wanted.points.shape[1]), wanted.points.shape)
    u = 1.0 - v
    fixed = wanted.points - v * v * (3.0 - 2.0 * v) * wanted.points[:, -1:]
    first, second = 3.0 * v * u * u * wanted.ahead, -3.0 * v * v * u * wanted.behind
    handles = np.clip(_least_squares(first, second, fixed, 0.0), 0.05, 0.8)
    v, off = _near(wanted, handles, v)
    left = (off**2).sum(axis=1)
    # the first step in the handles' difference is damped by 1e-3
    damping = np.full(len(v), 1e-3)
    # 6 steps of least squares
    for _ in range(6):
        trial = _improved(wanted, handles, v, damping)
        at, _ = _near(wanted, trial, v)
        # a damping of 1e9 leaves their difference as it is
        trial = _improved(wanted, trial, at, 1e9)
        at, off = _near(wanted, trial, at)
        error = (off**2).sum(axis=1)
        better = error < left
        damping *= np.where(better, 0.02, 10.0)
        handles, v = (np.where(better[:, None], *pair) for pair in ((trial, handles), (at, v)))
        left = np.minimum(error, left)
    return handles


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


def _near(wanted: FitTargets, handles: Array, v: Array, steps: int = 2) -> tuple[Array, Array]:
    """Places on cubics nearest to the samples, by Newton's steps from others; and distances."""
    for _ in range(steps):
        point, rate, bend = _bezier(wanted, handles, v)
        off = wanted.points - point
        slope = np.abs(rate) ** 2
        # at least half the slope, so that a step reduces the distance from any start
        steep = np.maximum(slope - (off * bend.conj()).real, 0.5 * slope)
        v = np.clip(v + (off * rate.conj()).real / np.maximum(steep, 1e-300), 0.0, 1.0)
    return v, np.abs(wanted.points - _bezier(wanted, handles, v)[0])


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


# the kinds of pieces that a curve can be written in
KINDS: dict[str, Callable[[Curve, float, float, float], Sequence[Segment]]]
KINDS = {"arcs": arcs, "cubics": cubics}
