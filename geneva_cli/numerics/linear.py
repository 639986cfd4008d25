"""Small products and inverses of matrices, formed in one order of operations everywhere.

A library of linear algebra picks its kernels by the processor, and they round differently: what
reaches a file must not come from one, or the file is another on the next machine. Here every
product and sum is an elementwise one, whose rounding IEEE 754 fixes. (Sines and the like are not
fixed: NumPy has its own for each instruction set, AVX-512 or not, and they may differ in the last
place. The same bytes are promised within one instruction set.)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


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
    a, b, c, d = (matrix[..., i, k] for i in (0, 1) for k in (0, 1))
    whole = a * d - b * c
    out = np.empty(matrix.shape)
    for i, k, cofactor in ((0, 0, d), (0, 1, -b), (1, 0, -c), (1, 1, a)):
        out[..., i, k] = cofactor / whole
    return out
