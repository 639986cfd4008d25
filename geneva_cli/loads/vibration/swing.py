"""A load that vibrates on its shaft during a motion and after it, to 1e-16 of the step.

A motion's shape is the fraction s of the step by the fraction u of the motion's time. It is cut
into panels, which are halved until Legendre series of s' and s'' have ended. The load vibrates as
e^(p u), p = Omega (-zeta + i sqrt(1 - zeta²)), Omega = 2 pi lambda and lambda the period ratio. The
residual is an integral of f e^(p (1 - u)), f being s' or s''. If |p h|, h being half of a panel's
width, exceeds the number of its terms, the moments with Legendre's polynomials follow from the
panel's ends by a recurrence (Filon's method); otherwise Gauss's rule has them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.motion.batch import selection
from geneva_cli.motion.engagement import WheelMotion
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Complex, Mask, Whole, blocks, joined, matrix_product
from geneva_cli.numerics.jet import Array

Rates: TypeAlias = Callable[[Array, Whole], Array]

legendre = np.polynomial.legendre
NODES = 32  # of Gauss's rule on a panel
TERMS = 20  # of Legendre's series that are kept
MOST = 200  # panels between two knots of a motion: with more, its series are of noise

X, _weights = legendre.leggauss(NODES)
# values at the nodes -> coefficients of Legendre's series
_series = legendre.legvander(X, NODES - 1) * _weights[:, None] * (np.arange(NODES) + 0.5)
SERIES: Array = _series.T.astype(float)
NODE, WEIGHT = legendre.leggauss(64)  # exact to a double for |p h| up to TERMS
_VALUES: Array = legendre.legvander(NODE, TERMS - 1).T.astype(float)
# values at a panel's nodes -> integrals from -1 to each node, and to 1
_ENDS = np.append(X, 1.0)
_INTEGRALS = matrix_product(
    legendre.legval(_ENDS, legendre.legint(np.eye(NODES), lbnd=-1.0)).T, SERIES
)


class Panels(NamedTuple):
    """The panels of m motions, in the order of motions and of places: p in all."""

    motion: Whole  # (p,) motion of each panel
    left: Array  # (p,) ends of each panel
    right: Array
    series: Array  # (2, p, term): s' and s'' by u as Legendre series
    jumps: Mask  # (m,) True where the motion begins or ends with a velocity
    greatest: Array  # greatest size of either derivative, (2, m)

    @property
    def half(self) -> Array:
        """Half the width of each panel."""
        return 0.5 * (self.right - self.left)

    def paired(self, motion: Whole) -> tuple[Whole, Whole, Whole]:
        """Pairs of an oscillator and a panel of its ``motion`` (n,), in order.

        The result has the numbers of both, and the first pair of each oscillator.
        """
        ends = np.searchsorted(self.motion, np.arange(len(self.jumps) + 1))
        count = (ends[1:] - ends[:-1])[motion]
        first = np.cumsum(count) - count
        of = np.repeat(np.arange(len(motion)), count)
        return of, np.arange(len(of)) + np.repeat(ends[motion] - first, count), first


def motion_shapes(motion: WheelMotion, m: int = 1) -> Panels:
    """The panels of the motions of m designs, whose derivatives may jump at the knots."""
    of_designs = selection(motion)

    def rates(u: Array, which: Whole) -> Array:
        """s' and s'' at places u (p, k) of the motions ``which`` (p,): (2, p, k)."""
        some: WheelMotion = of_designs(which)
        whole = some.exit_deg - some.entry_deg
        speed, bend = some.rate(some.entry_deg + u * whole, 1).derivatives()
        per_radian, step = whole * DEGREE, 2.0 * some.half_step
        rows = speed * (per_radian / step), bend * (per_radian * (per_radian / step))
        return np.stack(np.broadcast_arrays(*rows))

    places = np.hstack([np.broadcast_to(np.asarray(x), (m, 1)) for x in motion.knots_deg])
    breaks = (places - places[:, :1]) / (places[:, -1:] - places[:, :1])
    number, edges, values, greatest = _refined(rates, breaks)
    in_order = np.lexsort((edges[0], number))
    number, (left, right), values = number[in_order], edges[:, in_order], values[:, in_order]
    series = matrix_product(values, SERIES.T)
    # A velocity of 1e-12 of the greatest one is rounding. Only a crank as built starts and stops
    # the wheel with a jump of velocity.
    at_ends = rates(np.broadcast_to([0.0, 1.0], (m, 2)), np.arange(m))[0]
    jumps = np.abs(at_ends).max(axis=1) > 1e-12 * greatest[0]
    return Panels(number, left, right, series[..., :TERMS], jumps, greatest)


def _refined(of: Rates, breaks: Array) -> tuple[Whole, Array, Array, Array]:
    """Panels: their motions (p,), ends (2, p), and s' and s'' at their nodes (2, p, NODES).

    And the greatest sizes of both in each motion.
    """
    m, closed = len(breaks), []
    open_, motion = np.stack((breaks[:, :-1].ravel(), breaks[:, 1:].ravel())), np.arange(m)
    motion = np.repeat(motion, breaks.shape[1] - 1)
    wide = open_[1] > open_[0]
    open_, motion = open_[:, wide], motion[wide]
    greatest, count = np.zeros((2, m)), np.zeros(m, dtype=int)
    while len(motion):
        np.add.at(count, motion, 1)
        width = open_[1] - open_[0]
        rates = of(open_[0, :, None] + width[:, None] * (0.5 * (1.0 + X)), motion)
        for row, values in zip(greatest, np.abs(rates).max(axis=2), strict=True):
            np.maximum.at(row, motion, values)
        # the last six terms show whether the series has ended
        tail = np.abs(matrix_product(rates, SERIES[TERMS - 6 :].T)).max(axis=2)
        # 1e-13 is some hundred roundings; panels narrower than 1e-12 of the motion are not halved
        ended = (tail <= 1e-13 * greatest[:, motion]).all(axis=0) | (width < 1e-12)
        ended |= (count > MOST * (breaks.shape[1] - 1))[motion]
        closed.append((motion[ended], open_[:, ended], rates.swapaxes(1, 2)[..., ended]))
        left, right = open_[:, ~ended]
        motion = np.tile(motion[~ended], 2)
        middle = 0.5 * (left + right)
        open_ = np.stack((np.append(left, middle), np.append(middle, right)))
    motion, open_, values = joined(closed)
    return motion, open_, values.swapaxes(1, 2), greatest


class Oscillator(NamedTuple):
    """Loads on their shafts, (n,): period ratios, and damping ratios below 1."""

    ratio: Array
    damping: Array

    def of(self, which: Whole) -> Oscillator:
        """Some of them."""
        return Oscillator(self.ratio[which], self.damping[which])

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
    # the better derivative to integrate: rounding is proportional to its greatest value
    quick = 2.0 * np.pi * swing.ratio * panels.greatest[0, motion] > panels.greatest[1, motion]
    order = np.where(quick & ~panels.jumps[motion], 2, 1)
    # some 4096 pairs of an oscillator and a panel at a time stay in the cache
    together = max(1, 4096 * len(panels.jumps) // len(panels.motion))
    for k in (1, 2):
        every = np.flatnonzero(order == k)
        for start in range(0, len(every), together):
            at = every[start : start + together]
            some = swing.of(at)
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
        own, c = p[here], series[here]
        after, q = np.exp(own * (1.0 - right[here])), own * h[here]
        if whole:
            before = np.exp(own * (1.0 - left[here]))
            both = before * _sums(1.0 / q, c)
            both = both - after * _sums(-1.0 / q, c * (-1.0) ** np.arange(TERMS))
            out[here] = both / own
        else:
            swung = np.exp(q[:, None] * (1.0 - NODE)) * WEIGHT
            out[here] = h[here] * after * (matrix_product(c, _VALUES) * swung).sum(axis=1)
    return np.add.reduceat(out, first)


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

    The load is at rest at entry. A shape's second derivative is integrated over equal pieces of its
    panels, one panel of each motion after the other.
    """
    most, omega, rate = np.zeros(len(motion)), 2.0 * np.pi * swing.ratio, swing.p
    _, panel, first = panels.paired(motion)
    count = np.diff(np.append(first, len(panel)))
    # the load lags by a jump of the wheel's velocity at entry, where there is one
    begins_at = (panels.series[0, panel[first]] * (-1.0) ** np.arange(TERMS)).sum(axis=1)
    z = np.where(panels.jumps[motion], -begins_at, 0.0).astype(complex)
    for k in range(count.max()):
        of = np.flatnonzero(count > k)
        own, p, w = panel[first[of] + k], rate[of, None, None], omega[of, None, None]
        # |p h| is at most 2, with h half a piece's width: a dozen terms suffice for the swing
        pieces = max(1, math.ceil((omega[of] * panels.half[own]).max() / 2.0))
        half = (panels.half[own] / pieces)[:, None, None]
        back, ahead = np.exp(-(p * half) * (1.0 + X)), np.exp((p * half) * (1.0 + _ENDS))
        for some in blocks(pieces, max(1, 4096 // len(of))):  # these fit in the cache
            at = np.arange(some.start, some.stop)
            u = (2.0 * at[:, None] + 1.0 + X) / pieces - 1.0
            values = legendre.legvander(u, TERMS - 1)
            bent = np.einsum("kxt,nt->nkx", values, panels.series[1, own])
            # z' = p z - s'': contribution of a piece, seen from its left end
            added = -half * matrix_product(bent * back, _INTEGRALS.T)
            begins = np.empty((len(of), len(at), 1), dtype=complex)
            for i in range(len(at)):  # each piece ends at ahead (z + added) from its own start z
                begins[:, i, 0] = z[of]
                z[of] = ahead[:, 0, -1] * (z[of] + added[:, i, -1])
            swung = ahead * (begins + added)
            r = swung.imag / p.imag
            load = 2.0 * p.real * (swung.real + p.real * r) - w * w * r
            _take_most(most, load.reshape(-1, len(_ENDS)), of.repeat(len(at)))
    return most


def _take_most(most: Array, load: Array, of: Whole) -> None:
    """Update ``most`` with |load|, known at nodes and right ends, and its maxima between them."""
    size = np.abs(load)
    np.maximum.at(most, of, size.max(axis=1))
    # a sample may be 2 % below its piece's maximum
    near = np.flatnonzero(size.max(axis=1) >= most[of] * (1.0 - 0.02))
    tops = _tops(load[near, :NODES], X[size[near, :NODES].argmax(axis=1)])[1]
    np.maximum.at(most, of[near], np.abs(tops))


def _tops(values: Array, x: Array) -> tuple[Array, Array]:
    """The places of extremes in [-1, 1] of functions (n, NODES) near x (n,), and their values."""
    series = matrix_product(values, SERIES.T).T
    slope = legendre.legder(series)
    bend = legendre.legder(slope)
    for _ in range(6 if len(x) else 0):  # Newton steps
        turn, rate = (legendre.legval(x, c, tensor=False) for c in (bend, slope))
        step = np.divide(rate, turn, out=np.zeros_like(x), where=turn != 0.0)
        x = np.clip(x - step, -1.0, 1.0)
    return x, np.asarray(legendre.legval(x, series, tensor=False), dtype=float)


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
    places = middle[:, None] + reach * X
    square = shares(places.ravel())[station].reshape(places.shape) ** 2
    ratios = middle + reach * _tops(square, np.zeros(len(middle)))[0]
    return ratios[(ratios >= low) & (ratios <= high)]
