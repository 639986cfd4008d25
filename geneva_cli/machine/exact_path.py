"""Points of a roller's path, and vectors, in 50 digits."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import NamedTuple, TypeAlias, cast

from geneva_cli.machine.roller_path import RollerPath, exactly
from geneva_cli.numerics import digits
from geneva_cli.numerics.jet import Jet

Exact: TypeAlias = tuple[Decimal, Decimal]  # a vector in the plane


class ExactPoint(NamedTuple):
    """A point of the path in 50 digits: crank's angle, place, velocity, and its unit vector."""

    phi: Decimal
    sine: Decimal
    cosine: Decimal
    p: Exact
    v: Exact
    t: Exact

    @staticmethod
    def of(path: RollerPath, phi: Decimal) -> ExactPoint:
        """The point at a crank angle in radians."""
        s, c = digits.sin_cos(phi)
        sine, cosine = exactly(s), exactly(c)
        x, y = path.place(Jet((sine, cosine)), Jet((cosine, -sine)), exact=True)
        (px, vx), (py, vy) = cast("tuple[Exact, Exact]", (x.c, y.c))
        return ExactPoint(phi, s, c, (px, py), (vx, vy), unit((vx, vy)))


def length(a: Exact) -> Decimal:
    """A vector's length."""
    return (a[0] * a[0] + a[1] * a[1]).sqrt()


def unit(a: Exact) -> Exact:
    """The vector of length 1."""
    size = length(a)
    return a[0] / size, a[1] / size


def cross(a: Exact, b: Exact) -> Decimal:
    """The vector product's component across the plane."""
    return a[0] * b[1] - a[1] * b[0]


def angle(a: Exact, b: Exact) -> float:
    """The angle from a to b, rounded once."""
    return math.atan2(cross(a, b), a[0] * b[0] + a[1] * b[1])
