"""A sample of tests/stress/stress_many.py: some designs of every machine."""

import pytest
import stress_many
from design_arrays import MACHINES
from stress_many import stressed


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", MACHINES)
def test_none_is_missed(name):
    row = stressed(name, 60, witnessed=0)
    assert (row.designs, row.missed) == (60, 0)


def test_it_can_tell(monkeypatch):
    """Peaks that are a hundredth too small are found out."""
    search = stress_many.motion_peaks

    def low(*arguments):
        return {n: p._replace(max=0.99 * p.max) for n, p in search(*arguments).items()}

    monkeypatch.setattr(stress_many, "motion_peaks", low)
    row = stressed("spherical", 60, witnessed=0)
    assert row.missed == 60
    assert row.short > 1e-3
