"""A sample of tests/stress/stress_many.py: some designs of every machine."""

import numpy as np
import pytest
from design_arrays import MACHINES
from stress_many import stressed

from geneva_cli.numerics import extrema


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", MACHINES)
def test_none_is_missed(name):
    row = stressed(name, 60, witnessed=0)
    assert (row.designs, row.missed) == (60, 0)


def test_it_can_tell(monkeypatch):
    """A scan of two intervals that never looks again steps over peaks, and is found out."""
    monkeypatch.setattr(extrema, "SCAN_INTERVALS", 2)
    monkeypatch.setattr(extrema, "unpredicted", lambda left, *_: np.zeros(left[0].shape, bool))
    row = stressed("spherical, slowed", 200, witnessed=0)
    assert row.missed > 0
    assert row.short > 1e-3
