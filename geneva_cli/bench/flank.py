"""A flank in arcs and cubics, as others make them: halved until each piece is accurate enough."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from scipy.spatial import cKDTree

from geneva_cli.curves.measure import at
from geneva_cli.curves.shapes import Arc, Cubic, Line
from geneva_cli.layout.slot_profile import slot
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.jet import Array

if TYPE_CHECKING:
    Curve = Callable[[Array], tuple[Array, Array]]
    P = TypeVar("P", Arc, Cubic)

PARTS = 40  # parts of a piece, at whose ends the search for the nearest place begins


def left_flank(mechanism: Mechanism) -> tuple[Curve, float, float]:
    """The left flank on the pin's way in, for a slot without a corner there."""
    entry = mechanism.engagements[0].entry_deg
    reach = mechanism.roller_radius_mm + mechanism.spec.size.allowances.slot_clearance_mm

    def curve(input_deg: Array) -> tuple[Array, Array]:
        profile = slot(mechanism, input_deg)
        normal = (profile.left - profile.centre) / reach
        return profile.left, np.column_stack((normal[:, 1], -normal[:, 0]))

    return curve, entry, 0.0


def biarcs(curve: Curve, a: float, b: float, tolerance: float) -> list[Arc]:
    """Biarcs with handles of equal length, on intervals halved in the parameter."""

    def fitted(p: complex, q: complex, t: complex, u: complex) -> list[Arc]:
        # |q - p - d (t + u)| = 2 d: the joint is midway between the ends of both handles.
        v, both = q - p, t + u
        along = (v * both.conjugate()).real
        rest = 4.0 - abs(both) ** 2
        handle = abs(v) ** 2 / (along + (along * along + rest * abs(v) ** 2) ** 0.5)
        joint = 0.5 * (p + handle * t + q - handle * u)
        turns = np.angle((joint - p) / t), np.angle(u / (q - joint))
        ends = (p.real, p.imag), (joint.real, joint.imag), (q.real, q.imag)
        return [Arc(ends[i], ends[i + 1], float(np.tan(0.5 * turns[i]))) for i in (0, 1)]

    return _halved(curve, a, b, tolerance, fitted)


def hermite_cubics(curve: Curve, a: float, b: float, tolerance: float) -> list[Cubic]:
    """Cubics with handles of a third of the chord, on intervals halved in the parameter."""

    def fitted(p: complex, q: complex, t: complex, u: complex) -> list[Cubic]:
        third = abs(q - p) / 3.0
        knots = (p, p + third * t, q - third * u, q)
        return [Cubic(*((z.real, z.imag) for z in knots))]

    return _halved(curve, a, b, tolerance, fitted)


def _halved(
    curve: Curve,
    a: float,
    b: float,
    tolerance: float,
    fitted: Callable[[complex, complex, complex, complex], list[P]],
) -> list[P]:
    """Pieces of a curve from a to b, in halves where one piece misses the tolerance."""
    inner: Array = np.linspace(0.0, 1.0, 34)[1:-1]  # where the distance is measured
    z, t = (v @ np.array([1.0, 1j]) for v in curve(np.array([a, *(a + (b - a) * inner), b])))
    pieces = fitted(complex(z[0]), complex(z[-1]), complex(t[0]), complex(t[-1]))
    if distances(z[1:-1], pieces).max() <= tolerance:
        return pieces
    middle = 0.5 * (a + b)
    return _halved(curve, a, middle, tolerance, fitted) + _halved(
        curve, middle, b, tolerance, fitted
    )


def stray(curve: Curve, a: float, b: float, pieces: Sequence[Line | Arc | Cubic]) -> float:
    """Greatest distance of 20,001 points of the curve from the pieces, mm."""
    z = curve(np.linspace(a, b, 20_001))[0] @ np.array([1.0, 1j])
    return float(distances(z, pieces).max())


def distances(points: Array, pieces: Sequence[Line | Arc | Cubic]) -> Array:
    """Distances of points from pieces that are end to end."""
    grid = np.array([at(piece, u) for piece in pieces for u in np.linspace(0.0, 1.0, PARTS + 1)])
    nearest = cKDTree(grid).query(np.column_stack((points.real, points.imag)))[1]
    own, place = np.divmod(nearest, PARTS + 1)
    fraction, least = place / PARTS, np.full(len(points), np.inf)
    for i, piece in enumerate(pieces):
        # The nearest of the sampled places may be shared by two pieces.
        for mine, u in (
            (own == i, fraction),
            ((own == i + 1) & (place == 0), np.ones(len(points))),
            ((own == i - 1) & (place == PARTS), np.zeros(len(points))),
        ):
            if mine.any():
                least[mine] = np.minimum(least[mine], _from_piece(points[mine], piece, u[mine]))
    return least


def _from_piece(points: Array, piece: Line | Arc | Cubic, u: Array) -> Array:
    """Distances to one piece, starting from places on it near the nearest ones."""
    if isinstance(piece, Arc):
        out: Array = np.abs(np.abs(points - complex(*piece.centre)) - piece.radius)
        return out
    p, *inner, q = (complex(*z) for z in piece)
    first, second = inner or ((2.0 * p + q) / 3.0, (p + 2.0 * q) / 3.0)
    cubic = np.poly1d([q - p + 3.0 * (first - second), 3.0 * (p - 2.0 * first + second)])
    cubic = cubic * np.poly1d([1.0, 0.0, 0.0]) + np.poly1d([3.0 * (first - p), p])
    rate, bend = cubic.deriv(), cubic.deriv(2)
    low, high = np.maximum(u - 1.0 / PARTS, 0.0), np.minimum(u + 1.0 / PARTS, 1.0)
    for _ in range(10):  # Newton steps
        off, along = cubic(u) - points, rate(u)
        slope = np.abs(along) ** 2
        slope = np.maximum(slope + (off * bend(u).conj()).real, 0.5 * slope)
        u = np.clip(u - (off * along.conj()).real / slope, low, high)
    return np.abs(cubic(u) - points)
