"""Peak velocity and acceleration of straight slots behind a side-crank, of many designs at once.

The acceleration's slope over the crank's angle (see ``side_crank_formulas``) is scanned for changes
of sign; each is refined by Newton kept in its bracket, and the values found compete with the jump
at the end of the motion. The velocity's peak is found likewise. The acceleration's peak of one
design needs no NumPy.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.machine.wheels.classic import half_motion_deg
from geneva_cli.machine.wheels.side_crank_formulas import (
    Wheel,
    acceleration,
    acceleration_at_end,
    acceleration_slope_sign,
    acceleration_slopes,
    may_pass_the_jump,
    may_peak_aside,
    velocity,
    velocity_fall,
    velocity_fall_slope,
    wheel_of,
)
from geneva_cli.numerics.angles import DEGREE, one_minus_sin_pi, sin_cos_pi
from geneva_cli.numerics.arrays import PLAIN, library, read_only
from geneva_cli.numerics.roots import root
from geneva_cli.spec.rules import Z_MAX

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Library, Number, Truth, Which, Whole

SCAN = 10  # intervals of the scan; 8 miss none of a million designs, 6 miss twelve
SCAN_ONE = 16  # of one design
BLOCK = 8192  # designs at a time: what the scan works on stays in the processor's cache
CLOSE = 1e-7  # a Newton step this short has converged: the next error is its square
SOON, STEPS = 3, 60  # steps of Newton: in a block, and at most
EXACT_Z = 64  # from here on, rounding pi/z costs less than half a unit in the last place


def acceleration_peak(z: int, sign: float, A: float) -> tuple[float, float]:
    """Peak |acceleration| of one design (invariant) and its signed input angle, degrees.

    ``sign`` is +1 outside, -1 inside. NumPy is not imported. Errors as of ``acceleration_peaks``.
    """
    _refuse(3 <= z <= Z_MAX, sign in (1.0, -1.0), -1.0 < A < 1.0)
    l, cos_b = sin_cos_pi(1, z)
    half = half_motion_deg(sign, 1, z) * DEGREE
    w = wheel_of(sign, l, one_minus_sin_pi(1, z), cos_b, half, A)
    best = acceleration_at_end(PLAIN, w)
    step = half / SCAN_ONE
    before = 0.0
    for i in range(SCAN_ONE + 1 if may_pass_the_jump(w) else 0):
        here = acceleration_slope_sign(PLAIN, w, math.cos(i * step) if i < SCAN_ONE else w.end[1])
        if before < 0.0 <= here:
            f = root(lambda f: acceleration_slopes(PLAIN, w, f), (i - 1) * step, i * step, before)
            best = max(best, acceleration(PLAIN, w, f))
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

    The peak's relative error is at most 1e-14, its angle's as a double allows. Raises GenevaError
    where a value is out of its range.
    """
    w, shape = _designs(z, internal, A)
    size, at = acceleration_at_end(library(w.l), w)
    _compete(w, size, at, ACCELERATION, may_pass_the_jump(w))
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
    _compete(w, size, at, VELOCITY, may_peak_aside(w))
    at /= -DEGREE
    return size.reshape(shape), (at + 0.0).reshape(shape)


def _designs(
    z: Number | Whole, internal: Truth | Sequence[bool], A: Number
) -> tuple[Wheel[Array], tuple[int, ...]]:
    import numpy as np

    slots, inside, offset = np.atleast_1d(z), np.asarray(internal), np.asarray(A, dtype=float)
    _refuse(
        bool(((slots >= 3) & (slots <= Z_MAX) & (slots == np.floor(slots))).all()),
        inside.dtype == bool,
        bool((np.abs(offset) < 1.0).all()),
    )
    numbers = np.broadcast_arrays(*_gearings(slots, np.where(inside, -1.0, 1.0)), offset)
    return wheel_of(*(number.ravel() for number in numbers)), numbers[0].shape


def _refuse(z: bool, gearing: bool, A: bool) -> None:
    if not z:
        raise GenevaError(f"z must be whole numbers from 3 to {Z_MAX}")
    if not gearing:
        raise GenevaError("the gearing must be external or internal (internal: true or false)")
    if not A:
        raise GenevaError("A must be above -1 and below 1")


def _gearings(z: Array, sign: Array) -> tuple[Array, ...]:
    """Sign, l, 1 - l, cos b and half the motion of plain wheels."""
    import numpy as np

    b = np.pi / z
    l, cos_b = np.sin(b), np.cos(b)
    rest = 1.0 - l
    small = np.nonzero(z < EXACT_Z)
    l[small], cos_b[small], rest[small] = _exact()[z[small].astype(int) - 3].T
    return sign, l, rest, cos_b, 0.5 * np.pi - sign * b


@cache
def _exact() -> Array:
    """sin b, cos b and 1 - sin b of few slots, from three on."""
    import numpy as np

    few = range(3, EXACT_Z)
    return read_only(np.array([(*sin_cos_pi(1, z), one_minus_sin_pi(1, z)) for z in few]))


# of the crank angle f
OfAngle: TypeAlias = "Callable[[Library, Wheel[Array], Array], tuple[Array, Array]]"


class PeakSearch(NamedTuple):
    """A quantity: what is zero where it may be greatest, that with its slope, and its value."""

    zero: Callable[[Library, Wheel[Array], Array], Array]  # of cos f
    slopes: OfAngle
    value: OfAngle  # size and input angle
    close: float = CLOSE  # h may be all but flat where it is zero


ACCELERATION = PeakSearch(acceleration_slope_sign, acceleration_slopes, acceleration)
VELOCITY = PeakSearch(velocity_fall, velocity_fall_slope, velocity, 1e-11)


class Brackets(NamedTuple):
    """Where a search's function rises through zero: designs, the places beside it, a guess."""

    which: Whole
    low: Array
    guess: Array
    high: Array


def _compete(w: Wheel[Array], size: Array, at: Array, search: PeakSearch, where: Truth) -> None:
    """Puts greater sizes, with their places, where ``size`` and ``at`` have less.

    Designs, of those ``where``, go through in blocks; the few that Newton is not soon done with
    wait for each other.
    """
    import numpy as np

    which, late = np.flatnonzero(where), []
    for first in range(0, len(which), BLOCK):
        block = which[first : first + BLOCK]
        part, best = _take(w, block), (size[block], at[block])
        left = _refined(part, best, search, _scanned(part, search), SOON)
        size[block], at[block] = best
        late.append(left._replace(which=block[left.which]))
    if late:
        joined = Brackets(*(np.concatenate(parts) for parts in zip(*late, strict=True)))
        _refined(w, (size, at), search, joined, STEPS)


def _scanned(w: Wheel[Array], search: PeakSearch) -> Brackets:
    """The rises through zero between the places of a scan."""
    import numpy as np

    step = w.half / SCAN
    c, c_next = np.ones(len(step)), np.cos(step)
    turn = 2.0 * c_next
    last = before = np.zeros(len(step))
    brackets = []
    for i in range(SCAN + 1):
        here = search.zero(library(w.l), w, c if i < SCAN else w.end[1])
        which = np.flatnonzero((before < 0.0) & (here >= 0.0))
        left, right, near = before[which], here[which], step[which]
        # a straight line through the first two, a parabola through three
        share = _crossing(last[which] if i > 1 else 2.0 * left - right, left, right)
        low = (i - 1.0) * near
        brackets.append((which, low, low + share * near, low + near))
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
    w: Wheel[Array], best: tuple[Array, Array], search: PeakSearch, found: Brackets, steps: int
) -> Brackets:
    """Newton in each bracket, so many steps; what it found is put in ``best``, the rest returned.

    Those that have converged drop out. It is not ``roots_many``'s, with which these peaks took a
    fifth more time: here a step costs little beside the brackets' book-keeping.
    """
    import numpy as np

    some = _take(w, found.which)
    _, a, x, b = found
    out, live, part = np.full(len(x), np.nan), np.arange(len(x)), some
    for _ in range(steps):
        slope, bend = search.slopes(library(part.l), part, x)
        left = slope < 0.0
        a, b = np.where(left, x, a), np.where(left, b, x)
        with np.errstate(divide="ignore", invalid="ignore"):
            new = x - slope / bend
        new = np.where((new > a) & (new < b), new, 0.5 * (a + b))
        apart = np.abs(new - x) >= search.close
        out[live] = np.where(apart, np.nan, new)
        far = np.flatnonzero(apart)
        if len(far) < len(live):
            part, a, b, live = _take(part, far), a[far], b[far], live[far]
        x = new[far]
        if not len(far):
            break
    size, at = best
    value, where = search.value(library(some.l), some, out)
    more = np.flatnonzero(value > size[found.which])
    # A design may have several roots: the greatest is written last.
    order = more[np.argsort(value[more])]
    size[found.which[order]], at[found.which[order]] = value[order], where[order]
    return Brackets(found.which[live], a, x, b)
