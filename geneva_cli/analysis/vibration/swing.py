"""Integrals of a motion's derivatives against the swing of an oscillator, to the last digits.

The load swings as e^(p u), u the share of the motion's time, with

    p = Omega (-zeta + i sqrt(1 - zeta²)),    Omega = 2 pi lambda,

lambda being the period ratio: the motion's time over the load's natural period. What a motion
leaves of it is an integral of f e^(p (1 - u)) over 0..1, f a derivative of the motion by u. On each
panel f is a Legendre series, and the moments of e^(p (1 - u)) with Legendre's polynomials are
spherical Bessel functions of q = -p h, h half the panel's width: by a power series where q is
small, by Miller's recurrence downwards, and where |q| exceeds the number of terms upwards, where it
is stable and leaves nothing but the panels' ends (Filon's method). No textbook form's 0/0 is there.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.vibration.panels import TERMS
from geneva_cli.analysis.vibration.shape import Shape

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Complex

# Period ratios at a time, so that they stay in the cache; with damping, whose numbers are complex,
# so few that no product of matrices is shared out to threads, which wait longer than they work.
BLOCK, DAMPED = 2048, 1024
SMALL, POWERS = 0.5, 20  # up to this |q| a power series of so many terms
LARGE = float(TERMS)  # above it the recurrence goes upwards
SPLIT = 2.0**26  # half of a double's bits
# moments of Legendre's polynomials with (x - 1)^k / k!, for e^(q (x - 1)): zero for k < n
_MOMENTS = np.array(
    [
        [
            (-1.0) ** (n + k)
            * (2 ** (k + 1) * math.factorial(k))
            / (math.factorial(k - n) * math.factorial(k + n + 1))
            if k >= n
            else 0.0
            for k in range(POWERS)
        ]
        for n in range(TERMS)
    ]
)


class Swing(NamedTuple):
    """Oscillators: arrays of period ratios, and of damping ratios below 1."""

    ratio: Array
    damping: Array

    @property
    def p(self) -> Complex:
        """The complex rate p of each, by the motion's time."""
        zeta = self.damping
        return 2.0 * np.pi * self.ratio * (-zeta + 1j * np.sqrt(1.0 - zeta * zeta))

    def after(self, v: float | Array) -> Complex:
        """e^(p v), its angle reduced before it is rounded; of arrays each for itself."""
        whole = np.floor(self.ratio)
        head = np.floor(v * SPLIT) / SPLIT
        turns = (whole * head) % 1.0 + whole * (v - head) + (self.ratio - whole) * v
        angle = 2.0 * np.pi * (turns - np.round(turns))
        zeta = self.damping
        if not zeta.any():
            return np.cos(angle) + 1j * np.sin(angle)
        # sqrt(1 - zeta²) is by that much below 1
        slower = zeta * zeta / (1.0 + np.sqrt(1.0 - zeta * zeta))
        omega = 2.0 * np.pi * self.ratio
        angle -= omega * slower * v
        return np.exp(-omega * zeta * v) * (np.cos(angle) + 1j * np.sin(angle))


def residual_swing(shape: Shape, swing: Swing) -> Complex:
    """What a motion leaves: a complex number for each oscillator, its size over the step.

    It is (r' - p* r) / Im p at the end of the motion, r being the load's angle less the wheel's
    over the step, and p* the conjugate: r = Im of it. The motion begins without vibration.
    """
    out = np.empty(len(swing.ratio), dtype=complex)
    block = DAMPED if swing.damping.any() else BLOCK
    by_ratio = np.argsort(swing.ratio)
    order = _orders(shape, swing)[by_ratio]
    for k in range(1, len(shape.greatest) + 1):
        at = by_ratio[order == k]
        for start in range(0, len(at), block):
            part = at[start : start + block]
            some = Swing(swing.ratio[part], swing.damping[part])
            p = some.p
            # By parts: a derivative more, where it vanishes at both ends, is worth a factor p.
            out[part] = -_integral(shape, k, some) * p ** (2 - k) / p.imag
    return out


def _orders(shape: Shape, swing: Swing) -> Array:
    """Which derivative, 1 or higher, is best integrated: rounding is a share of its greatest."""
    best = np.ones(len(swing.ratio), dtype=int)
    omega = 2.0 * np.pi * swing.ratio
    for k in range(2, len(shape.greatest) + 1):
        best[omega > shape.greatest[k - 1] / shape.greatest[k - 2]] = k
    return best


def _integral(shape: Shape, order: int, swing: Swing) -> Complex:
    """Integrals of a derivative; the ratios ascend."""
    total = np.zeros(len(swing.ratio), dtype=complex)
    ends: dict[float, Complex] = {}
    p = swing.p

    def after(v: float, part: slice) -> Complex:
        if v not in ends:
            ends[v] = swing.after(v)
        return ends[v][part]

    # Without damping q = -i omega h, and all recurrences are real ones of omega h.
    unit = 1.0 if swing.damping.any() else -1j
    for panels in shape.panels:
        series, h = panels.series[order - 1], panels.half
        size = np.abs(p) * h
        q = -p * h
        reduced = q if unit == 1.0 else size
        low, high = (int(v) for v in np.searchsorted(size, (SMALL, LARGE)))
        for part, moments in ((slice(0, low), by_powers), (slice(low, high), by_recurrence)):
            if part.start < part.stop:
                parts = moments(reduced[part], unit, series, GRID) * h
                for i, right in enumerate(panels.right):
                    total[part] += after(1.0 - right, part) * parts[:, i]
        part = slice(high, len(total))
        if high < len(total):
            first, last = by_ends(reduced[part], unit, series, GRID)
            for i, (a, b) in enumerate(zip(panels.left, panels.right, strict=True)):
                both = after(1.0 - a, part) * first[:, i] + after(1.0 - b, part) * last[:, i]
                total[part] += both / p[part]
    return total


class Pairing(NamedTuple):
    """How numbers of oscillators and of panels go together: each with each, or in pairs."""

    spread: Callable[..., Complex]  # of oscillators, against panels
    sum: Callable[..., Complex]  # (terms, oscillators), (panels, terms) -> sums over terms


def _products(terms: Complex, series: Array) -> Complex:
    """Their matrix product, (oscillators, panels); of complex terms as two real ones, in one."""
    if not np.iscomplexobj(terms):
        out: Complex = terms.T @ series.T
        return out
    both = terms.view(float).T @ series.T
    return both[::2] + 1j * both[1::2]


GRID = Pairing(lambda x: x[:, None], _products)
PAIRS = Pairing(lambda x: x, lambda a, b: np.einsum("tp,pt->p", a, b))


def by_powers(reduced: Array | Complex, unit: complex, series: Array, by: Pairing) -> Complex:
    """Integrals of f e^(q (x - 1)), q the oscillators' and f the panels', by powers of q."""
    q = by.spread(reduced * unit)
    total: Complex = q * 0.0 * series[:, 0]
    for c in (series @ _MOMENTS).T[::-1]:
        total *= q
        total += c
    return total


def by_recurrence(reduced: Array | Complex, unit: complex, series: Array, by: Pairing) -> Complex:
    """The same by modified spherical Bessel functions i_n(q) = unit^n y_n, scaled by their sum.

    q = unit times ``reduced``; the sum of (2 n + 1) i_n(q) is e^q.
    """
    start = TERMS + 12 + int(1.2 * np.abs(reduced).max())
    square = (unit * unit).real
    rate = 1.0 / reduced
    above, here = np.zeros_like(rate), np.full_like(rate, 1e-250)
    sums = np.zeros((2, *rate.shape), dtype=rate.dtype)
    kept = np.empty((TERMS, len(rate)), dtype=rate.dtype)
    for n in reversed(range(start)):
        term = (2.0 * n + 1.0) * here
        if n % 4 < 2 or square > 0.0:  # unit^n over 1 or unit
            sums[n % 2] += term
        else:
            sums[n % 2] -= term
        if n < TERMS:
            kept[n] = here
        term *= rate
        term += square * above  # i_(n-1) = i_(n+1) + (2 n + 1) i_n / q
        above, here = here, term
    scaled = 2.0 * series * square ** (np.arange(TERMS) // 2)
    even, odd = by.sum(kept[::2], scaled[:, ::2]), by.sum(kept[1::2], scaled[:, 1::2])
    found: Complex = (even + unit * odd) / by.spread(sums[0] + unit * sums[1])
    return found


def by_ends(
    reduced: Array | Complex, unit: complex, series: Array, by: Pairing
) -> tuple[Complex, Complex]:
    """What the panels' left and right ends add, times p.

    The moments with Legendre's polynomials are m_(n+1) = m_(n-1) - (2 n + 1) m_n / q, from those of
    the ends alone; ``even`` and ``odd`` are their parts in 1/q, odd over ``unit``.
    """
    square = (unit * unit).real
    y = -1.0 / reduced * square
    even, odd = np.ones_like(y), np.zeros_like(y)
    before = -np.ones_like(y), np.zeros_like(y)
    kept = np.empty((2, TERMS, len(y)), dtype=y.dtype)
    for n in range(TERMS):
        kept[0, n], kept[1, n] = even, odd
        step = (2.0 * n + 1.0) * y
        following = before[0] + square * step * odd, before[1] + step * even
        before = even, odd
        even, odd = following
    turned = series * -((-1.0) ** np.arange(TERMS))
    first = by.sum(kept[0], series) + unit * by.sum(kept[1], series)
    last = by.sum(kept[0], turned) - unit * by.sum(kept[1], turned)
    return first, last
