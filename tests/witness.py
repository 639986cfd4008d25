"""Reference values of 50 digits, from the geometry and by other formulas than the program's.

The program carries Taylor coefficients through half-angle forms about an anchor. Here the pin is
a complex number, the wheel's angle is its argument, and derivatives come from the logarithm in
closed form, chained by Faà di Bruno. Nothing in this file imports the program.
"""

import mpmath
import numpy as np
import pytest

mp = mpmath.mp.clone()  # a context of our own: nobody else's precision changes it
mp.dps = 50

SIGN = {"external": 1, "internal": -1}
# each quantity and its derivative, from the derivatives 0..4 of the wheel's angle
QUANTITIES = {
    "position": lambda p: (p[0], p[1]),
    "velocity": lambda p: (p[1], p[2]),
    "acceleration": lambda p: (p[2], p[3]),
    "jerk": lambda p: (p[3], p[4]),
    "power": lambda p: (p[1] * p[2], p[2] ** 2 + p[1] * p[3]),
}


def near(expected, rel):
    """Equal within a relative error, however small the number: pytest allows 1e-12 beside it."""
    return pytest.approx(expected, rel=rel, abs=0.0)


def to_radians(deg):
    """Exact degrees (any double is) to radians."""
    return mp.mpf(float(deg)) * mp.pi / 180


def to_degrees(rad):
    return rad * 180 / mp.pi


def doubled(exact):
    """Numbers of many digits as two arrays of doubles whose sum they are to 32 digits.

    The error of a double is then ``(double - high) - low``, to 1e-16 of itself: the first
    difference is exact wherever the two are near.
    """
    high = np.array([float(e) for e in exact])
    low = np.array([float(e - h) for e, h in zip(exact, high.tolist(), strict=True)])
    return high, low


def taylor(f, x, order):
    """f and its derivatives at x by numerical differentiation, with digits to spare."""
    with mp.workdps(100):
        return [c * mp.factorial(k) for k, c in enumerate(mp.taylor(f, mp.mpf(x), order))]


def chain(g, f):
    """Derivatives of g(f(x)) up to the fifth, from those of g by f and of f by x (Faà di Bruno)."""
    (g0, g1, g2, g3, g4, g5), (_, a, b, c, d, e) = (
        [*rates, *[mp.mpf(0)] * (6 - len(rates))] for rates in (g, f)
    )
    every = (
        g0,
        g1 * a,
        g2 * a**2 + g1 * b,
        g3 * a**3 + 3 * g2 * a * b + g1 * c,
        g4 * a**4 + 6 * g3 * a**2 * b + g2 * (4 * a * c + 3 * b**2) + g1 * d,
        g5 * a**5
        + 10 * g4 * a**3 * b
        + g3 * (10 * a**2 * c + 15 * a * b**2)
        + g2 * (5 * a * d + 10 * b * c)
        + g1 * e,
    )
    return every[: len(g)]


def coulisse_derivatives(E, A):
    """d/dx .. d4/dx4 of arg(A + E) with E = e^ix: log's derivative is i w, w = E/(A + E)."""
    w = E / (A + E)
    w1 = 1j * w * (1 - w)
    w2 = 1j * w1 * (1 - 2 * w)
    w3 = 1j * (w2 * (1 - 2 * w) - 2 * w1 * w1)
    return tuple(v.real for v in (w, w1, w2, w3))


def wheel_derivatives(C, g):
    """d/df .. d4/df4 of arg(1 - C), C = g l e^(-igf): log's derivative is i g v, v = C/(1 - C)."""
    v = C / (1 - C)
    v1 = -1j * g * v * (1 + v)
    v2 = -1j * g * v1 * (1 + 2 * v)
    v3 = -1j * g * (v2 * (1 + 2 * v) + 2 * v1 * v1)
    return tuple(g * u.real for u in (v, v1, v2, v3))


class Geneva:
    """A wheel with straight radial slots behind a side-crank drive (A = 0: a plain crank)."""

    def __init__(self, z, gearing="external", A=0.0):
        self.g, self.A = SIGN[gearing], mp.mpf(A)
        self.b = mp.pi / z
        self.l = mp.sin(self.b)
        self.half_crank = mp.pi / 2 - self.g * self.b
        # input angle from entry to mid-motion: the triangle of base, input crank and coulisse
        self.half_motion = self.half_crank + mp.asin(self.A * mp.sin(self.half_crank))

    def at(self, x):
        """Wheel angle and its derivatives 1..4 by the input angle, at x radians from mid-motion."""
        E = mp.expj(x)
        f = (mp.arg(self.A + E), *coulisse_derivatives(E, self.A))
        C = self.g * self.l * mp.expj(-self.g * f[0])
        return chain((mp.arg(1 - C), *wheel_derivatives(C, self.g)), f)

    def derivatives(self, deg):
        """The derivatives at a double in degrees, taken as exact."""
        return self.at(to_radians(deg))

    def rough(self, deg):
        """The derivatives in double precision on an array, to search peaks; not a reference."""
        E = np.exp(1j * np.radians(deg))
        A, l, g = float(self.A), float(self.l), self.g
        f = (np.angle(A + E), *coulisse_derivatives(E, A))
        C = g * l * np.exp(-1j * g * f[0])
        return chain((np.angle(1 - C), *wheel_derivatives(C, g)), f)

    def angles(self, count):
        """Input angles in degrees over the first half: ``count`` even in it, and in the crank.

        With A near 1 the crank of an internal wheel runs away near both ends, and all that happens
        there happens within a degree of the input; even in the crank's angle it is seen.
        """
        crank = -np.linspace(0.0, float(self.half_crank), count)
        even = -np.linspace(0.0, float(self.half_motion), count)
        return np.degrees(np.concatenate([even, crank + np.arcsin(float(self.A) * np.sin(crank))]))

    def peak(self, quantity):
        """The greatest size in the motion and the first input angle (degrees) where it occurs."""
        pick = QUANTITIES[quantity]
        deg = np.unique(self.angles(1000))
        with np.errstate(all="ignore"):
            value, slope = pick(self.rough(deg))
        size = np.abs(value)
        ends = [-self.half_motion, mp.mpf(0)]
        # stationary points worth a second look: none whose neighbours stay 1 % below the greatest
        places = [
            mp.findroot(
                lambda x: pick(self.at(x))[1],
                (to_radians(deg[i]), to_radians(deg[i + 1])),
                solver="illinois",
                tol=mp.mpf(10) ** -45,  # some of the 50 digits are rounding
                maxsteps=60,
                verify=False,  # of a bracketed root, the size of the function says nothing
            )
            for i in np.flatnonzero(slope[:-1] * slope[1:] < 0.0)
            if max(size[i], size[i + 1]) > 0.99 * size.max()
        ]
        sizes = [(abs(pick(self.at(x))[0]), x) for x in [ends[0], *places, ends[1]]]
        best = max(s for s, _ in sizes)
        at = min(x for s, x in sizes if s > best * (1 - mp.mpf(10) ** -30))
        return best, to_degrees(at)


class SineLaw:
    """A law whose acceleration is made of sines: pieces (end, [(amplitude, rate, phase), ...]).

    Integrated piece by piece from rest, then scaled so that the whole step is 1. A rate of 0
    stands for a constant, amplitude * sin(phase).
    """

    def __init__(self, *pieces):
        self.pieces = []
        start, v, s = mp.mpf(0), mp.mpf(0), mp.mpf(0)
        for end, terms in pieces:
            end = mp.mpf(end)
            self.pieces.append((start, end, v, s, terms))
            s, v = self._inside(self.pieces[-1], end, 2)[:2]
            start = end
        self.whole, self.rest = s, v

    @staticmethod
    def _inside(piece, u, order):
        start, _, v, s, terms = piece
        t = u - start
        out = [s + v * t, v] + [mp.mpf(0)] * (order - 1)
        for a, w, p in terms:
            if w:
                q = w * start + p
                out[0] += a / w * (mp.cos(q) * t - (mp.sin(w * u + p) - mp.sin(q)) / w)
                out[1] += a / w * (mp.cos(q) - mp.cos(w * u + p))
            else:
                out[0] += a * mp.sin(p) * t**2 / 2
                out[1] += a * mp.sin(p) * t
            for k in range(2, order + 1):
                out[k] += a * w ** (k - 2) * mp.sin(w * u + p + (k - 2) * mp.pi / 2)
        return out

    def __call__(self, u, order=4):
        """s and its derivatives at u; at a joint, from the left."""
        u = mp.mpf(u)
        piece = next(p for p in self.pieces if u <= p[1])
        return [x / self.whole for x in self._inside(piece, u, order)]


class PolynomialLaw:
    """A law given as the coefficients of u^0, u^1, ..."""

    def __init__(self, *coefficients):
        self.c = coefficients

    def __call__(self, u, order=4):
        u = mp.mpf(u)
        return [
            mp.fsum(mp.ff(n, k) * c * u ** (n - k) for n, c in enumerate(self.c) if n >= k)
            for k in range(order + 1)
        ]


def krasniqi(shape):
    """Krasniqi's series (18), corrected: five sines of x = pi u."""
    s = mp.mpf(shape)
    amplitudes = (2 * s, 2, -9 * s, -1, 5 * s)
    return SineLaw((1, [(a, (k + 1) * mp.pi, 0) for k, a in enumerate(amplitudes)]))


_PI = mp.pi
# Accelerations as VDI 2143 and the cam textbooks (Norton, Rothbart) draw them.
LAWS = {
    "harmonic": SineLaw((1, [(1, _PI, _PI / 2)])),
    "cycloidal": SineLaw((1, [(1, 2 * _PI, 0)])),
    "modified-sine": SineLaw(
        (0.125, [(1, 4 * _PI, 0)]), (0.875, [(1, 4 * _PI / 3, _PI / 3)]), (1, [(1, 4 * _PI, 0)])
    ),
    "modified-trapezoid": SineLaw(
        (0.125, [(1, 4 * _PI, 0)]),
        (0.375, [(1, 0, _PI / 2)]),
        (0.625, [(1, 4 * _PI, -_PI)]),
        (0.875, [(-1, 0, _PI / 2)]),
        (1, [(1, 4 * _PI, 0)]),
    ),
    "mcv50": SineLaw(
        (0.0625, [(1, 8 * _PI, 0)]),
        (0.25, [(1, 8 * _PI / 3, _PI / 3)]),
        (0.75, [(0, 0, 0)]),
        (0.9375, [(1, 8 * _PI / 3, -_PI)]),
        (1, [(1, 8 * _PI, 0)]),
    ),
    "3-4-5": PolynomialLaw(0, 0, 0, 10, -15, 6),
    "4-5-6-7": PolynomialLaw(0, 0, 0, 0, 35, -84, 70, -20),
    "sine-group": krasniqi(0),
}
