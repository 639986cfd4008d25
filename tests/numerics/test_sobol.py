"""Sobol's sequence against SciPy's, and what scrambling must keep."""

import numpy as np
import pytest
from scipy.stats import qmc

from geneva_cli.numerics.sobol import DIGITS, DIRECTIONS, Sobol, _numbers

COUNT = 1 << 10


def test_without_scrambling_the_points_are_those_of_scipy():
    """SciPy has them in another order (Gray's code), which is the same in each power of two."""
    weights = 1 << np.arange(DIGITS - 1, -1, -1)
    directions = np.array([weights * _numbers(*row) for row in DIRECTIONS])
    sequence = Sobol(directions, np.zeros((len(DIRECTIONS), 1), dtype=np.int64))
    theirs = qmc.Sobol(len(DIRECTIONS), scramble=False, bits=DIGITS)
    for start in (0, COUNT):
        ours = sequence.points(start, COUNT)
        assert {*map(tuple, ours.T)} == {*map(tuple, theirs.random(COUNT))}


@pytest.mark.parametrize("seed", range(3))
def test_scrambled_points_are_a_net(seed):
    """Each of 2^10 intervals of a dimension holds one point, and each 32nd by 32nd of two."""
    points = Sobol.scrambled(len(DIRECTIONS), seed).points(3 * COUNT, COUNT)
    assert ((points >= 0.0) & (points < 1.0)).all()
    for row in points:
        assert sorted((row * COUNT).astype(int)) == list(range(COUNT))
    cells = (points[:2] * 32).astype(int)
    assert len({*zip(*cells, strict=True)}) == COUNT
