"""A load that vibrates on its shaft during a motion and after it, to the last digits.

It vibrates as e^(p u), u being the fraction of the motion's time, p = Omega (-zeta + i sqrt(1 -
zeta²)), Omega = 2 pi lambda and lambda the period ratio. The residual is an integral of f e^(p (1 -
u)), f a derivative of the motion. On a panel of half width h, f is a Legendre series. If |p h|
exceeds the number of its terms, the moments with Legendre's polynomials follow from the panel's
ends by a recurrence (Filon's method); otherwise Gauss's rule has them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.vibration.panels import NODES, SERIES, TERMS, Panels, X
from geneva_cli.numerics.arrays import Array, Complex, Whole, matrix_product
from geneva_cli.numerics.quadrature import rule

legendre, chebyshev = np.polynomial.legendre, np.polynomial.chebyshev
NODE, WEIGHT = rule(64)  # exact to a double for |p h| up to TERMS
_VALUES: Array = legendre.legvander(NODE, TERMS - 1).T.astype(float)
# values at a panel's nodes -> integrals from -1 to each node, and to 1
_ENDS = np.append(X, 1.0)
_INTEGRALS = matrix_product(
    np.array(
        [legendre.legval(_ENDS, legendre.legint(unit, lbnd=-1.0)) for unit in np.eye(NODES)]
    ).T,
    SERIES,
)


class Oscillator(NamedTuple):
    """Loads on their shafts, (n,): period ratios, and damping ratios below 1."""

    ratio: Array
    damping: Array

    @property
    def p(self) -> Complex:
        """Complex rate p of each, by the motion's time."""
        zeta = np.asarray(self.damping)
        return 2.0 * np.pi * self.ratio * (-zeta + 1j * np.sqrt(1.0 - zeta * zeta))


def residual_swing(panels: Panels, motion: Whole, swing: Oscillator) -> Complex:
    """The residual vibration of each oscillator after a motion: (n,), over the step.

    It is (r' - p* r) / Im p at the end of a motion that begins without vibration, r being the
    load's angle minus the wheel's. ``motion`` (n,) are the oscillators' motions among the panels'.
    """
    out = np.empty(len(motion), dtype=complex)
    # the best derivative to integrate: rounding is proportional to its greatest value
    order, omega = np.ones(len(motion), dtype=np.intp), 2.0 * np.pi * swing.ratio
    with np.errstate(all="ignore"):
        for k in range(2, len(panels.greatest) + 1):
            rate = (panels.greatest[k - 1] / panels.greatest[k - 2])[motion]
            order[(k <= panels.smooth[motion] + 1) & (omega > rate)] = k
    # some 4096 pairs of an oscillator and a panel at a time stay in the cache
    together = max(1, 4096 * len(panels.smooth) // len(panels.motion))
    for k in range(1, int(order.max(initial=0)) + 1):
        every = np.flatnonzero(order == k)
        for start in range(0, len(every), together):
            at = every[start : start + together]
            some = Oscillator(swing.ratio[at], swing.damping[at])
            p = some.p
            # By parts: one more derivative, if it vanishes at both ends, gains a factor p.
            out[at] = -_integral(panels, k, motion[at], some) * p ** (2 - k) / p.imag
    return out


def _integral(panels: Panels, order: int, motion: Whole, swing: Oscillator) -> Complex:
    """Integrate a derivative of each oscillator's motion against its vibration."""
    of, panel, first = panels.paired(motion)
    p, h = swing.p[of], panels.half[panel]
    series, left, right = panels.series[order - 1, panel], panels.left[panel], panels.right[panel]
    out: Complex = np.empty(len(of), dtype=complex)
    large = np.abs(p) * h >= TERMS  # there the recurrence is stable
    for here, whole in ((~large, False), (large, True)):
        if not here.any():
            continue
        some, c = Oscillator(swing.ratio[of][here], swing.damping[of][here]), series[here]
        after, q = _after(some, 1.0 - right[here]), (p * h)[here]
        if whole:
            before = _after(some, 1.0 - left[here])
            both = before * _sums(1.0 / q, c)
            both = both - after * _sums(-1.0 / q, c * (-1.0) ** np.arange(TERMS))
            out[here] = both / p[here]
        else:
            swung = np.exp(q[:, None] * (1.0 - NODE)) * WEIGHT
            out[here] = h[here] * after * (matrix_product(c, _VALUES) * swung).sum(axis=1)
    return np.add.reduceat(out, first)


def _after(one: Oscillator, v: Array) -> Complex:
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


def _sums(y: Complex, series: Array) -> Complex:
    """Contributions of a panel's end, times p, to integrals of ``series``, from y = 1/(p h).

    The moments with Legendre's polynomials are m_(n+1) = m_(n-1) + (2 n + 1) y m_n.
    """
    moments = np.empty((TERMS, len(y)), dtype=complex)
    before, here = -np.ones_like(y), np.ones_like(y)
    for n in range(TERMS):
        moments[n] = here
        before, here = here, before + (2.0 * n + 1.0) * y * here
    out: Complex = np.einsum("tp,pt->p", moments, series)
    return out


def greatest_accelerations(panels: Panels, motion: Whole, swing: Oscillator) -> Array:
    """The greatest size of each load's acceleration by u over the step: (n,).

    The load is at rest at entry. A shape's second derivative is integrated over pieces of its
    panels, which are short enough for the swing to have few terms on each.
    """
    most, omega, p = np.zeros(len(motion)), 2.0 * np.pi * swing.ratio, swing.p
    of, panel, first = panels.paired(motion)
    # Panels are cut so that |p h| is at most 2, with h half a piece's width: a dozen terms suffice.
    count = np.maximum(np.ceil(omega[of] * panels.half[panel] / 2.0), 1.0).astype(np.intp)
    last = np.cumsum(count)
    begin = last[first] - count[first]
    total = np.append(begin[1:], last[-1]) - begin
    # the load lags by a jump of the wheel's velocity at entry, where there is one
    begins_at = (panels.series[0, panel[first]] * (-1.0) ** np.arange(TERMS)).sum(axis=1)
    z = np.where(panels.smooth[motion] == 0, -begins_at, 0.0).astype(complex)
    active, start = np.arange(len(motion)), 0
    while len(active):
        wide = max(1, 4096 // len(active))  # 4096 pieces at a time fit in the cache
        at = start + np.arange(min(wide, int(total[active].max()) - start))
        there = at < total[active][:, None]
        number = (begin[active][:, None] + at)[there]
        pair = np.searchsorted(last, number, side="right")
        place, cut = number - last[pair] + count[pair], count[pair]
        half, rate = panels.half[panel[pair]] / cut, p[of[pair]]
        series = panels.series[1, panel[pair]].T[:, :, None]
        u = (2.0 * place[:, None] + 1.0 + X) / cut[:, None] - 1.0
        bent = legendre.legval(u, series, tensor=False)
        # z' = p z - s'': contribution of a piece, seen from its left end
        back = np.exp(-(rate * half)[:, None] * (1.0 + X))
        added = -half[:, None] * matrix_product(bent * back, _INTEGRALS.T)
        ahead = np.exp((rate * half)[:, None] * (1.0 + _ENDS))
        own, whole = np.zeros((2, *there.shape), dtype=complex)
        whole += 1.0
        own[there], whole[there] = added[:, -1], ahead[:, -1]
        begins, end = np.empty_like(own), z[active]
        for k in range(len(at)):  # each piece ends at whole (z + own) from its own start z
            begins[:, k] = end
            end = whole[:, k] * (end + own[:, k])
        z[active] = end
        swung = ahead * (begins[there][:, None] + added)
        w = omega[of[pair]][:, None]
        real, r = rate.real[:, None], swung.imag / rate.imag[:, None]
        _take_most(most, 2.0 * real * (swung.real + real * r) - w * w * r, of[pair])
        start += len(at)
        active = active[total[active] > start]
    return most


def _take_most(most: Array, load: Array, of: Whole) -> None:
    """Update ``most`` with |load|, known at nodes and right ends, and its maxima between them."""
    size = np.abs(load)
    np.maximum.at(most, of, size.max(axis=1))
    # a sample may be 2 % below its piece's maximum
    near = np.flatnonzero(size.max(axis=1) >= most[of] * (1.0 - 0.02))
    series = matrix_product(load[near, :NODES], SERIES.T).T
    slope = legendre.legder(series)
    bend = legendre.legder(slope)
    x = X[size[near, :NODES].argmax(axis=1)]
    for _ in range(8):  # Newton steps from the greatest sample of a piece to its maximum
        turn, rate = (legendre.legval(x, c, tensor=False) for c in (bend, slope))
        step = np.divide(rate, turn, out=np.zeros_like(x), where=turn != 0.0)
        x = np.clip(x - step, -1.0, 1.0)
    np.maximum.at(most, of[near], np.abs(legendre.legval(x, series, tensor=False)))


def local_maxima(shares: Callable[[Array], Array], station: int, low: float, high: float) -> Array:
    """The period ratios between two at which a residual has its local maxima.

    Its square oscillates at most once per 1 of the ratio: samples find the maxima, and a polynomial
    places each to the last digits. A maximum nearer than a sample to a minimum is left out.
    """
    count = max(64, math.ceil(16 * (high - low)))  # 16 samples for each 1 of the period ratio
    reach = (high - low) / count
    ratio = np.linspace(low - reach, high + reach, count + 3)  # one beyond each end
    share = shares(ratio)[station]
    middle = ratio[1:-1][(share[1:-1] >= share[:-2]) & (share[1:-1] > share[2:])]
    degree = 12  # of the polynomial between two samples about a maximum: exact to a double there
    nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
    places = middle[:, None] + reach * nodes
    square = shares(places.ravel())[station].reshape(places.shape) ** 2
    # at Chebyshev's nodes his coefficients are sums over them
    vander: Array = chebyshev.chebvander(nodes, degree).astype(float)
    slope = chebyshev.chebder((matrix_product(square, vander) * (2.0 / (degree + 1))).T)
    bend = chebyshev.chebder(slope)
    x = np.zeros(len(middle))
    for _ in range(6):  # Newton steps
        turn, rate = (chebyshev.chebval(x, c, tensor=False) for c in (bend, slope))
        step = np.divide(rate, turn, out=np.zeros_like(x), where=turn < 0.0)
        x = np.clip(x - step, -1.0, 1.0)
    ratios = middle + reach * x
    return ratios[(ratios >= low) & (ratios <= high)]
