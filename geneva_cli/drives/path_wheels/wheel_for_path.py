"""Wheels for one roller's path, in 50 digits.

Pairs of entry and exit form a family of one parameter; a wheel's index angle selects the pair. If
the path has inflections at both ends, the index angle is stationary along the family and the root
is double. The acceleration then starts from zero.
"""

from __future__ import annotations

import math
from decimal import Decimal, localcontext
from typing import NamedTuple, TypeAlias, cast

import numpy as np

from geneva_cli.drives.path_wheels.choice import chosen
from geneva_cli.drives.path_wheels.wheels import WheelSearch, followed, wheels
from geneva_cli.drives.paths.course import PathWheels
from geneva_cli.drives.paths.tangent_pairs import DOUBLE_ROOT_SLOPE, ends_at, residual
from geneva_cli.drives.roller_path import RollerPath, exactly
from geneva_cli.motion.wheels.poses import HalfStep
from geneva_cli.numerics import digits
from geneva_cli.numerics.angles import scaled_sin_cos
from geneva_cli.numerics.arrays import joined
from geneva_cli.numerics.jet import Jet

LAST_STEP = 1e-12  # radians: Newton's method ends after a shorter step
Exact: TypeAlias = tuple[Decimal, Decimal]  # a vector in the plane


class ExactPoint(NamedTuple):
    """A point of the path in 50 digits: crank angle, position, velocity, and unit tangent."""

    phi: Decimal
    sine: Decimal
    cosine: Decimal
    p: Exact
    v: Exact
    t: Exact

    @staticmethod
    def of(path: RollerPath, phi: Decimal) -> ExactPoint:
        """Point at a crank angle in radians."""
        s, c = digits.sin_cos(phi)
        sine, cosine = exactly(s), exactly(c)
        x, y = path.place(Jet((sine, cosine)), Jet((cosine, -sine)), exact=True)
        (px, vx), (py, vy) = cast("tuple[Exact, Exact]", (x.c, y.c))
        return ExactPoint(phi, s, c, (px, py), (vx, vy), unit((vx, vy)))


def length(a: Exact) -> Decimal:
    """Length of a vector."""
    return (a[0] * a[0] + a[1] * a[1]).sqrt()


def unit(a: Exact) -> Exact:
    """Unit vector in the direction of a vector."""
    size = length(a)
    return a[0] / size, a[1] / size


def cross(a: Exact, b: Exact) -> Decimal:
    """Third component of the vector product of two plane vectors."""
    return a[0] * b[1] - a[1] * b[0]


def angle(a: Exact, b: Exact) -> float:
    """Angle from a to b in radians, rounded once to a double."""
    return math.atan2(cross(a, b), a[0] * b[0] + a[1] * b[1])


class Pair(NamedTuple):
    """Entry and exit on the family of pairs, with the error of the index angle and its slope."""

    entry: float
    exit: float
    excess: float
    slope: float


class Fit(NamedTuple):
    """A wheel that fits: input angles at entry and exit, its centre, and its sense of rotation."""

    entry: Decimal
    exit: Decimal
    centre: Exact
    sense: float  # +1 if the wheel turns counterclockwise on the path's own axes


class _Conditions(NamedTuple):
    """The numbers of ``Residual`` for one pair, and the rates at which the path turns there."""

    away: float
    by_entry: float
    by_exit: float
    excess: float
    det: float
    sense: float
    turn: float
    turn_out: float


def fit(
    path: RollerPath, step: HalfStep, wanted: float | None = None, search: WheelSearch | None = None
) -> Fit | None:
    """Wheel that the path can drive with this index angle, or None.

    If there are several, it is the gentlest, or the one whose entry is nearest to ``wanted``
    (radians). ``search`` is the result of a batch's search of this path.
    """
    candidates, doubtful = search or wheels(path, np.array([[step.b]]))
    for entry, exit_ in doubtful.at.phi.tolist():
        root = _double(path, step, entry, exit_)
        if root:
            candidates = joined([candidates, root], 0)
    if not len(candidates.which):
        return None
    best = chosen(path, candidates, wanted)[0]
    (entry, exit_), sense = candidates.phi[best].tolist(), float(candidates.sense[best])
    with localcontext(digits.FIFTY):
        pair = _polished(path, step, entry, exit_, sense)
        if pair is None:
            return None
        p, q = (ExactPoint.of(path, phi) for phi in pair)
        total = (p.t[0] + q.t[0], p.t[1] + q.t[1])
        far = length((q.p[0] - p.p[0], q.p[1] - p.p[1])) / length(total)
        centre = (p.p[0] + far * p.t[0], p.p[1] + far * p.t[1])
    return Fit(*pair, centre, sense)


def _double(path: RollerPath, step: HalfStep, entry: float, exit_: float) -> PathWheels | None:
    """Wheel of a double root, or of two roots too close for Newton's method to separate."""
    pair = _on_family(path, step.b, entry, exit_)
    root = _refined(path, step.b, pair) if pair else None
    if root is None:
        return None
    sense = _conditions(path, step.b, *root).sense
    drivable = followed(path, np.array([root]), np.array([sense]))
    with localcontext(digits.FIFTY):
        holds = len(drivable.which) and _polished(path, step, *root, sense)
    return drivable if holds else None


def _conditions(path: RollerPath, b: float, entry: float, exit_: float) -> _Conditions:
    with np.errstate(all="ignore"):
        ends = ends_at(path, np.zeros(1, dtype=int), np.array([[entry, exit_]]))
        rest = residual(ends, np.array([[b]]))
    return _Conditions(*[x.item() for x in (*rest, *ends.at.turn.T)])


def _on_family(path: RollerPath, b: float, entry: float, exit_: float) -> Pair | None:
    """Pair of ``entry`` and the exit near ``exit_`` equally far from the meeting point: Newton."""
    for _ in range(40):
        rest = _conditions(path, b, entry, exit_)
        if rest.by_exit == 0.0:
            return None
        move = max(-0.05, min(0.05, -rest.away / rest.by_exit))
        exit_ += move
        if abs(move) < LAST_STEP:
            return Pair(entry, exit_, rest.excess, -rest.sense * rest.det / rest.by_exit)
    return None


def _refined(path: RollerPath, b: float, pair: Pair) -> tuple[float, float] | None:
    """Pair with the index angle, from a pair of the family: a root, or a double root."""
    here, step = pair, math.tau / 720  # greatest Newton step along the family, radians
    for _ in range(60):
        if here.slope == 0.0:
            break
        move = max(-step, min(step, -here.excess / here.slope))
        after = _on_family(path, b, here.entry + move, here.exit - move)
        if after is None or abs(after.entry - pair.entry) > 12.0 * step:
            return None
        done = abs(after.excess) < 4e-16 or abs(move) < LAST_STEP
        here = after
        if done:
            break
    flat = _stationary(path, b, here)
    if flat and abs(flat.excess) < 1e-12:  # radians: a double root, but for rounding
        here = flat
    # ``_polished`` corrects an index angle that is wrong by less than 1e-9 radians
    return (here.entry, here.exit) if abs(here.excess) < 1e-9 else None


def _stationary(path: RollerPath, b: float, pair: Pair) -> Pair | None:
    """Pair at which the index angle is stationary along the family: secant on its slope."""
    before, here = pair, _on_family(path, b, pair.entry + 1e-4, pair.exit - 1e-4)
    for _ in range(40):
        if here is None or here.slope == before.slope:
            return before if here is None else here
        move = -here.slope * (here.entry - before.entry) / (here.slope - before.slope)
        if abs(move) > 0.05:
            return None
        before, here = here, _on_family(path, b, here.entry + move, here.exit - move)
        if here is not None and abs(move) < 4e-16 * max(1.0, abs(here.entry)):
            return here
    return here


def _polished(
    path: RollerPath, step: HalfStep, entry: float, exit_: float, sense: float
) -> tuple[Decimal, Decimal] | None:
    """A pair in 50 digits: Newton on both conditions, with slopes in doubles.

    At a double root the slope vanishes, and only the equal distances are corrected. None if there
    is no such pair after all.
    """
    first, last = Decimal(entry), Decimal(exit_)
    sin_2b, cos_2b = (Decimal(n) / Decimal(1 << 128) for n in scaled_sin_cos(2 * step.p, step.q))
    rest = _conditions(path, step.b, entry, exit_)
    double = abs(rest.det) < DOUBLE_ROOT_SLOPE * abs(rest.by_exit)
    for _ in range(6):  # each step leaves about a millionth of the error
        p, q = ExactPoint.of(path, first), ExactPoint.of(path, last)
        apart = (q.p[0] - p.p[0], q.p[1] - p.p[1])
        total = (p.t[0] + q.t[0], p.t[1] + q.t[1])
        away = float(cross(total, apart))
        if double:
            move = away / rest.by_exit
            last -= Decimal(move)
            continue
        # sine of the error of the index angle, which is the angle from -t1 to t2
        sine, cosine = -cross(p.t, q.t), -(p.t[0] * q.t[0] + p.t[1] * q.t[1])
        excess = float(sine * cos_2b - Decimal(sense) * cosine * sin_2b)
        # by_entry de + by_exit dx = -away,  -turn de + turn_out dx = -excess
        move = (away * rest.turn_out - excess * rest.by_exit) / rest.det
        first -= Decimal(move)
        last -= Decimal((rest.by_entry * excess + rest.turn * away) / rest.det)
    return (first, last) if abs(move) < 1e-20 else None  # radians, of the last step
