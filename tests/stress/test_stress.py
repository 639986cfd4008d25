"""A sample of `make stress`: some machines of every kind, laws and drives from the registries."""

import math

import pytest
from exact.cases import HARD
from exact.machines import compare_machine, read
from exact.table import DIGITS, LIMIT, Table
from stress import fill, missing, parts
from witness import mp

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


@pytest.mark.long
def test_a_point_much_slower_than_its_links():
    """Its links' rounding is 17 times its own: the manual's page accuracy."""
    for text in HARD:
        table = Table()
        with mp.workdps(DIGITS // 2):
            compare_machine(table, "four-bar", text, read(text), sample=True)
        assert max(w.share for w in table.rows.values()) <= 2.5 * LIMIT


def test_every_kind_has_a_witness():
    assert not missing()


def test_the_table_can_tell():
    table = Table()
    table.add(("crank", "jerk"), [LIMIT + 1.0, 1.0], 1.0, "here")
    table.add(("crank", "power"), [math.nan, 1.0], 1.0, "there")
    table.add(("crank", "velocity"), [LIMIT + 1.0], 2.0, "there")
    assert [*table.over] == [("crank", "jerk"), ("crank", "power")]
