"""A sample of `make stress`: some machines of every kind, laws and drives from the registries."""

import math

import pytest
from exact.fronts import SideCrank
from exact.others import HARD, other_one, read
from exact.rates import DIGITS
from exact.straight import Straight
from exact.table import LIMIT, Table
from stress import fill, missing, parts
from witness import Geneva, mp

PARTS = parts(sample=True)


@pytest.mark.sampled(48)
@pytest.mark.parametrize("name", PARTS)
def test_sample(name):
    table = Table()
    fill(table, PARTS[name], sample=True)
    assert not table.faults
    assert table.count > 10
    over = {row: w for row, w in table.rows.items() if not w.share <= LIMIT}
    assert not over


def test_a_point_much_slower_than_its_links():
    """Its links' rounding is 17 times its own: the manual's page accuracy."""
    for text in HARD:
        table = Table()
        with mp.workdps(DIGITS // 2):
            other_one(table, "four-bar", text, read(text), sample=True)
        assert max(w.share for w in table.rows.values()) <= 2.5 * LIMIT


def test_every_kind_has_a_witness():
    assert not missing()


def test_the_table_can_tell():
    table = Table()
    table.add(("crank", "jerk"), [LIMIT + 1.0, 1.0], 1.0, "here")
    table.add(("crank", "power"), [math.nan, 1.0], 1.0, "there")
    table.add(("crank", "velocity"), [LIMIT + 1.0], 2.0, "there")
    assert [*table.over] == [("crank", "jerk"), ("crank", "power")]


def test_two_witnesses_agree():
    """This one goes by cumulants of log Q and a front's own way back; the other one does not."""
    with mp.workdps(DIGITS):
        for gearing in ("external", "internal"):
            one = Straight(5, gearing, "side-crank", (0.75,))
            other = Geneva(5, gearing, 0.75)
            assert abs(one.ends[1] - other.half_motion) < mp.mpf(10) ** -100
            for t in (0.0, 0.3, 0.9):
                x = one.ends[1] * t
                for a, b in zip(one.at(x), other.at(x), strict=False):
                    assert abs(a - b) < mp.mpf(10) ** -90
    assert SideCrank.few
