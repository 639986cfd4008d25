"""Small systems of linear equations, solved in one order of operations everywhere.

A library of linear algebra picks its kernels by the processor, and they round differently: what
reaches a file must not come from one, or the file is another on the next machine. Here every
product and sum is an elementwise one, whose rounding IEEE 754 fixes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.jet import Array


def product(a: Array, b: Array) -> Array:
    """The products of matrices (..., n, k) and (..., k, m), in stacks."""
    out: Array = a[..., :, 0, None] * b[..., None, 0, :]
    for k in range(1, a.shape[-1]):
        out = out + a[..., :, k, None] * b[..., None, k, :]
    return out


def gram(shape: Array, other: Array) -> Array:
    """The products of transposed matrices (..., k, n) with (..., k, m), where k may be large."""
    out: Array = (shape[..., :, None] * other[..., None, :]).sum(axis=-3)
    return out


def inverse2(matrix: Array) -> Array:
    """The inverses of 2 x 2 matrices in a stack (..., 2, 2); not finite where there is none."""
    (a, b), (c, d) = np.moveaxis(matrix, (-2, -1), (0, 1))
    adjugate = np.stack([np.stack([d, -b], -1), np.stack([-c, a], -1)], -2)
    out: Array = adjugate / (a * d - b * c)[..., None, None]
    return out


def solve(matrix: Array, right: Array) -> Array:
    """The solution of one n x n system for a right side (n,) or several (n, m).

    Gaussian elimination with partial pivoting, for some ten unknowns. Raises ZeroDivisionError
    where a pivot is zero.
    """
    n = len(matrix)
    wide = np.column_stack((matrix, right)).astype(float)
    for i in range(n):
        best = i + int(np.argmax(np.abs(wide[i:, i])))
        if wide[best, i] == 0.0:
            raise ZeroDivisionError("a matrix without an inverse")
        wide[[i, best]] = wide[[best, i]]
        wide[i + 1 :] -= (wide[i + 1 :, i] / wide[i, i])[:, None] * wide[i]
    for i in reversed(range(n)):
        wide[i] /= wide[i, i]
        wide[:i] -= wide[:i, i, None] * wide[i]
    out: Array = wide[:, n:].reshape(np.shape(right))
    return out


def solve_banded(rows: list[list[float]], width: int, right: list[list[float]]) -> None:
    """Solve a banded system without pivoting, in place; the solution is left in ``right``.

    ``rows[i]`` holds the elements (i, i - width) to (i, i + width), zeros where there are none;
    ``right[i]`` the i-th elements of the right sides. Pivoting is not needed where the matrix is
    totally positive, as of B-splines, or diagonally dominant (C. de Boor and A. Pinkus, 1977).
    """
    n = len(rows)
    for i in range(n):
        pivot, mine = rows[i], right[i]
        for j in range(i + 1, min(i + width + 1, n)):
            row, at = rows[j], width - (j - i)
            share = row[at] / pivot[width]
            if share == 0.0:
                continue
            for k in range(1, width + 1):
                row[at + k] -= share * pivot[width + k]
            right[j] = [x - share * y for x, y in zip(right[j], mine, strict=True)]
    for i in reversed(range(n)):
        row, values = rows[i], right[i]
        for k in range(1, min(width, n - 1 - i) + 1):
            if row[width + k] != 0.0:
                known = right[i + k]
                values = [x - row[width + k] * y for x, y in zip(values, known, strict=True)]
        right[i] = [x / row[width] for x in values]
