"""Offset slots up to the limit of their validity, |e| = cos² b, where one end's gap closes.

The promise of test_machines.py, with the condition number computed: what one unit in the last
place of the input angle, or of ``offset_mm``, moves.
"""

import math

import pytest
from exact.machines import compare_machine, read
from exact.table import DIGITS, LIMIT, Table
from witness import mp

NEAR = (1e-4, 1e-9)  # much nearer, peaks lie between two doubles of the input angle


def spec(z, offset):
    return f"wheel = {{z = {z}, offset_mm = {offset!r}}}"


def limit(z):
    return 100.0 * math.cos(math.pi / z) ** 2


@pytest.mark.long
@pytest.mark.parametrize("z, side", [(3, -1.0), (5, 1.0), (24, -1.0), (10**6, 1.0)])
def test_near_the_limit(z, side):
    table = Table()
    with mp.workdps(DIGITS // 2):
        for gap in NEAR:
            text = spec(z, side * (1.0 - gap) * limit(z))
            compare_machine(table, "offset", text, read(text), sample=True)
    assert table.count > 100
    assert not table.over, LIMIT


def test_the_limit_itself_is_refused():
    for z in (3, 4, 6):  # 25, 50 and 75 mm are doubles
        assert read(spec(z, math.nextafter(round(limit(z)), 0.0)))
        assert read(spec(z, float(round(limit(z))))) is None
