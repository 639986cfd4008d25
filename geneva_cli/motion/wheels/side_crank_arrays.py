"""Peak velocity and acceleration of batches of plain wheels behind side-cranks.

The general search takes six times as long. With f = atan2(sin phi, A + cos phi) the crank's angle,
C = sqrt(1 - A² sin² f) and rho = C + A cos f, its derivatives by the input are f1 = C / rho and
f2 = A (1-A²) sin f / rho³. With c = cos f, g = 1 outside and -1 inside, and D = 1 - 2 g l c + l²,
the acceleration is

    - l sin f h / (D² rho³),    h = (1-l²) C² rho - (c - g l) D A (1-A²)

and the velocity falls with f > 0 where h > 0: everywhere outside, and inside for A <= 0. It is then
greatest at mid-motion, and the acceleration at an end or where its slope rises through zero. Inside
and for A >= 0 the acceleration is greatest in its jump at the ends (a test has a grid of it), and
the velocity is left to the general search.
"""

from typing import NamedTuple

import numpy as np

from geneva_cli.motion.engagement import Peak
from geneva_cli.motion.path_and_slot import AnchoredPath, StraightSlotMotion
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Number, parameter, record_taken

SCAN = 10  # intervals over half the motion; 8 miss none of a million designs, 6 miss twelve


class SideCrankMotion(StraightSlotMotion):
    """Motion of a straight radial slot behind a side-crank, with peaks of batches."""

    def __init__(
        self, path: AnchoredPath, half_step: float, A: float, form: tuple[float, float, float]
    ) -> None:
        super().__init__(path, half_step)
        self.A, self.form = A, form  # as ``closed`` of a plain crank

    def closed_peak(self, quantity: str) -> Peak[float] | None:
        sign, l, rest = self.form
        batch = not (isinstance(self.A, float) and isinstance(l, float))
        if not batch or quantity not in ("velocity", "acceleration"):
            return None
        w = wheels(sign, l, rest, self.A)
        peaks = velocity_peaks(w) if quantity == "velocity" else acceleration_peaks(w)
        # nearer to 1 the search for arrays may miss a peak
        sure = abs(w.A) <= 0.999
        return Peak(*(parameter(np.where(sure, v, np.nan)[:, None]) for v in peaks))


class SideCrankWheels(NamedTuple):
    """Plain wheels behind side-cranks, (n,) each."""

    sign: Array  # +1 external, -1 internal
    A: Array
    l: Array  # sin(pi/z)
    rest: Array  # 1 - l
    minus: Array  # 1 - A²
    square: Array  # 1 - l²


def wheels(sign: Number, l: Number, rest: Number, A: Number) -> SideCrankWheels:
    """Wheels of R/L = l and ``rest`` = 1 - l, external (sign 1) or internal (-1): (n,) each."""
    every = sign, A, l, rest, (1.0 - A) * (1.0 + A), rest * (1.0 + l)
    return SideCrankWheels._make(v.ravel() for v in np.broadcast_arrays(*every))


def velocity_peaks(w: SideCrankWheels) -> tuple[Array, Array]:
    """Peak velocity (invariant), at mid-motion: (n,); NaN inside for A > 0."""
    size = w.l / (np.where(w.sign > 0.0, w.rest, 1.0 + w.l) * (1.0 + w.A))
    return np.where((w.sign > 0.0) | (w.A <= 0.0), size, np.nan), np.zeros(len(size))


def acceleration_peaks(w: SideCrankWheels) -> tuple[Array, Array]:
    """Peak |acceleration| (invariant) and the input angle of its first occurrence, degrees: (n,).

    To a relative error of 4e-15 for |A| <= 0.999; NaN where a search did not converge.
    """
    best = acceleration_at_end(w)
    which = np.flatnonzero((w.sign > 0.0) | (w.A < 0.0))
    count = 16384  # designs in a block: more leave the processor's cache, fewer need more calls
    for block in (which[i : i + count] for i in range(0, len(which), count)):
        part = record_taken(w, block)
        with np.errstate(all="ignore"):
            sine, cosine = _end(part)
            f = np.linspace(0.0, np.arctan2(sine, cosine), SCAN + 1)
            c = np.cos(f)
            c[-1] = cosine
            slopes = _slope(part, c)
            i, design = np.nonzero((slopes[:-1] < 0.0) & (slopes[1:] >= 0.0))
            near, of = record_taken(part, design), block[design]
            low, high, left = f[i, design], f[i + 1, design], slopes[i, design]
            rise = slopes[i + 1, design] - left
            # a parabola through three values; a straight line in the first interval
            bend = np.where(i > 0, 0.5 * (rise - left + slopes[i - 1, design]), 0.0)
            root = np.sqrt(np.maximum((rise - bend) ** 2 - 4.0 * bend * left, 0.0))
            x = low - 2.0 * left / (rise - bend + root) * (high - low)
            slope = root / (high - low)
            before = here = np.zeros(len(x))
            close = np.zeros(len(x), bool)
            for step in range(4):  # secant steps, from a parabola's root
                last, here = here, _slope(near, np.cos(x))
                if step:  # rounding may leave a step of 0, or one against the rise
                    secant = (here - last) / (x - before)
                    slope = np.where(secant > 0.0, secant, slope)
                # a design that is close stays, so that it has the same peak in every batch
                before, x = x, np.where(close, x, x - here / slope)
                # radians: the error after so short a step moves a peak by less than rounding
                close = abs(x - before) < 1e-7
                if close.all():
                    break
            size, at = acceleration(near, x)
            size = np.where(close & (low <= x) & (x <= high), size, np.nan)
        new = np.flatnonzero(~(size <= best[0][of]))
        # a design may have several: the greatest, or what is not known, is written last
        if np.bincount(design).max(initial=0) > 1:
            new = new[np.argsort(size[new])]
        for values, own in zip(best, (size, at), strict=True):
            values[of[new]] = own[new]
    return best[0], best[1] / -DEGREE


def acceleration(w: SideCrankWheels, f: Array) -> tuple[Array, Array]:
    """Size of the acceleration at crank angles f, and the input angles there, radians."""
    sine, cosine = np.sin(0.5 * f), np.cos(0.5 * f)
    s, c = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    near = np.where(w.sign > 0.0, sine, cosine)
    v = 2.0 * near * near  # 1 - g cos f
    C, rho = _front(w, s, c)
    D, f1 = w.rest * w.rest + 2.0 * w.l * v, C / rho
    # l sin f is common to both terms
    wheel = w.square * (f1 / D) * (f1 / D)
    front = w.sign * (w.rest - v) / D * (w.A * w.minus / rho) / (rho * rho)
    return w.l * s * abs(wheel - front), np.arctan2(rho * s, C * c - w.A * (s * s))


def acceleration_at_end(w: SideCrankWheels) -> tuple[Array, Array]:
    """Jump of the acceleration at entry and exit, tan(b) f1², and the input angle, radians."""
    s, c = _end(w)
    C, rho = _front(w, s, c)
    f1 = C / rho
    return w.l / s * f1 * f1, np.arctan2(rho * s, C * c - w.A * (s * s))


def _end(w: SideCrankWheels) -> tuple[Array, Array]:
    """Sine and cosine of the crank's angle at the end of a motion, cos(pi/z) and +-l, exactly."""
    return np.sqrt(w.square), w.sign * w.l


def _front(w: SideCrankWheels, s: Array, c: Array) -> tuple[Array, Array]:
    """C and rho, where the crank's sine and cosine are s and c."""
    C, Ac = np.sqrt(c * c + w.minus * (s * s)), w.A * c
    long = C + abs(Ac)
    return C, np.where(Ac < 0.0, w.minus / long, long)


def _slope(w: SideCrankWheels, c: Array) -> Array:
    """The acceleration's slope over f, times (C D)³ / (f1² l (1-l²)) > 0."""
    Ac, c2 = w.A * c, c * c
    s2, C2 = 1.0 - c2, w.minus + Ac * Ac
    C, v = np.sqrt(C2), 1.0 - w.sign * c
    lv = 2.0 * w.l * v
    square = w.rest * w.rest
    D = square + lv
    N = v * (1.0 + w.l * (4.0 + w.l) - lv) - square
    g1 = w.sign * (w.rest - v) / w.square
    front = w.A * (C - Ac) * D  # f2 / (f1² sin f), times C² D; (1-A²) / rho is C - A cos f
    return w.sign * N * C * C2 - front * (3.0 * s2 * C - D * g1 * (c * C + 3.0 * w.A * s2))
