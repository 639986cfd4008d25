"""Nodes and weights of quadrature rules for smooth functions over [-1, 1].

>>> x, weight = rule(4)
>>> round(float(np.cos(x) @ weight - 2.0 * np.sin(1.0)), 6)
-0.0
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.arrays import read_only

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


def legendre(x: Array, degree: int) -> tuple[Array, Array]:
    """The Legendre polynomials of ``degree`` - 1 and ``degree`` at some places.

    >>> [float(p[0]) for p in legendre(np.array([0.5]), 2)]
    [0.5, -0.125]
    """
    before, here = np.ones(len(x)), x
    for k in range(2, degree + 1):
        before, here = here, ((2 * k - 1) * x * here - (k - 1) * before) / k
    return before, here


@cache
def rule(nodes: int) -> tuple[Array, Array]:
    """Nodes in [-1, 1] and weights of Gauss-Legendre quadrature, by Newton's method."""
    x = np.cos(np.pi * (np.arange(nodes) + 0.75) / (nodes + 0.5))
    for _ in range(6):
        before, here = legendre(x, nodes)
        slope = nodes * (before - x * here) / ((1.0 - x) * (1.0 + x))
        x = x - here / slope
    return read_only((x, 2.0 / ((1.0 - x) * (1.0 + x) * slope * slope)))


@cache
def lobatto(nodes: int) -> tuple[Array, Array]:
    """Nodes in [-1, 1], both ends included, and weights of Lobatto quadrature."""
    x = np.cos(np.pi * np.arange(nodes) / (nodes - 1))
    for _ in range(8):
        before, here = legendre(x, nodes - 1)
        x = x - (x * here - before) / (nodes * here)
    return read_only((x, 2.0 / (nodes * (nodes - 1) * here * here)))
