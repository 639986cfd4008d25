"""Entry and exit on a roller's closed path: the pairs of places that a wheel's slots could take.

From both the path's tangents meet in one point, equally far away, at the wheel's index angle. All
pairs of places are looked at on a grid, and Newton takes those near to both conditions, of one
path or of many designs' together.
"""

from __future__ import annotations

import copy
import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from decimal import Decimal
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from geneva_cli.numerics.digits import PI
from geneva_cli.numerics.jet import Coefficient, Jet, sin_cos

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

GRID = 144  # places on the path that are tried for entry and for exit
MARGIN = 0.5  # of a cell's range of index angles, by which it may lie beside the wanted one
STRIDE = 0.1  # radians: a step of Newton is no longer
STEPS = 30
CLOSE = 1e-9  # radians: after so short a step, the last bits
DOUBTFUL = 1e-5  # radians of the index angle: nearer than that without a root, it may be double

BLOCK = 64  # designs whose grid is looked at together: it stays in the processor's cache

LONG_PI = np.longdouble(str(PI))


class Way(Protocol):
    """The pin's way since a moment."""

    def __call__(self, sine: Jet, versine: Jet) -> tuple[Jet, Jet]:
        """(x, y), from sin d and 1 - cos d of the crank's angle d since then."""


def rounded(x: Any) -> Any:
    """A Decimal, or long doubles, rounded to doubles; one number as a float."""
    if isinstance(x, Decimal) or not np.ndim(x):
        return float(x)
    return np.asarray(x, dtype=np.float64)


class Path(ABC):
    """A roller's closed path about the crank's axis, in millimetres.

    ``rough`` are its numbers: floats, or arrays (n, 1) of many designs. ``exact`` are the same as
    Decimals of 50 digits, or of many designs as long doubles.
    """

    rough: Any
    exact: Any

    def of(self, which: Any) -> Path:
        """The paths of some of the designs."""
        some = copy.copy(self)
        for name in ("rough", "exact"):
            numbers = (x[which] if np.ndim(x) else x for x in vars(self)[name])
            vars(some)[name] = type(self.rough)(*numbers)
        return some

    def in_long_doubles(self) -> Path:
        """The path with long doubles for exact numbers, as for many designs."""
        some = copy.copy(self)
        long = (np.longdouble(str(x)) if isinstance(x, Decimal) else x for x in self.exact)
        some.exact = type(self.exact)(*long)
        return some

    @abstractmethod
    def link(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """A unit vector on the link that carries the roller; exact: jets of such numbers."""

    @abstractmethod
    def joint(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """The crank's pin A, which carries the link."""

    @abstractmethod
    def hold(self, sine: Jet, cosine: Jet) -> tuple[float, tuple[Jet, Jet]]:
        """The other joint B's distance from A along the link, and the line of the force there."""

    @abstractmethod
    def place(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """The pin (x, y) for a crank of this direction."""

    @abstractmethod
    def about(self, sine: Any, cosine: Any) -> Way:
        """The pin's way since the crank stood there, written so that it vanishes there; sine and
        cosine are exact.
        """

    def at(self, phi: Coefficient, order: int) -> tuple[Jet, Jet]:
        """The pin for a crank angle in radians."""
        return self.place(*sin_cos(Jet.variable(phi, order)))


class Ends(NamedTuple):
    """Entry and exit in two columns: place, velocity, unit tangent and the rate at which it turns,
    with the designs' numbers.
    """

    which: Any
    phi: Array
    p: Any
    v: Any
    t: Any
    turn: Array


class Residual(NamedTuple):
    """What is left of both conditions, and their slopes.

    ``away``: the chord's part across the sum of the tangents, with slopes by entry and by exit;
    ``excess`` of the index angle, which turns with the tangents. ``det`` is of both.
    """

    away: Array
    by_entry: Array
    by_exit: Array
    excess: Array
    det: Array
    sense: Array


class Pairs(NamedTuple):
    """Pairs, entry first; and places where Newton found none, but a double root may be."""

    found: Ends
    doubtful: Ends


def pairs(path: Path, grid: Ends, b: Array) -> Pairs:
    """All pairs of m designs of half an index angle b, (m, 1), from their places on the grid."""
    seeds = []
    for start in range(0, len(b), BLOCK):
        part = slice(start, start + BLOCK)
        seeds += [(start + i, phi) for i, phi in _seeds(grid.p[part], grid.t[part], b[part])]
    which, phi = (np.concatenate(parts) for parts in zip(*seeds, strict=True))
    found, doubtful = _solved(path, b, which, phi)
    return Pairs(_in_order(found), _in_order(doubtful))


def on_grid(path: Path, count: int) -> Ends:
    """The grid's places on the paths of designs, in rows."""
    phi = np.arange(GRID, dtype=np.float64) * (math.tau / GRID)
    x, y = path.at(phi, 1)
    p, v = (np.broadcast_to(x.c[k] + 1j * y.c[k], (count, GRID)) for k in (0, 1))
    speed = np.abs(v)
    t = np.divide(v, speed, out=np.zeros_like(v), where=speed > 0.0)  # none where the point rests
    return Ends(np.arange(count), phi, p, v, t, phi)


def _seeds(p: Any, t: Any, b: Array) -> Iterator[tuple[Any, Array]]:
    """Designs, and the middles of cells of the grid, in which both conditions may be met.

    Either order of entry and exit has the same conditions, so that half of all pairs stand for all.
    A cell is taken where both change sign between its corners; the index angle, which may be
    stationary, also where it comes near to that.
    """
    step = math.tau / GRID
    wanted = np.cos(2.0 * b)
    pp, tt = np.concatenate((p, p), axis=1), np.concatenate((t, t), axis=1)
    rows: list[tuple[Array, Array]] = []  # of pairs (i, i + m): what is left of both conditions
    for m in range(1, GRID // 2 + 3):
        chord, other = pp[:, m : m + GRID] - p, tt[:, m : m + GRID]
        both = other + t
        across = chord.imag * both.real - chord.real * both.imag
        angle = -(other.real * t.real + other.imag * t.imag) - wanted
        rows.append((across, angle))
        if m < 3:
            continue
        # corners (i, j-1), (i, j), (i+1, j) and (i+1, j-1), j = i + m
        low, high = [], []
        for far, near, nearest in zip(rows[2], rows[1], rows.pop(0), strict=True):
            after, last = np.roll(near, -1, axis=1), np.roll(nearest, -1, axis=1)
            low.append(np.minimum(np.minimum(far, near), np.minimum(after, last)))
            high.append(np.maximum(np.maximum(far, near), np.maximum(after, last)))
        margin = MARGIN * (high[1] - low[1])
        meets = (low[0] <= 0.0) & (high[0] >= 0.0)
        meets &= (low[1] <= margin) & (high[1] >= -margin)
        which, i = np.nonzero(meets)
        yield which, np.stack(((i + 0.5) * step, (i + m - 0.5) * step), axis=1)


def ends_at(path: Path, which: Any, phi: Array) -> Ends:
    """Places of designs at entry and exit angles, in two columns."""
    x, y = path.of(which).at(phi, 2)
    p, v, a = (c + 1j * d for c, d in zip(x.derivatives(), y.derivatives(), strict=True))
    speed = np.abs(v)
    return Ends(which, phi, p, v, v / speed, (v.conj() * a).imag / (speed * speed))


def taken(ends: Ends, where: Any) -> Ends:
    """Some of the pairs."""
    return Ends(*(part[where] for part in ends))


def residual(ends: Ends, b: Array) -> Residual:
    """Of pairs of places, and of all designs' half index angles (m, 1)."""
    (p, q), (t, u), (v, w) = ends.p.T, ends.t.T, ends.v.T
    chord, both = q - p, (t + u).conj()
    turn, turn_out = ends.turn.T
    by_exit = (w * both + chord * (1j * turn_out * u).conj()).imag
    by_entry = (chord * (1j * turn * t).conj() - v * both).imag
    angle = np.angle(-u * t.conj())
    sense = np.copysign(1.0, angle)
    excess = sense * angle - 2.0 * b[ends.which, 0]
    det = by_entry * turn_out + by_exit * turn
    return Residual((chord * both).imag, by_entry, by_exit, excess, det, sense)


def _solved(path: Path, b: Array, which: Any, phi: Array) -> tuple[Ends, Ends]:
    """Newton from seeds: the pairs that it finds, and where it ends in doubt."""
    done: list[Ends] = []
    doubtful = []
    for step in range(STEPS):
        ends = ends_at(path, which, phi)
        rest = residual(ends, b)
        turn, turn_out = ends.turn.T
        excess = rest.sense * rest.excess
        move = np.stack(
            (
                excess * rest.by_exit - rest.away * turn_out,
                -excess * rest.by_entry - rest.away * turn,
            ),
            axis=1,
        )
        move /= rest.det[:, None]
        longest = np.abs(move).max(axis=1)
        move *= np.minimum(1.0, STRIDE / longest)[:, None]
        phi = phi + move
        found = longest < CLOSE
        if found.any():
            done.append(ends_at(path, which[found], phi[found]))
        apart = phi[:, 1] - phi[:, 0]
        live = ~found & (longest < math.inf) & (apart > 0.0) & (apart < math.tau)
        if step == STEPS - 1:
            # slowly towards each other: at a cusp, which is no pair
            live &= (np.abs(rest.excess) < DOUBTFUL) & (apart > math.tau / GRID)
            doubtful.append(taken(ends, live))
        which, phi = which[live], phi[live]
        if not len(which):
            break
    if not done:
        done.append(ends_at(path, which[:0], phi[:0]))
    last = doubtful[0] if doubtful else taken(ends, slice(0, 0))
    return Ends(*(np.concatenate(parts) for parts in zip(*done, strict=True))), last


def _in_order(ends: Ends) -> Ends:
    """Entry first: from there the path heads for the exit."""
    ahead = ((ends.p[:, 1] - ends.p[:, 0]) * ends.t.sum(axis=1).conj()).real > 0.0
    later = np.stack((ends.phi[:, 1], ends.phi[:, 0] + math.tau), axis=1)
    phi = np.where(ahead[:, None], ends.phi, later)
    rest = (np.where(ahead[:, None], part, part[:, ::-1]) for part in ends[2:])
    return Ends(ends.which, phi, *rest)
