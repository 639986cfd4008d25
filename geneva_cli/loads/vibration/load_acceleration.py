"""The load's acceleration while the wheel moves."""

from __future__ import annotations

import numpy as np

from geneva_cli.loads.vibration.oscillator import Oscillator
from geneva_cli.loads.vibration.panels import NODES, SERIES, Panels, X
from geneva_cli.numerics.arrays import Array, Complex, Whole, matrix_product

legendre = np.polynomial.legendre
# values at the nodes -> integrals from -1 to each node, and to 1
_ENDS = np.append(X, 1.0)
_INTEGRALS = matrix_product(
    np.array(
        [legendre.legval(_ENDS, legendre.legint(unit, lbnd=-1.0)) for unit in np.eye(NODES)]
    ).T,
    SERIES,
)


def greatest_accelerations(panels: Panels, motion: Whole, swing: Oscillator[Array]) -> Array:
    """Return the greatest size of each load's acceleration by u over the step: (n,).

    It is over the motion, with the load at rest at entry. ``motion`` (n,) are the motions of the
    oscillators by number. A shape's second derivative is integrated over pieces of its panels,
    which are short enough for the swing to have few terms on each.
    """
    most, omega, p = np.zeros(len(motion)), 2.0 * np.pi * swing.ratio, swing.p
    of, panel, first = panels.paired(motion)
    # Panels are cut so that |p h| is at most 2, with h half a piece's width: a dozen terms suffice.
    count = np.maximum(np.ceil(omega[of] * panels.half[panel] / 2.0), 1.0).astype(np.intp)
    last = np.cumsum(count)
    begin = last[first] - count[first]
    total = np.append(begin[1:], last[-1]) - begin
    active, start, z = np.arange(len(motion)), 0, np.zeros(len(motion), dtype=complex)
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
        begins, z[active] = _one_after_the_other(whole, own, z[active])
        swung = ahead * (begins[there][:, None] + added)
        w = omega[of[pair]][:, None]
        real, r = rate.real[:, None], swung.imag / rate.imag[:, None]
        load = 2.0 * real * (swung.real + real * r) - w * w * r
        _take_most(most, load, of[pair])
        start += len(at)
        active = active[total[active] > start]
    return most


def _one_after_the_other(whole: Complex, own: Complex, z: Complex) -> tuple[Complex, Complex]:
    """Values at the starts of pieces (n, k), and at the end of the last.

    Each piece ends at whole (z + own) from its own start z. Neighbours are joined in pairs, pairs
    of pairs, and so on.
    """
    rate, add = whole, whole * own
    step = 1
    while step < whole.shape[1]:
        joined = add.copy(), rate.copy()
        joined[0][:, step:] += rate[:, step:] * add[:, :-step]
        joined[1][:, step:] *= rate[:, :-step]
        add, rate = joined
        step *= 2
    ends = rate * z[:, None] + add
    return np.hstack((z[:, None], ends[:, :-1])), ends[:, -1]


def _take_most(most: Array, load: Array, of: Whole) -> None:
    """Update ``most`` with |load|, which is known at the nodes and right ends of pieces.

    Maxima between the nodes are included.
    """
    size = np.abs(load)
    np.maximum.at(most, of, size.max(axis=1))
    # a sample may be 2 % below its piece's maximum
    near = np.flatnonzero(size.max(axis=1) >= most[of] * (1.0 - 0.02))
    series = matrix_product(load[near, :NODES], SERIES.T).T
    slope = legendre.legder(series)
    bend = legendre.legder(slope)
    x = X[size[near, :NODES].argmax(axis=1)]
    for _ in range(8):  # Newton steps from the greatest sample of a piece to its maximum
        turn = legendre.legval(x, bend, tensor=False)
        step = np.divide(
            legendre.legval(x, slope, tensor=False), turn, out=np.zeros_like(x), where=turn != 0.0
        )
        x = np.clip(x - step, -1.0, 1.0)
    np.maximum.at(most, of[near], np.abs(legendre.legval(x, series, tensor=False)))
