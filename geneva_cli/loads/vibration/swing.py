"""A load that vibrates on its shaft during a motion and after it, to 2e-16 of the step.

A motion's shape is the fraction s of the step by the fraction u of the motion's time. It is cut
into panels, which are halved until Legendre series of s' and s'' have ended. The load vibrates as
e^(p u), p = Omega (-zeta + i sqrt(1 - zeta²)), Omega = 2 pi lambda and lambda the period ratio. The
residual is an integral of f e^(p (1 - u)), f being s' or s'', by Gauss's rule over equal pieces of
the panels.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
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


def _pushes(
    panels: Panels, order: int, motion: Whole, swing: Oscillator, most: float, integrals: Array
) -> Iterator[tuple[Whole, Array, Array, Complex]]:
    """Yield what a derivative adds to vibrations: numbers of oscillators, and pieces of a panel.

    It is cut into k equal ones, with the half width h, (n, 1), so that |p h| is at most ``most``:
    the ``integrals`` of f e^(p (left - u)) over them are (n, k, e), and their left ends (n, k).
    One panel of each motion comes after the other.
    """
    ends = np.searchsorted(panels.motion, np.arange(len(panels.jumps) + 1))
    first, last = ends[motion], ends[motion + 1]
    for panel in range(max(last - first, default=0)):
        of = np.flatnonzero(first + panel < last)
        own, p = first[of] + panel, swing.p[of]
        half = panels.half[own]
        pieces = max(1, math.ceil((np.abs(p) * half).max() / most))
        h = (half / pieces)[:, None]
        back = np.exp(-(p[:, None] * h) * (1.0 + X))[:, None]
        for some in blocks(pieces, max(1, 4096 // len(of))):  # these fit in the cache
            at = np.arange(some.start, some.stop)
            places = (2.0 * at[:, None] + 1.0 + X) / pieces - 1.0
            polynomials = legendre.legvander(places, TERMS - 1)
            values = np.einsum("kxt,nt->nkx", polynomials, panels.series[order - 1, own])
            left = panels.left[own, None] + 2.0 * h * at
            yield of, h, left, h[..., None] * matrix_product(values * back, integrals)


def residual_swing(panels: Panels, motion: Whole, swing: Oscillator) -> Complex:
    """The residual vibration of each oscillator after a motion: (n,), over the step.

    It is (r' - p* r) / Im p at the end of a motion that begins without vibration, r being the
    load's angle minus the wheel's. ``motion`` (n,) are the oscillators' motions among the panels'.
    """
    out = np.zeros(len(motion), dtype=complex)
    # the better derivative to integrate: rounding is proportional to its greatest value
    quick = 2.0 * np.pi * swing.ratio * panels.greatest[0, motion] > panels.greatest[1, motion]
    order = np.where(quick & ~panels.jumps[motion], 2, 1)
    for k in (1, 2):
        every = np.flatnonzero(order == k)
        some, p = swing.of(every), swing.p[every]
        # Gauss's rule is exact to a double up to |p h| = 10
        for of, _, left, added in _pushes(panels, k, motion[every], some, 10.0, _INTEGRALS[-1:].T):
            swung = (np.exp(p[of, None] * (1.0 - left)) * added[..., 0]).sum(axis=1)
            # By parts: one more derivative, if it vanishes at both ends, gains a factor p.
            out[every[of]] -= swung * p[of] ** (2 - k) / p[of].imag
    return out


def greatest_accelerations(panels: Panels, motion: Whole, swing: Oscillator) -> Array:
    """The greatest size of each load's acceleration by u over the step: (n,).

    The load is at rest at entry. With z' = p z - s'' each piece ends at e^(p h) (z - added).
    """
    most, omega, rate = np.zeros(len(motion)), 2.0 * np.pi * swing.ratio, swing.p
    # the load lags by a jump of the wheel's velocity at entry, where there is one
    first = np.searchsorted(panels.motion, motion)
    begins_at = (panels.series[0, first] * (-1.0) ** np.arange(TERMS)).sum(axis=1)
    z = np.where(panels.jumps[motion], -begins_at, 0.0).astype(complex)
    # with |p h| of at most 2 a dozen terms suffice for the swing
    for of, h, _, added in _pushes(panels, 2, motion, swing, 2.0, _INTEGRALS.T):
        p, w = rate[of, None, None], omega[of, None, None]
        ahead = np.exp((p * h[..., None]) * (1.0 + _ENDS))
        begins: Complex = np.empty((*added.shape[:2], 1), dtype=complex)
        for i in range(added.shape[1]):
            begins[:, i, 0] = z[of]
            z[of] = ahead[:, 0, -1] * (z[of] - added[:, i, -1])
        swung = ahead * (begins - added)
        r = swung.imag / p.imag
        load = 2.0 * p.real * (swung.real + p.real * r) - w * w * r
        _take_most(most, load.reshape(-1, len(_ENDS)), of.repeat(added.shape[1]))
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
