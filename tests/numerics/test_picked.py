"""Records picked by their indices, against NumPy's own selection along an axis."""

import numpy as np
import pytest

from geneva_cli.numerics.arrays import picked

SHARED = [np.array([[10.0 * i]]) for i in range(3)]  # one number for all designs
OWN = [100.0 * i + np.arange(4.0)[:, None] for i in range(3)]  # one for each of four


@pytest.mark.parametrize("index", [[[0, 1], [1, 2], [2, 0], [1, 1]], [[2, 0, 1]]])
def test_shared_numbers_and_those_of_each_design(index):
    """Each design has its own row of indices, or all have one."""
    at = np.broadcast_to(index, (4, len(index[0])))
    shared, own = picked(np.array(index), list(zip(SHARED, OWN, strict=True)))
    for out, records in ((shared, SHARED), (own, OWN)):
        every = np.hstack([np.broadcast_to(one, (4, 1)) for one in records])
        expected = np.take_along_axis(every, at, axis=1)
        assert (np.broadcast_to(out, at.shape) == expected).all()


def test_one_design():
    """Its indices are a row, and its numbers floats or arrays of one."""
    floats, arrays = picked(np.array([2, 0, 2]), [(10.0 * i, SHARED[i]) for i in range(3)])
    assert floats.tolist() == np.ravel(arrays).tolist() == [20.0, 0.0, 20.0]
