"""Straight slots behind a side-crank (A = 0: a plain crank), as functions of the crank's angle.

With f the crank's angle from mid-motion, C = sqrt(1 - A² sin² f) and rho = C + A cos f, the
side-crank has the derivatives

    f1 = C / rho,   f2 = A (1-A²) sin f / rho³        (by the input angle)

and the wheel's acceleration is g2 f1² + g1 f2, with g1 and g2 the wheel's derivatives by f (see
``classic_arrays``). As functions of f all of them are smooth even where |A| is near 1; over the
input angle everything would then happen within a small part of it. C² is written as a sum of
squares, and rho as (1-A²)/(C - A cos f) where A cos f < 0, so nothing cancels.

With c = cos f, g = 1 outside and -1 inside, and D = 1 - 2 g l c + l², the acceleration is

    - l sin f h / (D² rho³),    h = (1-l²) C² rho - (c - g l) D A (1-A²)

so that the velocity falls with f > 0 where h > 0. Outside, h has no zero and the velocity's peak is
at mid-motion: there D <= 1 - l² and c - l <= c for c >= l, and C² >= 1 - A², so that
h >= (1-l²) (1-A²) (rho - A c) > 0 for A > 0; for A < 0 it is a sum of positive terms. Inside it
has none for A <= 0.

Outside, and inside for A <= 0, the acceleration is so below zero for f > 0, and greatest in size at
an end or where its slope rises through zero.

Inside, for A >= 0, it is greatest in its jump at the ends, l (C/rho)² / sqrt(1-l²) with c = -l.
Where h >= 0 it is at most l (1-l²) (s/D²) (C/rho)², of which both factors are greatest at c = -l.
Where h < 0 it is below l s (c + l) A (1-A²) / (D rho³). With u = A/rho, (1-A²)/rho² = 1 - 2 c u and
C/rho = 1 - c u; that at the end is at least 1 + l u, as rho is least there. Over the jump it is so
below the product of

    s sqrt(1-l²) / D    and    (c + l) u (1 - 2 c u) / (1 + l u)²

For c >= 0 the first is at most 1, and the second below 1/2; for c < 0 the second is below 1/2 too,
and the first at most 1/sqrt(1-l²), which is 2 or less from three slots on.

Every function takes the library (``math`` or ``numpy``) and runs on one design's floats or on
arrays of designs.

Source: theory of the side-crank, f = atan2(sin phi, A + cos phi) and its derivatives, with phi
eliminated by the triangle of base, crank and coulisse.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, NamedTuple, TypeVar

from geneva_cli.numerics.arrays import choose

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Library, Truth

K = TypeVar("K", float, "Array")


class Wheel(NamedTuple, Generic[K]):
    """A wheel behind a side-crank, or arrays of many: the numbers that the formulas use."""

    sign: K  # +1 external, -1 internal
    l: K  # sin(pi/z)
    rest: K  # 1 - l
    tan: K  # tan(pi/z)
    half: K  # crank angle of half the motion, radians
    A: K
    end: tuple[K, K]  # sine and cosine of ``half``, exactly: cos b and +-l
    big: K  # 1 + 4 l + l²
    rest2: K  # (1-l)²
    minus: K  # 1 - A²


def wheel_of(sign: K, l: K, rest: K, cos_b: K, half: K, A: K) -> Wheel[K]:
    """The wheel of l = sin b, 1 - l, cos b, half the motion (radians) and A."""
    big = 1.0 + l * (4.0 + l)
    minus = (1.0 - A) * (1.0 + A)
    return Wheel(sign, l, rest, l / cos_b, half, A, (cos_b, sign * l), big, rest * rest, minus)


def _front(m: Library, w: Wheel[K], s: K, c: K) -> tuple[K, K]:
    """C and rho where the crank's sine and cosine are s and c."""
    C = m.sqrt(c * c + w.minus * (s * s))
    Ac = w.A * c
    long = C + abs(Ac)
    if isinstance(Ac, float):
        return C, w.minus / long if Ac < 0.0 else long
    return C, choose(Ac < 0.0, w.minus / long, long)


def acceleration(m: Library, w: Wheel[K], f: K) -> tuple[K, K]:
    """The size of the acceleration at the crank angle f, and the input angle there, radians."""
    s, c, v, C, rho = _at(m, w, f)
    D = w.rest2 + 2.0 * w.l * v
    f1 = C / rho
    # l sin f is common to both terms
    wheel = w.rest * (1.0 + w.l) * (f1 / D) * (f1 / D)
    front = w.sign * (w.rest - v) / D * (w.A * w.minus / rho) / (rho * rho)
    return w.l * s * abs(wheel - front), _input(m, w, s, c, C, rho)


def _at(m: Library, w: Wheel[K], f: K) -> tuple[K, K, K, K, K]:
    """At the crank angle f its sine and cosine, the versine, C and rho."""
    sine, cosine = m.sin(0.5 * f), m.cos(0.5 * f)
    s, c = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    C, rho = _front(m, w, s, c)
    return s, c, _versine(w, sine, cosine), C, rho


def _versine(w: Wheel[K], sine: K, cosine: K) -> K:
    """1 - cos f outside, 1 + cos f inside, from the half angle."""
    if isinstance(sine, float):
        half = sine if w.sign > 0.0 else cosine
    else:
        half = choose(w.sign > 0.0, sine, cosine)
    return 2.0 * half * half


def _input(m: Library, w: Wheel[K], s: K, c: K, C: K, rho: K) -> K:
    """The input angle, radians: the end of the coulisse as seen from the input crank's axis."""
    return m.atan2(rho * s, C * c - w.A * (s * s))


def acceleration_at_end(m: Library, w: Wheel[K]) -> tuple[K, K]:
    """The acceleration's jump at entry and exit, tan(b) f1², and the input angle there, radians."""
    s, c = w.end
    C, rho = _front(m, w, s, c)
    f1 = C / rho
    return w.tan * f1 * f1, _input(m, w, s, c, C, rho)


def may_pass_the_jump(w: Wheel[K]) -> Truth:
    """Whether the acceleration may be greater within than at its ends."""
    return (w.sign > 0.0) | (w.A < 0.0)


def may_peak_aside(w: Wheel[K]) -> Truth:
    """Whether the velocity may be greatest elsewhere than at mid-motion."""
    return (w.sign < 0.0) & (w.A > 0.0)


def acceleration_slope_sign(m: Library, w: Wheel[K], c: K) -> K:
    """The sign of the acceleration's slope over f, as a number.

    It is the slope over f1² l (1-l²) times (C D)³, both positive; (1-A²) / rho is C - A cos f.
    """
    Ac, c2 = w.A * c, c * c
    s2, C2 = 1.0 - c2, w.minus + Ac * Ac
    C = m.sqrt(C2)
    v = 1.0 - w.sign * c
    lv = 2.0 * w.l * v
    D = w.rest2 + lv
    N = v * (w.big - lv) - w.rest2
    g1 = w.sign * (w.rest - v) / (w.rest * (1.0 + w.l))
    front = w.A * (C - Ac) * D  # f2 / (f1² sin f), times C² D
    return w.sign * N * C * C2 - front * (3.0 * s2 * C - D * g1 * (c * C + 3.0 * w.A * s2))


def acceleration_slopes(m: Library, w: Wheel[K], f: K) -> tuple[K, K]:
    """First and second derivative of the acceleration by f, both over f1² l (1-l²) / D³."""
    s, c, v, C, rho = _at(m, w, f)
    l, A, sign = w.l, w.A, w.sign
    D = w.rest2 + 2.0 * l * v
    N = v * (w.big - 2.0 * l * v) - w.rest2
    g1 = sign * (w.rest - v) / (w.rest * (1.0 + l)) * D * D  # each times D³
    g2 = -s * D
    g3 = sign * N
    g4 = s * ((w.big - 4.0 * l * v) - 6.0 * l * N / D)
    p = A * w.minus / (rho * C * C)
    u = A * s / C
    q = c + 3.0 * u * s
    f2 = p * s  # each over f1²
    f2_f = p * q
    f2_ff = p * (3.0 * u * q - s + 3.0 * u * c * (2.0 + u * u))
    return g3 + 3.0 * g2 * f2 + g1 * f2_f, g4 + 5.0 * g3 * f2 + 4.0 * g2 * f2_f + g1 * f2_ff


def velocity_fall(m: Library, w: Wheel[K], c: K) -> K:
    """h / rho: above 0 where the velocity falls."""
    Ac = w.A * c
    C2 = w.minus + Ac * Ac
    v = 1.0 - w.sign * c
    D = w.rest2 + 2.0 * w.l * v
    # (1-A²) / rho is C - A cos f
    return w.rest * (1.0 + w.l) * C2 - w.sign * (w.rest - v) * D * w.A * (m.sqrt(C2) - Ac)


def velocity_fall_slope(m: Library, w: Wheel[K], f: K) -> tuple[K, K]:
    """h and its slope over f."""
    s, c, v, C, rho = _at(m, w, f)
    D = w.rest2 + 2.0 * w.l * v
    own, front = w.rest * (1.0 + w.l), w.A * w.minus
    slope = front * (D - 2.0 * w.l * (w.rest - v)) - own * w.A * rho * (2.0 * w.A * c + C)
    return own * C * C * rho - w.sign * (w.rest - v) * D * front, s * slope


def velocity(m: Library, w: Wheel[K], f: K) -> tuple[K, K]:
    """The velocity at the crank angle f, and the input angle there, radians."""
    s, c, v, C, rho = _at(m, w, f)
    D = w.rest2 + 2.0 * w.l * v
    return w.sign * w.l * (w.rest - v) / D * (C / rho), _input(m, w, s, c, C, rho)
