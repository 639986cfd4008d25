"""A load that vibrates on its shaft during a motion and after it, to 1e-16 of the step.

A motion's shape is the fraction s of the step by the fraction u of the motion's time. It is cut
into panels, all of which are halved until Legendre series of s' and s'' have ended. The load
vibrates as e^(p u), p = Omega (-zeta + i sqrt(1 - zeta²)), Omega = 2 pi lambda and lambda the
period ratio. The residual is an integral of f e^(p (1 - u)), f being s' or s'', by Gauss's rule
over equal pieces of the panels.
"""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.motion.engagement import WheelMotion
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Complex, Mask, Whole, blocks, matrix_product, record_taken
from geneva_cli.numerics.jet import Array

legendre = np.polynomial.legendre
NODES = 32  # of Gauss's rule on a panel
TERMS = 20  # of Legendre's series that are kept
MOST = 200  # panels between two knots of a motion: with more, its series are of noise

X, _ = legendre.leggauss(NODES)
_values = legendre.legvander(X, NODES - 1)
# by Christoffel's sum, which has more digits than the function's own weights
WEIGHTS: Array = 1.0 / (_values**2 * (np.arange(NODES) + 0.5)).sum(axis=1)
# values at the nodes -> coefficients of Legendre's series
SERIES: Array = (_values * WEIGHTS[:, None] * (np.arange(NODES) + 0.5)).T
# values at a panel's nodes -> integrals from -1 to each node, and to 1
_ENDS = np.append(X, 1.0)
_INTEGRALS = matrix_product(
    legendre.legval(_ENDS, legendre.legint(np.eye(NODES), lbnd=-1.0)).T, SERIES
)


class Panels(NamedTuple):
    """The k panels of each of m motions, in the order of places."""

    left: Array  # (m, k) ends of each panel
    half: Array  # (m, k) half the width of each
    series: Array  # (2, m, k, term): s' and s'' by u as Legendre series
    jumps: Mask  # (m,) True where the motion begins or ends with a velocity
    greatest: Array  # greatest size of either derivative, (2, m)


def motion_shapes(motion: WheelMotion, m: int = 1) -> Panels:
    """The panels of the motions of m designs, whose derivatives may jump at the knots."""
    whole, step = motion.exit_deg - motion.entry_deg, 2.0 * motion.half_step

    def rates(u: Array) -> Array:
        """s' and s'' at places u (m, n): (2, m, n)."""
        speed, bend = motion.rate(motion.entry_deg + u * whole, 1).derivatives()
        per_radian = whole * DEGREE
        rows = speed * (per_radian / step), bend * (per_radian * (per_radian / step))
        return np.stack(np.broadcast_arrays(*rows))

    places = np.hstack([np.broadcast_to(np.asarray(x), (m, 1)) for x in motion.knots_deg])
    edges = (places - places[:, :1]) / (places[:, -1:] - places[:, :1])
    while True:
        left, half = edges[:, :-1], 0.5 * np.diff(edges)
        nodes = left[..., None] + half[..., None] * (1.0 + X)
        values = rates(nodes.reshape(m, -1)).reshape(2, m, -1, NODES)
        series, greatest = matrix_product(values, SERIES.T), np.abs(values).max(axis=(2, 3))
        # the last six terms, and those that are not kept, show whether the series has ended
        tail = np.abs(series[..., TERMS - 6 :]).max(axis=(2, 3))
        # 1e-13 is some hundred roundings
        if (tail <= 1e-13 * greatest).all() or edges.shape[1] > MOST * places.shape[1]:
            break
        halved = np.stack((left, left + half), axis=-1).reshape(m, -1)
        edges = np.hstack((halved, edges[:, -1:]))
    # A velocity of 1e-12 of the greatest one is rounding. Only a crank as built starts and stops
    # the wheel with a jump of velocity.
    at_ends = rates(np.broadcast_to([0.0, 1.0], (m, 2)))[0]
    jumps = np.abs(at_ends).max(axis=1) > 1e-12 * greatest[0]
    return Panels(left, half, series[..., :TERMS], jumps, greatest)


class Oscillator(NamedTuple):
    """Loads on their shafts, (n,): period ratios, and damping ratios below 1."""

    ratio: Array
    damping: Array

    @property
    def p(self) -> Complex:
        """Complex rate p of each, by the motion's time."""
        zeta = np.asarray(self.damping)
        return 2.0 * np.pi * self.ratio * (-zeta + 1j * np.sqrt(1.0 - zeta * zeta))


def _pushes(
    panels: Panels, order: int, motion: Whole, swing: Oscillator, most: float, integrals: Array
) -> Iterator[tuple[Array, Array, Complex]]:
    """Yield what a derivative adds to the vibrations of n oscillators, over pieces of a panel.

    A panel is cut into k equal ones, with the half width h, (n, 1), so that |p h| is at most
    ``most``. With h go their left ends (n, k), and ``integrals`` of f e^(p (left - u)) over them,
    (n, k, e).
    """
    for panel in range(panels.left.shape[1] if len(motion) else 0):
        half, p = panels.half[motion, panel], swing.p
        pieces = max(1, math.ceil((np.abs(p) * half).max() / most))
        h = (half / pieces)[:, None]
        back = np.exp(-(p[:, None] * h) * (1.0 + X))[:, None]
        for some in blocks(pieces, max(1, 4096 // len(motion))):  # these fit in the cache
            at = np.arange(some.start, some.stop)
            places = (2.0 * at[:, None] + 1.0 + X) / pieces - 1.0
            polynomials = legendre.legvander(places, TERMS - 1)
            values = np.einsum("kxt,nt->nkx", polynomials, panels.series[order - 1, motion, panel])
            left = panels.left[motion, panel, None] + 2.0 * h * at
            yield h, left, h[..., None] * matrix_product(values * back, integrals)


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
        some, p = record_taken(swing, every), swing.p[every]
        # Gauss's rule is exact to a double up to |p h| = 10
        for _, left, added in _pushes(panels, k, motion[every], some, 10.0, WEIGHTS[:, None]):
            swung = (np.exp(p[:, None] * (1.0 - left)) * added[..., 0]).sum(axis=1)
            # By parts: one more derivative, if it vanishes at both ends, gains a factor p.
            out[every] -= swung * p ** (2 - k) / p.imag
    return out


def greatest_accelerations(panels: Panels, motion: Whole, swing: Oscillator) -> Array:
    """The greatest size of each load's acceleration by u over the step: (n,).

    The load is at rest at entry. With z' = p z - s'' each piece ends at e^(p h) (z - added).
    """
    most, p = np.zeros(len(motion)), swing.p[:, None, None]
    w = (2.0 * np.pi * swing.ratio)[:, None, None]
    # the load lags by a jump of the wheel's velocity at entry, where there is one
    begins_at = (panels.series[0, motion, 0] * (-1.0) ** np.arange(TERMS)).sum(axis=1)
    z = np.where(panels.jumps[motion], -begins_at, 0.0).astype(complex)
    # with |p h| of at most 2 a dozen terms suffice for the swing
    for h, _, added in _pushes(panels, 2, motion, swing, 2.0, _INTEGRALS.T):
        ahead = np.exp((p * h[..., None]) * (1.0 + _ENDS))
        begins: Complex = np.empty((*added.shape[:2], 1), dtype=complex)
        for i in range(added.shape[1]):
            begins[:, i, 0] = z
            z = ahead[:, 0, -1] * (z - added[:, i, -1])
        swung = ahead * (begins - added)
        r = swung.imag / p.imag
        load = 2.0 * p.real * (swung.real + p.real * r) - w * w * r
        at_nodes = load[..., :NODES].reshape(-1, NODES)  # maxima lie between them
        tops = _tops(at_nodes, X[np.abs(at_nodes).argmax(axis=1)])[1].reshape(len(motion), -1)
        most = np.max(np.abs(np.column_stack((most, tops, load[..., -1]))), axis=1)
    return most


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
