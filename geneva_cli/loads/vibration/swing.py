"""Integrals of a motion's derivatives against the vibration of an oscillator, to the last digits.

The load vibrates as e^(p u), with u the fraction of the motion's time and

    p = Omega (-zeta + i sqrt(1 - zeta²)),    Omega = 2 pi lambda.

lambda is the period ratio: the motion's time over the load's natural period. The residual of a
motion is an integral of f e^(p (1 - u)) over 0..1, where f is a derivative of the motion by u. On
each panel f is a Legendre series. The moments of e^(p (1 - u)) with Legendre's polynomials are
spherical Bessel functions of q = -p h, with h half the panel's width.

They are computed by Miller's downward recurrence. If |q| exceeds the number of terms, the upward
recurrence is stable and needs only the panels' ends (Filon's method). The 0/0 of textbook forms
does not occur.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.loads.vibration.oscillator import Oscillator
from geneva_cli.loads.vibration.panels import TERMS, Panels
from geneva_cli.numerics.arrays import Array, Complex, Whole

if TYPE_CHECKING:
    from numpy.typing import NDArray


def residual_swing(panels: Panels, motion: Whole, swing: Oscillator[Array]) -> Complex:
    """Return the residual vibration of each oscillator after a motion: (n,), over the step.

    It is (r' - p* r) / Im p at the end of the motion, which begins without vibration. Here r is the
    load's angle minus the wheel's, over the step. p* is the conjugate of p, so r is its imaginary
    part. ``motion`` (n,) are the motions of the oscillators, by their numbers among the panels'.
    """
    out = np.empty(len(motion), dtype=complex)
    order = _orders(panels, motion, swing)
    for k in range(1, int(order.max(initial=0)) + 1):
        at = np.flatnonzero(order == k)
        count = np.cumsum(np.diff(panels.ends)[motion[at]])
        start = 0
        while start < len(at):
            done = count[start - 1] if start else 0
            # 16,384 pairs of an oscillator and a panel at a time stay in the cache
            stop = max(start + 1, int(np.searchsorted(count, done + (1 << 14), side="right")))
            part = at[start:stop]
            some = Oscillator(swing.ratio[part], swing.damping[part])
            p = some.p
            # By parts: one more derivative, if it vanishes at both ends, gains a factor p.
            out[part] = -_integral(panels, k, motion[part], some) * p ** (2 - k) / p.imag
            start = stop
    return out


def _orders(panels: Panels, motion: Whole, swing: Oscillator[Array]) -> Whole:
    """Return the best derivative to integrate: rounding is proportional to its greatest value."""
    best = np.ones(len(motion), dtype=np.intp)
    omega = 2.0 * np.pi * swing.ratio
    with np.errstate(all="ignore"):
        for k in range(2, len(panels.greatest) + 1):
            rate = (panels.greatest[k - 1] / panels.greatest[k - 2])[motion]
            best[(k <= panels.smooth[motion] + 1) & (omega > rate)] = k
    return best


def _integral(panels: Panels, order: int, motion: Whole, swing: Oscillator[Array]) -> Complex:
    """Integrate a derivative of each oscillator's motion against its vibration."""
    of, panel, first = panels.paired(motion)
    p, h = swing.p[of], panels.half[panel]
    each = Oscillator(swing.ratio[of], swing.damping[of])
    series = panels.series[order - 1, panel]
    # Without damping q = -i omega h, and all recurrences are real in omega h.
    unit = 1.0 if swing.damping.any() else -1j
    # an integral over a smaller |q| is that over 1e-15, to rounding
    reach = np.maximum(h, 1e-15 / np.abs(p))
    size = np.abs(p) * reach
    reduced: Array | Complex = -p * reach if unit == 1.0 else size
    out: Complex = np.empty(len(of), dtype=complex)
    after = _after(each, 1.0 - panels.right[panel])
    large = size >= TERMS  # there the upward recurrence is stable
    # apart, since 56 terms of a |q| below 1e-8 overflow, and 32 of 1e-15 do not
    for here in (size < 0.5, (size >= 0.5) & ~large):
        if here.any():
            out[here] = _by_recurrence(reduced[here], unit, series[here]) * h[here] * after[here]
    if large.any():
        some = Oscillator(each.ratio[large], each.damping[large])
        one, other = _by_ends(reduced[large], unit, series[large])
        both = _after(some, 1.0 - panels.left[panel[large]]) * one + after[large] * other
        out[large] = both / p[large]
    return np.add.reduceat(out, first)


def _after(one: Oscillator[Array], v: float | Array) -> Complex:
    """e^(p v), with the angle reduced before it is rounded; elementwise for arrays."""
    whole = np.floor(one.ratio)
    split = 2.0**26  # half of a double's bits
    head = np.floor(v * split) / split
    turns = (whole * head) % 1.0 + whole * (v - head) + (one.ratio - whole) * v
    angle = 2.0 * np.pi * (turns - np.round(turns))
    zeta = one.damping
    if not zeta.any():
        return np.cos(angle) + 1j * np.sin(angle)
    # difference of sqrt(1 - zeta²) from 1
    slower = zeta * zeta / (1.0 + np.sqrt(1.0 - zeta * zeta))
    omega = 2.0 * np.pi * one.ratio
    angle -= omega * slower * v
    return np.exp(-omega * zeta * v) * (np.cos(angle) + 1j * np.sin(angle))


def _sums(terms: NDArray[np.inexact], series: Array) -> Complex:
    """Sums over the terms: of (terms, pairs) times (pairs, terms)."""
    out: Complex = np.einsum("tp,pt->p", terms, series)
    return out


def _by_recurrence(reduced: Array | Complex, unit: complex, series: Array) -> Complex:
    """Integrals of f e^(q (x - 1)) by modified spherical Bessel functions i_n(q) = unit^n y_n.

    They are scaled by their sum: q is unit times ``reduced``, and the sum of (2 n + 1) i_n(q) is
    e^q.
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
    even, odd = _sums(kept[::2], scaled[:, ::2]), _sums(kept[1::2], scaled[:, 1::2])
    integrals: Complex = (even + unit * odd) / (sums[0] + unit * sums[1])
    return integrals


def _by_ends(reduced: Array | Complex, unit: complex, series: Array) -> tuple[Complex, Complex]:
    """Contributions of the panels' left and right ends, times p.

    The moments with Legendre's polynomials are m_(n+1) = m_(n-1) - (2 n + 1) m_n / q, from those of
    the ends only. ``even`` and ``odd`` are their parts in 1/q, odd over ``unit``.
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
    first = _sums(kept[0], series) + unit * _sums(kept[1], series)
    last = _sums(kept[0], turned) - unit * _sums(kept[1], turned)
    return first, last
