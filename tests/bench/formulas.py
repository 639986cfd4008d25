"""The motion in closed form as scripts write it, with ``math``, NumPy or Numba: rivals of ours.

Side-cranks have their stable form, so that a method is not blamed for its formula; ``textbook`` is
what handbooks print for a plain crank. The functions of machines take the varied value of
``kinds.KINDS``, or its ``place``, and input angles (k,) in radians from mid-motion, and return
velocity and acceleration. Sources: the geometry of each machine, without the program.
"""

import math
from typing import Any, NamedTuple

import numpy as np

try:
    import numba
except ImportError:
    numba = None

jit = numba.njit if numba else lambda function: function
SIXTH, QUARTER = np.pi / 6.0, np.pi / 4.0  # half the step of wheels of six and of four slots


@jit
def _turning(x, y, x1, y1, x2, y2):
    """Rate of the direction of (x, y) and its slope, from two derivatives."""
    square = x * x + y * y
    rate = (x * y1 - y * x1) / square
    return rate, (x * y2 - y * x2 - 2.0 * rate * (x * x1 + y * y1)) / square


@jit
def _driven(l, f, f1, f2):
    """Velocity and acceleration of a wheel, l = sin b, whose crank is at f with two derivatives."""
    sine, cosine = np.sin(f), np.cos(f)
    below = 1.0 - 2.0 * l * cosine + l * l
    g1 = l * (cosine - l) / below
    g2 = -l * (1.0 - l * l) * sine / (below * below)
    return g1 * f1, g2 * f1 * f1 + g1 * f2


class Proportions(NamedTuple):
    """Sign of the gearing, l = R/L, A, and half the motion in radians; numbers or arrays."""

    sign: Any
    l: Any
    A: Any
    half: Any

    @classmethod
    def of(cls, sign, z, A, m=math):
        """Proportions of one design by ``math``, or of a batch by NumPy."""
        b = m.pi / z
        crank = 0.5 * m.pi - sign * b
        return cls(sign, m.sin(b), A, crank + m.asin(A * m.sin(crank)))

    def blocks(self, method):
        """Results of a method for batches, in blocks of designs that stay in the cache."""
        every, size = np.broadcast_arrays(*self), 4096
        starts = range(0, len(every[0]), size)
        return np.concatenate(
            [method(Proportions(*[v[i : i + size] for v in every])) for i in starts]
        )


def _parts(m, d, x, order):
    sine, cosine = m.sin(x), m.cos(x)
    half = m.sin(0.5 * x)
    W = (1.0 + d.A) ** 2 - 4.0 * d.A * half * half
    K = d.A * (1.0 - d.A * d.A)
    f = m.atan2(sine, d.A + cosine)
    f1 = 0.5 * (1.0 + (1.0 - d.A * d.A) / W)
    f2 = K * sine / (W * W)
    # internal is external with -l, seen from the other side
    l, sin_f, half_f = d.sign * d.l, m.sin(f), m.sin(0.5 * f)
    v = 2.0 * half_f * half_f
    D = (1.0 - l) ** 2 + 2.0 * l * v
    g1 = l * ((1.0 - l) - v) / D
    k = l * (1.0 - l) * (1.0 + l)
    g2 = -k * sin_f / (D * D)
    if order == 2:
        return f1, f2, g1, g2
    g3 = k * (v * (1.0 + 4.0 * l + l * l - 2.0 * l * v) - (1.0 - l) ** 2) / (D * D * D)
    f3 = K * ((1.0 + d.A * d.A) * cosine - 2.0 * d.A * cosine * cosine + 4.0 * d.A) / (W * W * W)
    return f1, f2, f3, g1, g2, g3


def rates(m, d, x):
    """Velocity and acceleration at x radians from mid-motion (up to the sign of the gearing)."""
    f1, f2, g1, g2 = _parts(m, d, x, 2)
    return g1 * f1, g2 * f1 * f1 + g1 * f2


def acceleration(m, d, x):
    """Acceleration at x radians from mid-motion (up to the sign of the gearing)."""
    return rates(m, d, x)[1]


def jerk(m, d, x):
    """Slope of the acceleration at x radians from mid-motion."""
    f1, f2, f3, g1, g2, g3 = _parts(m, d, x, 3)
    return g3 * f1 * f1 * f1 + 3.0 * g2 * f1 * f2 + g1 * f3


def textbook(l, x, orders):
    """Derivatives by the formulas of handbooks, over whole arrays; x in radians."""
    sine, cosine = np.sin(x), np.cos(x)
    D = 1.0 - 2.0 * l * cosine + l * l
    out = []
    if 0 in orders:
        out.append(np.arctan2(l * sine, 1.0 - l * cosine))
    if 1 in orders:
        out.append(l * (cosine - l) / D)
    if 2 in orders:
        out.append(-l * (1.0 - l * l) * sine / D**2)
    if 3 in orders:
        top = 4.0 * l - (1.0 + l * l) * cosine - 2.0 * l * cosine * cosine
        out.append(l * (1.0 - l * l) * top / (D * D * D))  # three times as quick as D**3
    return out


def offset_slots(offset_mm, x):
    """Six slots whose axes pass the wheel's at a distance, on a centre distance of 100 mm.

    At entry and exit the slot's axis touches the pin's circle: asin(R - e) + asin(R + e) is the
    step. The pin is at the distance sqrt(u) from the wheel's axis; the slot points asin(e/sqrt(u))
    beside it.
    """
    e = offset_mm / 100.0
    lean = e / np.cos(SIXTH)
    l = np.sin(SIXTH) * np.sqrt(1.0 - lean * lean)
    sine, cosine = np.sin(x), np.cos(x)
    u, u1, u2 = 1.0 + l * l - 2.0 * l * cosine, 2.0 * l * sine, 2.0 * l * cosine
    rate = l * (cosine - l) / u
    slope = -l * (1.0 - l * l) * sine / (u * u)
    q = u - e * e
    root = np.sqrt(q)
    beside = -0.5 * e * u1 / (u * root)
    bent = -0.5 * e * (u2 / (u * root) - u1 * u1 * (q + 0.5 * u) / (u * u * q * root))
    return rate + beside, slope + bent


def spherical(axes_deg, x):
    """Six slots on a sphere whose axis makes an angle with the crank's."""
    axes = np.radians(axes_deg)
    s = np.sin(axes) * np.sin(SIXTH)  # of the crank's half cone, from the right angle at entry
    c = np.sqrt(1.0 - s * s)
    sine, cosine = np.sin(x), np.cos(x)
    near, far = c * np.sin(axes), s * np.cos(axes)
    return _turning(near - far * cosine, s * sine, far * sine, s * cosine, far * cosine, -s * sine)


def elliptical_gears(e, x):
    """Six slots behind equal elliptical gears, in their slow phase."""
    l = np.sin(SIXTH)
    square = 1.0 + e * e + 2.0 * e * np.cos(x)
    f = 2.0 * np.arctan2((1.0 - e) * np.sin(0.5 * x), (1.0 + e) * np.cos(0.5 * x))
    f1 = (1.0 - e * e) / square
    return _driven(l, f, f1, f1 * 2.0 * e * np.sin(x) / square)


def epicyclic(planet_ratio, x):
    """Four slots; the roller sits on a planet that turns five times as fast as its carrier."""
    r = planet_ratio
    R = np.sin(QUARTER) + r
    s, c, s5, c5 = np.sin(x), np.cos(x), np.sin(5.0 * x), np.cos(5.0 * x)
    return _turning(
        1.0 - R * c - r * c5,
        R * s + r * s5,
        R * s + 5.0 * r * s5,
        R * c + 5.0 * r * c5,
        R * c + 25.0 * r * c5,
        -R * s - 25.0 * r * s5,
    )


def modified_sine(alpha0_deg, x):
    """Six curved slots for a modified sine."""
    motion = np.pi - 2.0 * SIXTH - np.radians(alpha0_deg)
    u = 0.5 + x / motion
    w = np.minimum(u, 1.0 - u)
    quick, slow = 4.0 * np.pi * w, (np.pi + 4.0 * np.pi * w) / 3.0
    ends = w < 0.125
    velocity = np.where(ends, 1.0 - np.cos(quick), 1.0 - 3.0 * np.cos(slow))
    acceleration = np.where(ends, np.sin(quick), np.sin(slow)) * np.where(u < 0.5, 1.0, -1.0)
    size = 2.0 * SIXTH / motion * np.pi / (4.0 + np.pi)
    return size * velocity, size * 4.0 * np.pi / motion * acceleration


def sine_group(tilt, x):
    """Six curved slots for a tilted group of sines."""
    motion = np.pi - 2.0 * SIXTH
    t = np.pi * (0.5 + x / motion)
    s, c = np.sin(t), np.cos(t)
    more, cube = 1.0 - 8.0 * tilt * c, s * s * s
    size = 2.0 * SIXTH / motion * 8.0 / 3.0
    slope = cube * (4.0 * c * more + 8.0 * tilt * s * s)
    return size * cube * s * more, size * np.pi / motion * slope


def geneva_pair(z, x):
    """A wheel whose crank is another wheel of four slots, while that one turns."""
    k, l = np.sin(QUARTER), np.sin(np.pi / z)
    sine, cosine = np.sin(x), np.cos(x)
    below = 1.0 - 2.0 * k * cosine + k * k
    f = np.arctan2(k * sine, 1.0 - k * cosine)
    f1 = k * (cosine - k) / below
    return _driven(l, f, f1, -k * (1.0 - k * k) * sine / (below * below))


def four_bar(place, x):
    """Four slots driven by a coupler point, for the links of ``kinds.KINDS``.

    ``place`` holds the coupler point's angle in degrees, the crank's angle at mid-motion in
    radians, the wheel's axis from the crank's, mm, along the frame and across it, and the wheel's
    sense.
    """
    point_deg, middle, along, across, sense = place
    a, g, b, c = 40.0, 100.0, 90.0, 80.0
    crank = a * np.exp(1j * (middle + x))
    d, d1, d2 = g - crank, -1j * crank, crank  # from the crank's pin to the rocker's pivot
    D = d.real * d.real + d.imag * d.imag
    D1 = 2.0 * (d.real * d1.real + d.imag * d1.imag)
    D2 = 2.0 * (a * a + d.real * d2.real + d.imag * d2.imag)
    high, low = (b + c) * (b + c), (b - c) * (b - c)
    N = np.sqrt((high - D) * (D - low))
    N1 = D1 * (high + low - 2.0 * D) / (2.0 * N)
    N2 = (0.5 * D2 * (high + low - 2.0 * D) - D1 * D1 - N1 * N1) / N
    u = 1.0 / D
    u1 = -D1 * u * u
    u2 = -D2 * u * u - 2.0 * D1 * u * u1
    m, half = (b - c) * (b + c), 0.5 / b  # the coupler's direction is k d
    k = half * (1.0 + m * u + 1j * N * u)
    k1 = half * (m * u1 + 1j * (N1 * u + N * u1))
    k2 = half * (m * u2 + 1j * (N2 * u + 2.0 * N1 * u1 + N * u2))
    w = 60.0 * np.exp(1j * np.radians(point_deg))
    P = crank + w * k * d - (along + 1j * across)
    P1 = 1j * crank + w * (k1 * d + k * d1)
    P2 = -crank + w * (k2 * d + 2.0 * k1 * d1 + k * d2)
    v, a = _turning(P.real, P.imag, P1.real, P1.imag, P2.real, P2.imag)
    return sense * v, sense * a


def linear(z, x):
    """A rack, over the crank's radius."""
    return np.cos(x), -np.sin(x)


def compiled(formula):
    """A formula of this file compiled by Numba; None for others, and where that is missing."""
    if numba is None or getattr(formula, "__module__", "") != __name__:
        return None
    return numba.njit(formula)
