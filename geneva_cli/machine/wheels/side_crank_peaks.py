"""Peak velocity and acceleration of very many wheels at once, or the latter of one in plain
Python: straight slots behind a side-crank (A = 0: a plain crank).

With f the crank's angle from mid-motion, C = sqrt(1 - A² sin² f) and rho = C + A cos f,

    f1 = C / rho,   f2 = A (1-A²) sin f / rho³        (by the input angle)
    acceleration = g2 f1² + g1 f2                     (g: the wheel over f, as in kernel.py)

so that everything is a function of f, in which even |A| near 1 is tame: over the input angle all
would happen within a sliver of it. C is a sum of squares and rho = (1-A²)/(C - A cos f) where
A cos f < 0, so nothing cancels. The slope over f, divided by f1² and the wheel's constant, is
scanned for changes of sign, each is refined by Newton kept in its bracket, and the end of the
motion competes.

The velocity is greatest where the acceleration, without what vanishes with sin f, is zero:

    h = (1-l²) C² rho - g (c - g l) D A (1-A²)        (g = 1 outside, -1 inside; c = cos f)

The velocity falls where h > 0. Outside h has no zero, and the peak is at mid-motion: D <= 1 - l²
and c - l <= c for c >= l, and C² >= 1 - A², so that h >= (1-l²) (1-A²) (rho - A c) > 0 for A > 0,
and a sum of positive terms for A < 0. Inside it has none for A <= 0.

Source: theory of the side-crank, f = atan2(sin phi, A + cos phi) and its derivatives, with the
triangle of base, crank and coulisse put in for phi.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Generic, NamedTuple, TypeAlias, TypeVar

from geneva_cli.errors import GenevaError
from geneva_cli.machine.wheels.classic import half_motion_deg
from geneva_cli.numerics.angles import DEGREE, one_minus_sin_pi, sin_cos_pi
from geneva_cli.numerics.arrays import PLAIN, choose, library
from geneva_cli.numerics.roots import root
from geneva_cli.spec.rules import Z_MAX

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Library, Mask, Number, Truth, Which, Whole

SCAN = 10  # intervals of the scan; 8 miss none of a million designs, 6 miss twelve
SCAN_ONE = 16  # of one design
BLOCK = 8192  # designs at a time: what the scan works on stays in the processor's cache
CLOSE = 1e-7  # a Newton step this short has converged: the next error is its square
SOON, STEPS = 3, 60  # steps of Newton: in a block, and at most
EXACT_Z = 64  # from here on, rounding pi/z costs less than half a unit in the last place


K = TypeVar("K", float, "Array")


class Wheel(NamedTuple, Generic[K]):
    """One design, or arrays of many: what the formulas need of it."""

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


def _wheel(sign: K, l: K, rest: K, cos_b: K, half: K, A: K) -> Wheel[K]:
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


def _value(m: Library, w: Wheel[K], f: K) -> tuple[K, K]:
    """The size of the acceleration at the crank angle f, and the input angle there."""
    sine, cosine = m.sin(0.5 * f), m.cos(0.5 * f)
    s, c = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    v = _versine(m, w, sine, cosine)
    C, rho = _front(m, w, s, c)
    D = w.rest2 + 2.0 * w.l * v
    f1 = C / rho
    # l sin f is common to both terms
    wheel = w.rest * (1.0 + w.l) * (f1 / D) * (f1 / D)
    front = w.sign * (w.rest - v) / D * (w.A * w.minus / rho) / (rho * rho)
    return w.l * s * abs(wheel - front), _input(m, w, s, c, C, rho)


def _versine(m: Library, w: Wheel[K], sine: K, cosine: K) -> K:
    """1 - cos f outside, 1 + cos f inside, from the half angle."""
    if isinstance(sine, float):
        half = sine if w.sign > 0.0 else cosine
    else:
        half = choose(w.sign > 0.0, sine, cosine)
    return 2.0 * half * half


def _input(m: Library, w: Wheel[K], s: K, c: K, C: K, rho: K) -> K:
    """The input angle, radians: the end of the coulisse as seen from the input crank's axis."""
    return m.atan2(rho * s, C * c - w.A * (s * s))


def _end(m: Library, w: Wheel[K]) -> tuple[K, K]:
    """The acceleration's jump at entry and exit, tan(b) f1², and the input angle there."""
    s, c = w.end
    C, rho = _front(m, w, s, c)
    f1 = C / rho
    return w.tan * f1 * f1, _input(m, w, s, c, C, rho)


def _slope(m: Library, w: Wheel[K], c: K) -> K:
    """The acceleration's slope over f, divided by f1² and by l (1-l²): only its sign counts.

    It is taken times (C D)³, which is positive; (1-A²) / rho is C - A cos f.
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


def _slopes(m: Library, w: Wheel[K], f: K) -> tuple[K, K]:
    """First and second derivative of the acceleration over f, both over f1² l (1-l²) / D³."""
    sine, cosine = m.sin(0.5 * f), m.cos(0.5 * f)
    s, c = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    v = _versine(m, w, sine, cosine)
    C, rho = _front(m, w, s, c)
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


def _rest(m: Library, w: Wheel[K], c: K) -> K:
    """h / rho, by its sign the acceleration without what vanishes with sin f."""
    Ac = w.A * c
    C2 = w.minus + Ac * Ac
    v = 1.0 - w.sign * c
    D = w.rest2 + 2.0 * w.l * v
    # (1-A²) / rho is C - A cos f
    return w.rest * (1.0 + w.l) * C2 - w.sign * (w.rest - v) * D * w.A * (m.sqrt(C2) - Ac)


def _rests(m: Library, w: Wheel[K], f: K) -> tuple[K, K]:
    """h and its slope over f."""
    sine, cosine = m.sin(0.5 * f), m.cos(0.5 * f)
    s, c = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    v = _versine(m, w, sine, cosine)
    C, rho = _front(m, w, s, c)
    D = w.rest2 + 2.0 * w.l * v
    own, front = w.rest * (1.0 + w.l), w.A * w.minus
    slope = front * (D - 2.0 * w.l * (w.rest - v)) - own * w.A * rho * (2.0 * w.A * c + C)
    return own * C * C * rho - w.sign * (w.rest - v) * D * front, s * slope


def _velocity(m: Library, w: Wheel[K], f: K) -> tuple[K, K]:
    """The velocity at the crank angle f, and the input angle there."""
    sine, cosine = m.sin(0.5 * f), m.cos(0.5 * f)
    s, c = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    v = _versine(m, w, sine, cosine)
    C, rho = _front(m, w, s, c)
    D = w.rest2 + 2.0 * w.l * v
    return w.sign * w.l * (w.rest - v) / D * (C / rho), _input(m, w, s, c, C, rho)


def acceleration_peak(z: int, sign: float, A: float) -> tuple[float, float]:
    """Peak |acceleration| of one design (invariant) and its signed input angle, degrees.

    ``sign`` is +1 outside, -1 inside. NumPy is not imported. Errors as of ``acceleration_peaks``.
    """
    _refuse(3 <= z <= Z_MAX, sign in (1.0, -1.0), -1.0 < A < 1.0)
    l, cos_b = sin_cos_pi(1, z)
    half = half_motion_deg(sign, 1, z) * DEGREE
    w = _wheel(sign, l, one_minus_sin_pi(1, z), cos_b, half, A)
    best = _end(PLAIN, w)
    step = half / SCAN_ONE
    before = 0.0
    for i in range(SCAN_ONE + 1):
        here = _slope(PLAIN, w, math.cos(i * step) if i < SCAN_ONE else w.end[1])
        if before * here < 0.0:
            f = root(lambda f: _slopes(PLAIN, w, f), (i - 1) * step, i * step, before)
            best = max(best, _value(PLAIN, w, f))
        before = here
    return best[0], -best[1] / DEGREE


def acceleration_peaks(
    z: Number | Whole, internal: Truth | Sequence[bool], A: Number
) -> tuple[Array, Array]:
    """Peak |acceleration| of many designs, and where.

    ``z`` (whole numbers from 3), ``internal`` (booleans) and ``A`` (above -1, below 1) are scalars
    or arrays that broadcast to n designs, (n,) or (n, 1). Returns two such arrays: the peak as an
    invariant, that is in units of the input speed squared (rad/rad²), and the signed input angle of
    its first occurrence in degrees from mid-motion.

    The peak's relative error is at most 4e-15, its angle's as a double allows. Raises GenevaError
    where a value is out of its range.
    """

    w, shape = _designs(z, internal, A)
    size, at = _end(library(w.l), w)
    _compete(w, size, at, ACCELERATION)
    at /= -DEGREE
    return size.reshape(shape), at.reshape(shape)


def velocity_peaks(
    z: Number | Whole, internal: Truth | Sequence[bool], A: Number
) -> tuple[Array, Array]:
    """Peak velocity of many designs (invariant) and its signed input angle, degrees.

    Everything as of ``acceleration_peaks``.

    >>> velocity_peaks(6, [False, True], 0.6)[0]
    array([0.625     , 0.21186864])
    """
    import numpy as np

    w, shape = _designs(z, internal, A)
    size = w.l / (np.where(w.sign > 0.0, w.rest, 1.0 + w.l) * (1.0 + w.A))
    at = np.zeros(len(size))
    several = np.flatnonzero((w.sign < 0.0) & (w.A > 0.0))
    some, best, place = _take(w, several), size[several], at[several]
    _compete(some, best, place, VELOCITY)
    size[several], at[several] = best, place
    at /= -DEGREE
    return size.reshape(shape), (at + 0.0).reshape(shape)


def _designs(
    z: Number | Whole, internal: Truth | Sequence[bool], A: Number
) -> tuple[Wheel[Array], tuple[int, ...]]:
    import numpy as np

    slots, inside, offset = np.broadcast_arrays(
        np.atleast_1d(z), np.asarray(internal), np.asarray(A, dtype=float)
    )
    _refuse(
        bool(((slots >= 3) & (slots <= Z_MAX) & (slots == np.floor(slots))).all()),
        inside.dtype == bool,
        bool((np.abs(offset) < 1.0).all()),
    )
    return _wheels(slots.ravel(), inside.ravel(), offset.ravel()), slots.shape


def _refuse(z: bool, gearing: bool, A: bool) -> None:
    if not z:
        raise GenevaError(f"z must be whole numbers from 3 to {Z_MAX}")
    if not gearing:
        raise GenevaError("the gearing must be external or internal (internal: true or false)")
    if not A:
        raise GenevaError("A must be above -1 and below 1")


def _wheels(z: Array, internal: Mask, A: Array) -> Wheel[Array]:
    import numpy as np

    b = np.pi / z
    l, cos_b = np.sin(b), np.cos(b)
    rest = 1.0 - l
    few = np.arange(3, EXACT_Z)
    exact = np.array([(*sin_cos_pi(1, int(n)), one_minus_sin_pi(1, int(n))) for n in few])
    small = np.flatnonzero(z < EXACT_Z)
    l[small], cos_b[small], rest[small] = exact[z[small].astype(int) - 3].T
    sign = np.where(internal, -1.0, 1.0)
    return _wheel(sign, l, rest, cos_b, 0.5 * np.pi - sign * b, A)


# of the crank angle f
OfAngle: TypeAlias = "Callable[[Library, Wheel[Array], Array], tuple[Array, Array]]"


class Search(NamedTuple):
    """A quantity: what is zero where it may be greatest, that with its slope, and its size."""

    zero: Callable[[Library, Wheel[Array], Array], Array]  # of cos f
    slopes: OfAngle
    value: OfAngle  # size and input angle
    close: float = CLOSE  # h may be all but flat where it is zero
    only_rising: bool = False  # where it falls through zero, the quantity is least


ACCELERATION = Search(_slope, _slopes, _value)
VELOCITY = Search(_rest, _rests, _velocity, 1e-11, True)


class Brackets(NamedTuple):
    """Where a search's function changes sign: designs, the places beside it, a guess between."""

    which: Whole
    low: Array
    guess: Array
    high: Array
    falling: Mask


def _compete(w: Wheel[Array], size: Array, at: Array, search: Search) -> None:
    """Puts greater sizes, with their places, where ``size`` and ``at`` have less.

    Designs go through in blocks; the few that Newton is not soon done with wait for each other.
    """
    import numpy as np

    late = []
    for first in range(0, len(size), BLOCK):
        block = slice(first, first + BLOCK)
        part = _take(w, block)
        found = _scanned(part, search)
        left = _refined(part, (size[block], at[block]), search, found, SOON)
        late.append(left._replace(which=left.which + first))
    if late:
        joined = Brackets(*(np.concatenate(parts) for parts in zip(*late, strict=True)))
        _refined(w, (size, at), search, joined, STEPS)


def _scanned(w: Wheel[Array], search: Search) -> Brackets:
    """The changes of sign between the places of a scan."""
    import numpy as np

    step = w.half / SCAN
    c, c_next = np.ones(len(step)), np.cos(step)
    turn = 2.0 * c_next
    last = before = np.zeros(len(step))
    brackets = []
    for i in range(SCAN + 1):
        here = search.zero(library(w.l), w, c if i < SCAN else w.end[1])
        turned = before * here < 0.0
        which = np.flatnonzero(turned & (here > 0.0) if search.only_rising else turned)
        left, right, near = before[which], here[which], step[which]
        # a straight line through the first two, a parabola through three
        share = _crossing(last[which] if i > 1 else 2.0 * left - right, left, right)
        low = (i - 1.0) * near
        brackets.append((which, low, low + share * near, low + near, left > 0.0))
        last, before = before, here
        c, c_next = c_next, turn * c_next - c
    return Brackets(*(np.concatenate(parts) for parts in zip(*brackets, strict=True)))


def _crossing(last: Array, left: Array, right: Array) -> Array:
    """Where the parabola through values at -1, 0 and 1 is zero between the latter two."""
    import numpy as np

    tilt, bend = 0.5 * (right - last), 0.5 * (right + last) - left
    root = np.copysign(np.sqrt(np.maximum(tilt * tilt - 4.0 * bend * left, 0.0)), right)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = -2.0 * left / (tilt + root)
    return np.where((share > 0.0) & (share < 1.0), share, 0.5)


def _take(w: Wheel[Array], which: Which) -> Wheel[Array]:
    return Wheel._make((v[0][which], v[1][which]) if isinstance(v, tuple) else v[which] for v in w)


def _refined(
    w: Wheel[Array], best: tuple[Array, Array], search: Search, found: Brackets, steps: int
) -> Brackets:
    """Newton in each bracket, so many steps; what it found is put in ``best``, the rest returned.

    Those that have converged drop out. It is not ``roots_many``'s, with which these peaks took a
    fifth more time: here a step costs little beside the brackets' book-keeping.
    """
    import numpy as np

    some = _take(w, found.which)
    _, a, x, b, falling = found
    out, live, part = np.full(len(x), np.nan), np.arange(len(x)), some
    for _ in range(steps):
        slope, bend = search.slopes(library(part.l), part, x)
        left = (slope > 0.0) == falling
        a, b = np.where(left, x, a), np.where(left, b, x)
        with np.errstate(divide="ignore", invalid="ignore"):
            new = x - slope / bend
        new = np.where((new > a) & (new < b), new, 0.5 * (a + b))
        apart = np.abs(new - x) >= search.close
        out[live] = np.where(apart, np.nan, new)
        far = np.flatnonzero(apart)
        if len(far) < len(live):
            part, a, b, falling, live = _take(part, far), a[far], b[far], falling[far], live[far]
        x = new[far]
        if not len(far):
            break
    size, at = best
    value, where = search.value(library(some.l), some, out)
    more = np.flatnonzero(value > size[found.which])
    # A design may have several roots: the greatest is written last.
    order = more[np.argsort(value[more])]
    size[found.which[order]], at[found.which[order]] = value[order], where[order]
    return Brackets(found.which[live], a, x, b, falling)
