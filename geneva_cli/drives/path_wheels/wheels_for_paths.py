"""Wheels for the paths of a batch of designs, in doubles.

A double or nearly double root is known only to half the digits of a double. Such a design is left
to ``wheel_for_path``, which solves it alone in 50 digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, cast

import numpy as np

from geneva_cli.drives.path_wheels.choice import chosen
from geneva_cli.drives.path_wheels.wheel_for_path import fit
from geneva_cli.drives.path_wheels.wheels import WheelSearch, wheels
from geneva_cli.drives.paths.tangent_pairs import DOUBLE_ROOT_SLOPE, ends_at, residual
from geneva_cli.drives.roller_path import RollerPath, exactly
from geneva_cli.errors import GenevaError
from geneva_cli.motion.wheels.poses import HalfStep
from geneva_cli.numerics.arrays import Array, Long, Whole, rising
from geneva_cli.numerics.digits import PI
from geneva_cli.numerics.jet import Jet

if TYPE_CHECKING:
    from numpy.typing import NDArray

    LongComplex: TypeAlias = NDArray[np.clongdouble]

LONG_PI = np.longdouble(str(PI))
Alone: TypeAlias = Callable[[int], tuple[RollerPath, float | None]]  # a design's path and entry


class Fits(NamedTuple):
    """One wheel for each of n designs: angles in radians, (n, 1); NaN if none fits.

    Entry and exit are doubles, or long doubles where they have been made more accurate.
    ``alone`` has the numbers of designs that must be solved one by one, with the search of each.
    """

    entry: Array | Long
    exit: Array | Long
    sense: Array  # +1 if the wheel turns counterclockwise on the path's own axes
    alone: dict[int, WheelSearch]


def fits_of_batch(path: RollerPath, b: float, wanted: float | None = None) -> Fits:
    """The gentlest wheel of each path, or the one whose entry is nearest to ``wanted`` (radians).

    ``path``, half the index angle b and ``wanted`` hold numbers (n, 1), or one for all.
    """
    numbers = (*path.rough, b, 0.0 if wanted is None else wanted)
    count = np.broadcast_shapes(*(np.shape(x) for x in numbers))[0]
    out = np.full((3, count), np.nan)
    alone: dict[int, WheelSearch] = {}
    half = np.broadcast_to(np.asarray(b, dtype=float), (count, 1))
    goal = None if wanted is None else np.broadcast_to(np.asarray(wanted, dtype=float), (count, 1))
    size = 8192  # designs that are searched together: each takes 10 kB
    for start in range(0, count, size):
        part = np.arange(start, min(start + size, count))
        some = path.of(part)
        search = wheels(some, half[part])
        candidates = search.wheels
        best = chosen(some, candidates, goal if goal is None else goal[part])
        out[:, part[candidates.which[best]]] = *candidates.phi[best].T, candidates.sense[best]
        for i in rising(search.doubtful.which).tolist():
            alone[start + i] = search.of(i)
    entry, exit_, sense = out[:, :, None]
    return Fits(entry, exit_, sense, alone)


def solve_alone(fits: Fits, step: HalfStep, alone: Alone) -> None:
    """Fill in the designs that must be solved one by one, with NaN where no wheel fits."""
    for i, search in fits.alone.items():
        p, q = (int(np.broadcast_to(x, fits.entry.shape)[i, 0]) for x in step)
        try:
            path, wanted = alone(i)
            one = fit(path, HalfStep(p, q), wanted, search)
        except GenevaError:
            one = None
        values = (float(one.entry), float(one.exit), one.sense) if one else (math.nan,) * 3
        for column, value in zip(fits[:3], values, strict=True):
            column[i, 0] = value


def long_place(path: RollerPath, sine: Long, cosine: Long) -> LongComplex:
    """Position for crank directions in long doubles, as complex numbers."""
    pin = path.place(Jet((exactly(sine),)), Jet((exactly(cosine),)), exact=True)
    (x,), (y,) = cast("list[tuple[Long]]", [jet.c for jet in pin])
    return _complex(x, y)


def long_point(path: RollerPath, sine: Long, cosine: Long) -> tuple[LongComplex, LongComplex]:
    """Position and unit tangent for crank directions in long doubles, as complex numbers."""
    s, c = exactly(sine), exactly(cosine)
    pin = path.place(Jet((s, c)), Jet((c, -s)), exact=True)
    (x, vx), (y, vy) = cast("list[tuple[Long, Long]]", [jet.c for jet in pin])
    speed = np.sqrt(vx * vx + vy * vy)
    return _complex(x, y), _complex(vx / speed, vy / speed)


def _complex(x: Long, y: Long) -> LongComplex:
    """Complex long doubles; a sum with 1j times y takes five times as long."""
    both = np.empty(np.shape(x), dtype=np.clongdouble)
    both.real, both.imag = x, y
    return both


def some_fits(
    path: RollerPath, fits: Fits, step: HalfStep, which: Whole
) -> tuple[RollerPath, Fits, HalfStep]:
    """Paths, wheels and half index angles of some designs of a batch."""
    p, q = (cast(int, np.asarray(x)[which]) if np.ndim(x) else x for x in step)
    some = Fits(fits.entry[which], fits.exit[which], fits.sense[which], fits.alone)
    return path.of(which), some, HalfStep(p, q)


def polished(path: RollerPath, fits: Fits, step: HalfStep) -> tuple[Long, Long]:
    """Entry and exit in long doubles, by Newton's method from those in doubles."""
    entry, exit_ = _stepped(path, fits, step)
    # Radians: a step leaves about a millionth of the error, and long doubles resolve 1e-19.
    move = np.maximum(np.abs(entry - fits.entry), np.abs(exit_ - fits.exit))[:, 0]
    far = np.flatnonzero(move > 1e-13)
    if len(far):
        again = fits._replace(entry=entry, exit=exit_)
        entry[far], exit_[far] = _stepped(*some_fits(path, again, step, far))
    return entry, exit_


def _stepped(path: RollerPath, fits: Fits, step: HalfStep) -> tuple[Long, Long]:
    """Entry and exit after a Newton step in two unknowns, with slopes in doubles."""
    phi = np.hstack((fits.entry, fits.exit)).astype(float)
    ends = ends_at(path, np.arange(len(phi)), phi)
    rest = residual(ends, np.broadcast_to(step.b, fits.entry.shape))
    by_entry, by_exit = rest.by_entry[:, None], rest.by_exit[:, None]
    turn, turn_out = ends.at.turn[:, :1], ends.at.turn[:, 1:]
    det = rest.det[:, None]
    double = np.abs(det) < DOUBLE_ROOT_SLOPE * np.abs(by_exit)
    wanted = 2 * LONG_PI * step.p / step.q
    entry, exit_ = (np.asarray(x, dtype=np.longdouble) for x in fits[:2])
    (p, t), (q, u) = (long_point(path, np.sin(x), np.cos(x)) for x in (entry, exit_))
    away = ((q - p) * (t + u).conj()).imag
    index = -u * t.conj()
    excess = index.imag * np.cos(wanted) - fits.sense * index.real * np.sin(wanted)
    entry = entry - np.where(double, 0.0, (away * turn_out - excess * by_exit) / det)
    both = np.where(double, away / by_exit, (by_entry * excess + turn * away) / det)
    return entry, exit_ - both
