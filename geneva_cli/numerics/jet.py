"""Jets: numbers that carry their Taylor coefficients c[k] = f^(k)/k!, floats or NumPy arrays.

The recurrences are those of Griewank and Walther, Evaluating Derivatives, 2nd ed., section 13.2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from math import comb, factorial
from operator import add, sub
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, TypeVar, cast

from geneva_cli.numerics.arrays import SINGLE, Enclosed, Mask, N, enclosed, library, piece_of, size
from geneva_cli.numerics.arrays import Array as Array
from geneva_cli.numerics.arrays import Number as Number


class Jet:
    """Taylor coefficients of a function at a point (float) or at many (arrays)."""

    __slots__ = ("c",)
    __array_ufunc__ = None  # with an array as the other operand, the jet's arithmetic applies

    def __init__(self, coefficients: Iterable[Number]) -> None:
        self.c = tuple(coefficients)

    @staticmethod
    def variable(x: Number, order: int) -> Jet:
        """The independent variable itself at x."""
        one = enclosed(x, (1.0,))
        return Jet((x, *one, *(0.0,) * (order - 1))[: order + 1])

    @property
    def order(self) -> int:
        """The highest derivative carried."""
        return len(self.c) - 1

    def derivatives(self) -> tuple[Any, ...]:
        """Value, first derivative, second, ... up to the order."""
        out = list(self.c)
        for k in range(2, len(out)):
            out[k] = out[k] * factorial(k)
        return tuple(out)

    @property
    def lower(self) -> Jet:
        """The jet without its highest derivative."""
        return Jet(self.c[:-1])

    def derivative(self) -> Jet:
        """The jet of the derivative, one order lower."""
        out = list(self.c[1:])
        for k in range(1, len(out)):
            out[k] = (k + 1) * out[k]
        return Jet(out)

    # of two jets of different orders the sum has the lower one
    def __add__(self, other: Jet | Number) -> Jet:
        if isinstance(other, Jet):
            return Jet(map(add, self.c, other.c))
        return Jet((self.c[0] + other, *self.c[1:]))

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return self * -1

    def __sub__(self, other: Jet | Number) -> Jet:
        if isinstance(other, Jet):
            return Jet(map(sub, self.c, other.c))
        return Jet((self.c[0] - other, *self.c[1:]))

    def __rsub__(self, other: Number) -> Jet:
        return self * -1 + other

    def __mul__(self, other: Jet | Number) -> Jet:
        a, b = self.c, other.c if isinstance(other, Jet) else (other,)
        if isinstance(other, Jet) and not _is_constant(b):
            if not _is_constant(a):
                out = []
                for k in range(len(a)):
                    out.append(_convolve(a, b, k, 0))
                return Jet(out)
            a, b = b, a
        factor = b[0]  # coefficients that are the number 0, not an array, stay so
        out, vanishes = [a[0] * factor], isinstance(factor, float) and not factor
        for one in a[1:]:
            zero = vanishes or (isinstance(one, float) and not one)
            out.append(0.0 if zero else one * factor)
        return Jet(out)

    __rmul__ = __mul__

    def __truediv__(self, other: Jet | Number) -> Jet:
        b = other.c if isinstance(other, Jet) else (other,)
        divisor, q = b[0], [self.c[0] / b[0]]
        if not isinstance(other, Jet) or _is_constant(b):
            for a in self.c[1:]:
                q.append(a / divisor)
        else:
            for k in range(1, len(self.c)):
                q.append((self.c[k] - _convolve(q, b, k, 0, k)) / divisor)
        return Jet(q)

    def __rtruediv__(self, other: Number) -> Jet:
        return Jet((other, *[0.0] * self.order)) / self


Vector: TypeAlias = tuple[Jet, Jet]
# A force at the pin's centre and a couple, both on the roller's body; the couple in that unit x L.
Load: TypeAlias = tuple[Vector, Jet]
Loads: TypeAlias = Sequence[Load]
# Reactions of the crank's shaft and of the body's other guide to each load.
Held: TypeAlias = list[tuple[Vector, Vector]]


if TYPE_CHECKING:

    class Path(Protocol):
        """The pin's position (x, y) in the fixed frame, by the input angle in degrees."""

        def __call__(self, input_deg: Number, order: int = 3) -> Vector: ...

    class Displacement(Protocol):
        """A pin's displacement along a ray and across it, ``tau`` input radians later.

        Or a crank's rotation d since then, as sin d and 1 - cos d.
        """

        def __call__(self, tau: Number, order: int) -> Vector: ...

    class Rate(Protocol):
        """Rate of a body per input radian, ``tau`` after mid-motion, positive with the wheel."""

        def __call__(self, tau: Number, order: int) -> Jet: ...

    class Reactions(Protocol):
        """Reactions on the body that carries the roller, held by links without mass or friction.

        They are those of the crank's shaft, and of the body's other guide (a rocker, slider, groove
        or fixed gear). ``turn`` is the input's rotation since mid-motion; the pin's ``path`` is one
        order higher.
        """

        def __call__(self, turn: Jet, path: Vector, loads: Loads) -> Held: ...

else:
    Path = Displacement = Rate = Reactions = object


def cross(a: Vector, b: Vector) -> Jet:
    """Third component of the vector product of two plane vectors."""
    return a[0] * b[1] - a[1] * b[0]


def turned(x: Jet, y: Jet, angle: float) -> Vector:
    """Turn a vector by a fixed angle in radians."""
    if isinstance(angle, float) and angle == 0.0:
        return x, y
    m = library(angle)
    s, c = m.sin(angle), m.cos(angle)
    return x * c - y * s, x * s + y * c


# Jets, or their values: formulas that hold for both.
V = TypeVar("V", Jet, "Array")


def _is_constant(c: Sequence[Number], first: int = 1) -> bool:
    """Return True if there are coefficients from ``first`` on, each the number 0, not an array."""
    for k in range(first, len(c)):
        one = c[k]
        if not isinstance(one, float) or one:
            return False
    return len(c) > first


def _convolve(
    a: Sequence[Number], b: Sequence[Number], k: int, first: int, last: int | None = None
) -> Number:
    """The sum of a[i] b[k - i] from the first i on, to k or before the last."""
    total = a[first] * b[k - first]
    for i in range(first + 1, k + 1 if last is None else last):
        total = total + a[i] * b[k - i]
    return total


def sin_cos(x: Jet) -> tuple[Jet, Jet]:
    """Sine and cosine of a jet, whose recurrences need each other."""
    m = library(x.c[0])
    return _circle((0.0, *x.derivative().c), m.sin(x.c[0]), m.cos(x.c[0]))


def sin(x: Jet) -> Jet:
    """Sine of a jet; a value alone needs no cosine."""
    return sin_cos(x)[0] if x.order else Jet((library(x.c[0]).sin(x.c[0]),))


def _circle(slope: Sequence[Number], sine: Number, cosine: Number) -> tuple[Jet, Jet]:
    """Sine and cosine of an angle with derivative series ``slope[1:]``, from their values."""
    s, c = [sine], [cosine]
    uniform = len(slope) == 2 or _is_constant(slope, 2)  # such as the input's rotation
    for k in range(1, len(slope)):
        if uniform:
            step = slope[1] / k
            along, across = c[-1] * step, s[-1] * -step
        else:
            along, across = _convolve(slope, c, k, 1) / k, -_convolve(slope, s, k, 1) / k
        s.append(along)
        c.append(across)
    return Jet(s), Jet(c)


def cosines_after(sine: Number, cosine: Number, order: int) -> list[Number]:
    """Taylor coefficients of a cosine by its own angle, from the sine and cosine there."""
    terms = [cosine, -sine]
    for k in range(2, order + 1):
        terms.append(terms[k - 2] / (k - k * k))
    return terms[: order + 1]


def sine_versine(x: Jet) -> tuple[Jet, Jet]:
    """sin x and 1 - cos x, the latter without cancellation."""
    half = library(x.c[0]).sin(0.5 * x.c[0])
    versine = 2.0 * half * half
    if not x.order:
        return sin(x), Jet((versine,))
    s, c = sin_cos(x)
    return s, Jet((versine, *(c * -1).c[1:]))


def rotation(tau: Number, order: int) -> tuple[Jet, Jet]:
    """sin and 1 - cos of an angle, by itself: ``sine_versine`` written out, as most need it."""
    m, (one,) = library(tau), enclosed(tau, (1.0,))
    half, sine = m.sin(0.5 * tau), m.sin(tau)
    cosine = m.cos(tau) if order else sine  # a value alone needs none
    s, versine = [sine], [2.0 * half * half]
    for k in range(1, order + 1):
        step = one / k
        sine, across = cosine * step, sine * step
        cosine = -across
        s.append(sine)
        versine.append(across)
    return Jet(s), Jet(versine)


def sine_versine_of(rate: Jet, y: Number, x: Number, order: int) -> tuple[Jet, Jet]:
    """sin and 1 - cos of the direction of the vector (x, y), which turns at ``rate``."""
    m = library(x, y)
    length = m.hypot(x, y)
    sine, cosine = y / length, x / length
    versine = 1.0 - cosine
    if not isinstance(cosine, Enclosed):  # without cancellation where the cosine is positive
        ahead = 0.5 * (1.0 + library(cosine).copysign(1.0, cosine))
        versine = ahead * sine * sine / (1.0 + size(cosine)) + (1.0 - ahead) * versine
    s, c = _circle((0.0, *rate.c)[: order + 1], sine, cosine)
    return s, Jet((versine, *(c * -1).c[1:]))


def composed(outer: Jet, inner: Jet) -> Jet:
    """f(g) by the chain rule, from f as a function of g, about g's value, and from g."""
    step = Jet((inner.c[0] * 0.0, *inner.c[1:]))
    total = step * 0.0 + outer.c[-1]
    for c in reversed(outer.c[:-1]):
        total = total * step + c
    return total


def taylor(t: N, c: Sequence[N], order: int) -> list[N]:
    """Taylor coefficients 0 to ``order`` at t of the polynomial sum c_k t^k."""
    c = enclosed(t, tuple(c))
    out = []
    for k in range(order + 1):
        sum_ = 0.0 * t
        for j in reversed(range(k, len(c))):
            sum_ = sum_ * t + comb(j, k) * c[j]
        out.append(sum_)
    return out


def sqrt(x: Jet) -> Jet:
    """Square root of a positive jet."""
    q = [library(x.c[0]).sqrt(x.c[0])]
    twice = 2 * q[0]
    for k in range(1, len(x.c)):
        q.append((x.c[k] - _convolve(q, q, k, 1, k) if k > 1 else x.c[k]) / twice)
    return Jet(q)


def integral(slope: Jet, value: Number) -> Jet:
    """The jet, one order higher, whose derivative is ``slope`` and whose value is ``value``."""
    return Jet((value, *[c / (k + 1) for k, c in enumerate(slope.c)]))


def atan2(y: Jet, x: Jet) -> Jet:
    """Angle of the vector (x, y), from its rate (x y' - y x') / (x² + y²)."""
    value = library(y.c[0], x.c[0]).atan2(y.c[0], x.c[0])
    if len(y.c) == 1:
        return Jet((value,))
    return integral(turning(x, y), value)


def turning(x: Jet, y: Jet, less: Jet | None = None, square: Jet | None = None) -> Jet:
    """The rate at which the vector (x, y) turns, (x y' - y x') / (x² + y²), one order lower.

    Or that less the derivative of a jet ``less`` in the numerator, and over another ``square``.
    """
    if len(x.c) == 1:
        return Jet(())
    low_x, low_y = x.lower, y.lower
    moment = low_x * y.derivative() - low_y * x.derivative()
    if less is not None:
        moment = moment - less.derivative()
    return moment / (low_x * low_x + low_y * low_y if square is None else square.lower)


def piecewise(x: Number, cuts: Sequence[Number], pieces: Sequence[Callable[[Number], Jet]]) -> Jet:
    """``pieces[i](x)`` for x between ``cuts[i-1]`` and ``cuts[i]``, the upper end included."""
    if isinstance(x, SINGLE) and isinstance(cuts[0], float) and isinstance(cuts[-1], float):
        return pieces[piece_of(x, cast("Sequence[float]", cuts))](x)
    import numpy as np

    angles, out = np.asarray(x), list[Number]()
    past: Mask = np.full(angles.shape, True)  # the cut before
    with np.errstate(all="ignore"):  # outside their own part formulas may have no value
        for piece, cut in zip(pieces, (*cuts, np.inf), strict=True):
            beyond = angles > cut
            if (past & ~beyond).any():
                own = piece(x).c
                both = zip(out, own, strict=True)
                out = [np.where(past, b, a) for a, b in both] if out else [*own]
            past = beyond
    return Jet(out or pieces[-1](x).c)  # also of no angles
