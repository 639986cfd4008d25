"""Integrals of a motion's derivatives against the vibration of an oscillator, to the last digits.

The load vibrates as e^(p u), with u the fraction of the motion's time and

    p = Omega (-zeta + i sqrt(1 - zeta²)),    Omega = 2 pi lambda.

lambda is the period ratio: the motion's time over the load's natural period. The residual of a
motion is an integral of f e^(p (1 - u)) over 0..1, where f is a derivative of the motion by u. On
each panel, of half width h, f is a Legendre series. If |p h| exceeds the number of its terms, the
moments of e^(p (1 - u)) with Legendre's polynomials follow from the panel's ends, by a recurrence
(Filon's method). Otherwise Gauss's rule has them.
"""

from __future__ import annotations

import numpy as np

from geneva_cli.loads.vibration.oscillator import Oscillator
from geneva_cli.loads.vibration.panels import TERMS, Panels
from geneva_cli.numerics.arrays import Array, Complex, Whole, matrix_product
from geneva_cli.numerics.quadrature import rule

NODE, WEIGHT = rule(64)  # exact to a double for |p h| up to TERMS
_VALUES: Array = np.polynomial.legendre.legvander(NODE, TERMS - 1).T.astype(float)


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
            # 4096 pairs of an oscillator and a panel at a time stay in the cache
            stop = max(start + 1, int(np.searchsorted(count, done + (1 << 12), side="right")))
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
    series, left, right = panels.series[order - 1, panel], panels.left[panel], panels.right[panel]
    out: Complex = np.empty(len(of), dtype=complex)
    large = np.abs(p) * h >= TERMS  # there the recurrence is stable
    for here, whole in ((~large, False), (large, True)):
        if not here.any():
            continue
        some, c = Oscillator(each.ratio[here], each.damping[here]), series[here]
        after, q = _after(some, 1.0 - right[here]), (p * h)[here]
        if whole:
            begin, end = _moments(1.0 / q), -_moments(-1.0 / q)
            before = _after(some, 1.0 - left[here])
            signs = (-1.0) ** np.arange(TERMS)
            both = before * _sums(begin, c) + after * _sums(end, c * signs)
            out[here] = both / p[here]
        else:
            swung = np.exp(q[:, None] * (1.0 - NODE)) * WEIGHT
            out[here] = h[here] * after * (matrix_product(c, _VALUES) * swung).sum(axis=1)
    return np.add.reduceat(out, first)


def _after(one: Oscillator[Array], v: Array) -> Complex:
    """e^(p v), with the angle reduced before it is rounded; elementwise."""
    whole = np.floor(one.ratio)
    split = 2.0**26  # half of a double's bits
    head = np.floor(v * split) / split
    turns = (whole * head) % 1.0 + whole * (v - head) + (one.ratio - whole) * v
    angle = 2.0 * np.pi * (turns - np.round(turns))
    zeta, omega = one.damping, 2.0 * np.pi * one.ratio
    # difference of sqrt(1 - zeta²) from 1
    angle -= omega * (zeta * zeta / (1.0 + np.sqrt(1.0 - zeta * zeta))) * v
    return np.exp(-omega * zeta * v) * (np.cos(angle) + 1j * np.sin(angle))


def _sums(terms: Complex, series: Array) -> Complex:
    """Sums over the terms: of (terms, pairs) times (pairs, terms)."""
    out: Complex = np.einsum("tp,pt->p", terms, series)
    return out


def _moments(y: Complex) -> Complex:
    """Contributions of a panel's end to the moments, times p, from y = 1/(p h): (terms, pairs).

    The moments with Legendre's polynomials are m_(n+1) = m_(n-1) + (2 n + 1) y m_n.
    """
    kept = np.empty((TERMS, len(y)), dtype=complex)
    before, here = -np.ones_like(y), np.ones_like(y)
    for n in range(TERMS):
        kept[n] = here
        before, here = here, before + (2.0 * n + 1.0) * y * here
    return kept
