"""A sample of `make stress`: some machines of every kind, laws and drives from the registries."""

import math

import pytest
import stress_many
from design_arrays import MACHINES
from exact.table import LIMIT, Table
from stress import fill, missing, parts

PARTS = parts(sample=True)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", PARTS)
def test_sample(name):
    table = Table()
    fill(table, PARTS[name], sample=True)
    assert not table.faults
    assert table.count > 10
    over = {row: w for row, w in table.rows.items() if not w.share <= LIMIT}
    assert not over


def test_every_kind_has_a_witness():
    assert not missing()


def test_the_table_can_tell():
    table = Table()
    table.add(("crank", "jerk"), [LIMIT + 1.0, 1.0], 1.0, "here")
    table.add(("crank", "power"), [math.nan, 1.0], 1.0, "there")
    table.add(("crank", "velocity"), [LIMIT + 1.0], 2.0, "there")
    assert [*table.over] == [("crank", "jerk"), ("crank", "power")]


# Peaks of many designs


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", MACHINES)
def test_none_is_missed(name):
    row = stress_many.stressed(name, 60, witnessed=0)
    assert (row.designs, row.missed) == (60, 0)


def test_it_can_tell(monkeypatch):
    """Peaks that are a hundredth too small are found out."""
    search = stress_many.motion_peaks

    def low(*arguments):
        return {n: p._replace(max=0.99 * p.max) for n, p in search(*arguments).items()}

    monkeypatch.setattr(stress_many, "motion_peaks", low)
    row = stress_many.stressed("spherical", 60, witnessed=0)
    assert row.missed == 60
    assert row.short > 1e-3
