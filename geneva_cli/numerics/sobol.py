"""Sobol's sequence, scrambled: points that fill a cube more evenly than random ones.

A random lower triangular matrix and a shift scramble the digits (Matousek, J. Complexity 14, 1998).
SciPy's takes three times as long to import as a short run.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array, Whole

DIGITS = 53  # of a double
# Inner coefficients of the primitive polynomial as a number, and the first direction numbers: Joe
# and Kuo, SIAM J. Sci. Comput. 30, 2008, 2635-2654, dimensions 1 to 32. The first has none.
_TABLE = """
0 1 / 1 1 3 / 1 1 3 1 / 2 1 1 1 / 1 1 1 3 3 / 4 1 3 5 13 / 2 1 1 5 5 17 / 4 1 1 5 5 5 /
7 1 1 7 11 19 / 11 1 1 5 1 1 / 13 1 1 1 3 11 / 14 1 3 5 5 31 / 1 1 3 3 9 7 49 /
13 1 1 1 15 21 21 / 16 1 3 1 13 27 49 / 19 1 1 1 15 7 5 / 22 1 3 1 15 13 25 / 25 1 1 5 5 19 61 /
1 1 3 7 11 23 15 103 / 4 1 3 7 13 13 15 69 / 7 1 1 3 13 7 35 63 / 8 1 3 5 9 1 25 53 /
14 1 3 1 13 9 35 107 / 19 1 3 1 5 27 61 31 / 21 1 1 5 11 19 41 61 / 28 1 3 5 3 3 13 69 /
31 1 1 7 13 1 19 1 / 32 1 3 7 5 13 19 59 / 37 1 1 3 9 25 29 41 / 41 1 3 5 13 23 1 55 /
42 1 3 7 3 13 59 17
"""
DIRECTIONS = [[0], *([*map(int, row.split())] for row in _TABLE.split("/"))]


class Sobol(NamedTuple):
    """Points in a cube; each dimension has the digits of its 53 directions and of its shift."""

    directions: Whole  # (dimensions, 53)
    shift: Whole  # (dimensions, 1)

    @staticmethod
    def scrambled(dimensions: int, seed: int) -> Sobol:
        """Points in a cube of at most 32 dimensions; the same ones for the same seed."""
        rng = np.random.default_rng(seed)
        weights = 1 << np.arange(DIGITS - 1, -1, -1)
        # a column of each matrix: the digit itself, and random digits below it
        columns = rng.integers(1 << DIGITS, size=(dimensions, DIGITS)) % weights | weights
        directions = np.zeros((dimensions, DIGITS), dtype=np.int64)
        for row, matrix, numbers in zip(directions, columns, DIRECTIONS, strict=False):
            plain = weights * _numbers(*numbers)
            for column, weight in zip(matrix, weights, strict=True):
                row ^= np.where(plain & weight, column, 0)
        return Sobol(directions, rng.integers(1 << DIGITS, size=(dimensions, 1)))

    def points(self, start: int, count: int) -> Array:
        """Coordinates in 0..1 of points from ``start`` on: (dimensions, count).

        ``count`` is a power of two, and ``start`` a multiple of it.
        """
        digits = self.shift.copy()
        for k in range(DIGITS):
            if start >> k & 1:
                digits ^= self.directions[:, k : k + 1]
        for k in range(count.bit_length() - 1):
            digits = np.hstack((digits, digits ^ self.directions[:, k : k + 1]))
        return digits.astype(float) * 0.5**DIGITS


def _numbers(polynomial: int, *first: int) -> Whole:
    """Direction numbers of one dimension, by the recurrence of its polynomial."""
    degree, numbers = len(first), list(first or [1] * DIGITS)
    while len(numbers) < DIGITS:
        last = numbers[-degree]
        last ^= last << degree
        for k in range(1, degree):
            if polynomial >> degree - 1 - k & 1:
                last ^= numbers[-k] << k
        numbers.append(last)
    return np.array(numbers)
