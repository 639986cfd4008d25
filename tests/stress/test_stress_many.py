"""A sample of tests/stress/stress_many.py: some designs of every machine."""

import pytest
from design_arrays import MACHINES
from stress_many import stressed

from geneva_cli.numerics import extremes


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", MACHINES)
def test_none_is_missed(name):
    row = stressed(name, 60, witnessed=0)
    assert (row.designs, row.missed) == (60, 0)


def test_it_can_tell(monkeypatch):
    """A search that takes no step from its samples falls short of peaks, and is found out."""
    monkeypatch.setattr(extremes, "_turn", lambda value, point: extremes.POINTS[point])
    monkeypatch.setattr(extremes, "_REACH", 0.0 * extremes._REACH)
    row = stressed("elliptical gears", 200, witnessed=0)
    assert row.missed > 0
    assert row.short > 1e-4
