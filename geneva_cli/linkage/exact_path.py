"""Points of a roller's path, and vectors, in 50 digits."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import NamedTuple, TypeAlias, cast

from geneva_cli.kinematics.roller_path import RollerPath, exactly
from geneva_cli.numerics import digits
from geneva_cli.numerics.jet import Jet

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
