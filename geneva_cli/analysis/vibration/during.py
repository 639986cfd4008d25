"""The load's acceleration while the wheel moves."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.vibration.shape import NODES, SERIES, TERMS, Shape, X
from geneva_cli.numerics.budget import ask

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

legendre = np.polynomial.legendre
REACH = 2.0  # greatest |p h|: half a period and less on a panel, a matter of a dozen terms
BLOCK = 4096  # panels at a time
NEAR = 0.02  # share of the greatest sample by which a sample may miss its panel's maximum
NEWTON = 8  # steps from the greatest sample of a panel to its maximum

# values at the nodes -> integrals from -1 to each node, and to 1
_ENDS = np.append(X, 1.0)
_INTEGRALS = (
    np.array([legendre.legval(_ENDS, legendre.legint(unit, lbnd=-1.0)) for unit in np.eye(NODES)]).T
    @ SERIES
)


def greatest_acceleration(shape: Shape, ratio: float, damping: float) -> float:
    """The greatest size of the load's acceleration by u over the step, from entry to exit.

    The load begins at rest. ``ratio`` is the period ratio; the shape's second derivative is
    integrated panel by panel, so finely that the swing is a polynomial of few terms on each.
    """
    omega = 2.0 * math.pi * ratio
    p = omega * complex(-damping, math.sqrt(1.0 - damping * damping))
    left, half, series = _fine(shape, omega)
    z, most = 0j, 0.0
    for start in range(0, len(left), BLOCK):
        ask()
        part = slice(start, start + BLOCK)
        h = half[part, None]
        bent = legendre.legval(X, series[part].T)
        bent = bent if bent.ndim > 1 else bent[None]
        # z' = p z - s'': what a panel adds, seen from its left end
        back = np.exp(-p * h * (1.0 + X))
        added = -h * ((bent * back) @ _INTEGRALS.T)
        ahead = np.exp(p * h * (1.0 + _ENDS))
        begins = np.empty((len(h), 1), dtype=complex)
        for i in range(len(h)):
            begins[i] = z
            z = ahead[i, -1] * (z + added[i, -1])
        swing = ahead * (begins + added)
        r = swing.imag / p.imag
        load = 2.0 * p.real * (swing.real + p.real * r) - omega * omega * r
        most = _most(load, most)
    return most


def _fine(shape: Shape, omega: float) -> tuple[Array, Array, Array]:
    """Left ends, half widths, series of s'' of the panels, cut to a |p h| of REACH at most."""
    left, half, series = [], [], []
    for panels in shape.panels:
        count = max(1, math.ceil(omega * panels.half / REACH))
        own = panels.series[1]
        h = panels.half / count
        for j in range(count):
            middle = -1.0 + (2 * j + 1) / count
            at = legendre.legval(middle + X / count, own.T)
            at = at if at.ndim > 1 else at[None]
            series.append((at @ SERIES.T)[:, :TERMS] if count > 1 else own)
            left.append(panels.left + 2.0 * h * j)
            half.append(np.full(len(panels.left), h))
    starts = np.concatenate(left)
    order = starts.argsort()
    return starts[order], np.concatenate(half)[order], np.concatenate(series)[order]


def _most(load: Array, most: float) -> float:
    """The greatest of |load|, given at the nodes and the right ends of panels, between them too."""
    size = np.abs(load)
    most = max(most, float(size.max()))
    near = np.flatnonzero(size.max(axis=1) >= most * (1.0 - NEAR))
    if not len(near):
        return most
    series = (load[near, :NODES] @ SERIES.T).T
    slope = legendre.legder(series)
    bend = legendre.legder(slope)
    x = X[size[near, :NODES].argmax(axis=1)]
    for _ in range(NEWTON):
        turn = legendre.legval(x, bend, tensor=False)
        step = np.divide(
            legendre.legval(x, slope, tensor=False), turn, out=np.zeros_like(x), where=turn != 0.0
        )
        x = np.clip(x - step, -1.0, 1.0)
    return max(most, float(np.abs(legendre.legval(x, series, tensor=False)).max()))
