"""Sobol's sequence, scrambled: points that fill a cube more evenly than random ones."""

from geneva_cli.numerics.arrays import Array

DIGITS = 32  # of a coordinate: SciPy cannot begin later in a sequence of more
DIMENSIONS = 32  # few points fill no larger cube evenly


def sobol(dimensions: int, seed: int, start: int, count: int) -> Array:
    """Coordinates between 0 and 1 of points from ``start`` on: (dimensions, count).

    They are those of ``scipy.stats.qmc``, the same ones for the same seed, wherever a run begins.
    ``count`` is a power of two, and ``start`` a multiple of it.
    """
    from scipy.stats import qmc  # as slow to import as a short run

    sequence = qmc.Sobol(dimensions, bits=DIGITS, rng=seed)
    if start:
        sequence.fast_forward(start)
    points: Array = sequence.random(count).T + 0.5 ** (DIGITS + 1)  # the middle of a digit, not 0
    return points
