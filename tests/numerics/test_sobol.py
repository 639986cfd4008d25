"""Sobol's sequence: what scrambling must keep. Sweeps test where a run may begin."""

import pytest

from geneva_cli.numerics.sobol import DIMENSIONS, sobol

COUNT = 1 << 10


@pytest.mark.parametrize("seed", range(3))
def test_scrambled_points_are_a_net(seed):
    """Each of 2^10 intervals of a dimension holds one point, and each 32nd by 32nd of two."""
    points = sobol(DIMENSIONS, seed, 3 * COUNT, COUNT)
    assert ((points >= 0.0) & (points < 1.0)).all()
    for row in points:
        assert sorted((row * COUNT).astype(int)) == list(range(COUNT))
    cells = (points[:2] * 32).astype(int)
    assert len({*zip(*cells, strict=True)}) == COUNT
