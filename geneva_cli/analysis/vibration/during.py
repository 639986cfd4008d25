"""The load's acceleration while the wheel moves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.vibration.shape import NODES, SERIES, Shape, X
from geneva_cli.numerics.budget import check_time

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

legendre = np.polynomial.legendre
REACH = 2.0  # greatest |p h|, h half a piece's width: a matter of a dozen terms
BLOCK = 4096  # pieces at a time
NEAR = 0.02  # share of the greatest sample by which a sample may miss its piece's maximum
NEWTON = 8  # steps from the greatest sample of a piece to its maximum

# values at the nodes -> integrals from -1 to each node, and to 1
_ENDS = np.append(X, 1.0)
_INTEGRALS = (
    np.array([legendre.legval(_ENDS, legendre.legint(unit, lbnd=-1.0)) for unit in np.eye(NODES)]).T
    @ SERIES
)


def greatest_acceleration(shape: Shape, ratio: float, damping: float) -> float:
    """The greatest size of the load's acceleration by u over the step, from entry to exit.

    The load begins at rest. ``ratio`` is the period ratio; the shape's second derivative is
    integrated piece by piece of its panels, so short that the swing has few terms on each.
    """
    omega = 2.0 * math.pi * ratio
    p = omega * complex(-damping, math.sqrt(1.0 - damping * damping))
    z, most = 0j, 0.0
    for half, bent in _pieces(shape, omega):
        check_time()
        # z' = p z - s'': what a piece adds, seen from its left end
        back = np.exp(-p * half * (1.0 + X))
        added = -half * ((bent * back) @ _INTEGRALS.T)
        ahead = np.exp(p * half * (1.0 + _ENDS))
        whole, begins = complex(ahead[-1]), []
        for own in added[:, -1].tolist():
            begins.append(z)
            z = whole * (z + own)
        swing = ahead * (np.array(begins)[:, None] + added)
        r = swing.imag / p.imag
        load = 2.0 * p.real * (swing.real + p.real * r) - omega * omega * r
        most = _most(load, most)
    return most


def _pieces(shape: Shape, omega: float) -> Iterator[tuple[float, Array]]:
    """Half the width of equal pieces, and s'' at the nodes of each, as they follow each other.

    The panels are cut so that |p h| is at most REACH.
    """
    every = [
        (float(left), panels.half, panels.series[1, i])
        for panels in shape.panels
        for i, left in enumerate(panels.left)
    ]
    for _, half, series in sorted(every, key=lambda panel: panel[0]):
        count = max(1, math.ceil(omega * half / REACH))
        for start in range(0, count, BLOCK):
            places = np.arange(start, min(start + BLOCK, count))[:, None]
            yield half / count, legendre.legval((2.0 * places + 1.0 + X) / count - 1.0, series)


def _most(load: Array, most: float) -> float:
    """The greatest of |load|, given at the nodes and the right ends of pieces, between them too."""
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
