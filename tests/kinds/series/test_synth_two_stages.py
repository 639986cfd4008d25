"""Gear sectors and first wheels among the machines of a wish, against formulas of their own."""

import math

import mpmath
import pytest

from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search

NEAR = "0.1"  # joints so near to the crank that the search of four-bars is short


def of_kind(kind, **options):
    rows = search(read_target(space=NEAR, **options))
    return [row for row in rows if row.cells["drive"] == kind]


def sector(z, motion_deg):
    """The crank angle in gear, degrees, from both conditions in 50 digits."""
    with mpmath.workdps(50):
        motion, step = mpmath.radians(motion_deg), 2 * mpmath.pi / z

        def driven(b):  # by the gears, of the step: u D = step - 2b
            l = mpmath.sin(b)
            return l / (1 - l) * (motion - mpmath.pi + 2 * b) - step + 2 * b

        b = mpmath.findroot(driven, (step / 100, step / 2), solver="anderson")
        return float(mpmath.degrees(motion - mpmath.pi + 2 * b))


@pytest.mark.long
@pytest.mark.parametrize(("z", "motion"), [(3, 61.0), (24, 300.0)])
def test_gear_sectors_move_for_as_long_as_wished(z, motion):
    (row,) = of_kind("gear-sector", motion_deg=str(motion), z=str(z))
    # as exact as the step, of which what the slots leave is a part of some thousandths at worst
    assert row.cells["sector_deg"] == pytest.approx(sector(z, motion), rel=1e-12)
    assert row.cells["motion_deg"] == pytest.approx(motion, rel=1e-13)


@pytest.mark.long
@pytest.mark.parametrize(("z", "most"), [(6, 3), (7, 2)])
def test_first_wheels_for_a_small_share_of_the_cycle(z, most):
    """Of the second crank's half motion f the first crank makes asin(sin f / sin b) - f, where the
    first wheel's half step b reaches it.
    """
    found = of_kind("geneva-pair", tau="..0.4", z=str(z), cycle="3")
    assert sorted(row.cells["first_z"] for row in found) == [*range(3, most + 1)]
    f = math.pi / 2 - math.pi / z
    for one in (row.cells for row in found):
        sine = math.sin(f) / math.sin(math.pi / one["first_z"])
        tau = (math.asin(min(sine, 1.0)) - f) / math.pi / one["first_z"]
        # an arcsine near 1 is known to the root of a rounding
        assert one["tau"] == pytest.approx(tau, rel=1e-7)
        assert one["motion_s"] + one["dwell_s"] == pytest.approx(3.0, rel=1e-12)
