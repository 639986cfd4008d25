"""Angles and speeds: degrees for people, radians for formulas, and exact fractions of pi."""

import math
from collections.abc import Callable, Sequence
from functools import lru_cache

from geneva_cli.numerics.arrays import SINGLE, Array, Enclosed, N, parameter

DEGREE = math.pi / 180.0
_ONE = 1 << 128  # 1 in numbers of 128 binary places


def sin_cos_pi(p: int, q: int) -> tuple[float, float]:
    """sin(pi p/q) and cos(pi p/q) of whole numbers, correctly rounded; sin(pi/6) is 0.5.

    ``math.sin(math.pi / q)`` takes a rounded argument. For a wheel of three slots, its error grows
    twelvefold on the way to the peak acceleration. Here the argument is an exact fraction, reduced
    to an eighth of a turn, and both series are summed in integers of 128 bits.

    In arrays (of designs) each distinct fraction is computed once. If p is not a whole number, such
    as an angle in degrees with q = 180, arrays are within 2 units in the last place.
    """
    if isinstance(p, int) and isinstance(q, int):
        s, c = scaled_sin_cos(p, q)
        return s / _ONE, c / _ONE
    if not (isinstance(p, int) or p.dtype.kind == "i"):
        return _sin_cos_degrees(180.0 / q * p)
    sine, cosine = of_each(sin_cos_pi, p, q)
    return sine, cosine


def one_minus_sin_pi(p: int, q: int) -> float:
    """1 - sin(pi p/q), correctly rounded even near 0."""
    if isinstance(p, int) and isinstance(q, int):
        return (_ONE - scaled_sin_cos(p, q)[0]) / _ONE
    if not (isinstance(p, int) or p.dtype.kind == "i"):
        return 2.0 * _sin_cos_degrees(45.0 - 90.0 / q * p)[0] ** 2
    return of_each(lambda p, q: (one_minus_sin_pi(p, q),), p, q)[0]


def of_each(f: Callable[..., tuple[float, ...]], *numbers: float) -> list[float]:
    """Apply a function of Python numbers to numbers or arrays, once for each distinct set of them.

    ``f`` returns a tuple; the result has one number or array for each of its members.
    """
    if all(isinstance(x, SINGLE) for x in numbers):
        return [*f(*numbers)]
    import numpy as np

    arrays = np.broadcast_arrays(*numbers)
    sets = list(zip(*(x.ravel().tolist() for x in arrays), strict=True))
    known = {one: f(*one) for one in dict.fromkeys(sets)}
    columns = zip(*(known[one] for one in sets), strict=True)
    return [parameter(np.reshape(column, arrays[0].shape)) for column in columns]


def _sin_cos_degrees(degrees: Array) -> tuple[Array, Array]:
    """Sine and cosine of angles in degrees, which are reduced exactly to 45 at most."""
    import numpy as np

    quarters = np.rint(degrees / 90.0)
    x = (degrees - 90.0 * quarters) * DEGREE
    s, c = np.sin(x), np.cos(x)
    odd, past = quarters % 2.0 == 1.0, quarters % 4.0
    sine, cosine = np.where(odd, c, s), np.where(odd, s, c)
    behind = (past == 1.0) | (past == 2.0)
    return np.where(past >= 2.0, -sine, sine), np.where(behind, -cosine, cosine)


@lru_cache(4096)
def scaled_sin_cos(p: int, q: int) -> tuple[int, int]:
    """sin(pi p/q) and cos(pi p/q) times 2**128, each to its last digits."""
    quarter = (4 * p + q) // (2 * q)  # nearest number of quarter turns
    pi = 1069028584064966747859680373161870783300  # pi * 2**128, rounded down (OEIS A000796)
    x = pi * (2 * p - quarter * q) // (2 * q)
    sums = [_ONE, x]  # cosine, sine
    term, k = x, 1
    while term:
        k += 1
        term = term * x // (_ONE * k)
        if term == -1:  # floor division never reaches 0 from below
            break
        sums[k % 2] += -term if k % 4 > 1 else term
    c, s = sums
    return ((s, c), (c, -s), (-s, -c), (-c, s))[quarter % 4]


def sin_cos_deg(degrees: float) -> tuple[float, float]:
    """Sine and cosine of an angle in degrees, correctly rounded for a double."""
    if isinstance(degrees, float):
        p, q = degrees.as_integer_ratio()
        return sin_cos_pi(p, 180 * q)
    return _sin_cos_degrees(degrees)


def radians(degrees: N) -> N:
    """Degrees to radians, for numbers and arrays alike."""
    if isinstance(degrees, Enclosed):
        return degrees * (degrees.library.pi / 180.0)
    return degrees * DEGREE


def omega(n_rpm: float) -> float:
    """Angular velocity in rad/s from revolutions per minute."""
    return n_rpm * math.pi / 30.0


def distinct(places: Sequence[float], least: float) -> list[float]:
    """Return ascending places without those within ``least`` of another; both ends stay."""
    first, *inner, last = places
    out = [first]
    for at in inner:
        if at - out[-1] > least and last - at > least:
            out.append(at)
    return [*out, last]
