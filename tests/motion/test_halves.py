"""A motion of which one half is searched: its second half is the mirror image of its first."""

import math
from functools import cache

import numpy as np
import pytest
from witness import mp

from geneva_cli import Design, External, Motion, NoncircularGears, SineGroup
from geneva_cli.design import Size
from geneva_cli.motion.many import many, worst_peaks
from geneva_cli.motion.peaks import worst
from geneva_cli.parts.slots.slot_profile import chord_errors, nodes

SWING = 0.3  # of the ratio 1 + SWING sin 6 phi


def test_a_tilted_law_is_not():
    """s(u) = 1/2 by mpmath, from the closed form of s."""

    def s(u):
        x = mp.pi * u
        even = x - 2 * mp.sin(2 * x) / 3 + mp.sin(4 * x) / 12
        return (even - mp.mpf(64) / 15 * mp.mpf(0.1) * mp.sin(x) ** 5) / mp.pi

    wanted = float(mp.findroot(lambda u: s(u) - mp.mpf(0.5), 0.6))
    assert SineGroup(0.1).half_way == pytest.approx(wanted, abs=2e-16)


@cache
def gears():
    """A ratio that is not even, and yet turns the crank as far before mid-motion as after it."""
    degrees = np.arange(0.0, 361.0)
    ratio = 1.0 + SWING * np.round(np.sin(np.radians(6.0 * (degrees % 60.0))), 6)
    ratio[::30] = 1.0
    return NoncircularGears(ratio=tuple(zip(degrees.tolist(), ratio.tolist(), strict=True)))


def greatest(size):
    """The greatest of a function of the input angle, radians, within a third of a turn; mpmath."""
    places = [mp.pi / 3 * k / 600 for k in range(-600, 601)]
    top = max(range(1, 1200), key=lambda k: abs(size(places[k])))
    a, b = places[top - 1], places[top + 1]
    for _ in range(80):  # by thirds
        third = (b - a) / 3
        a, b = (a + third, b) if abs(size(a + third)) < abs(size(b - third)) else (a, b - third)
    return float(abs(size(a))), math.degrees(a)


@pytest.mark.long
@pytest.mark.parametrize("quantity", ["velocity", "acceleration", "jerk"])
def test_peaks_behind_a_ratio_that_is_not_even(quantity):
    """The wheel's angle in closed form: both ends lie 60 degrees from mid-motion, all the same."""
    order = ("velocity", "acceleration", "jerk").index(quantity) + 1
    swing = mp.mpf(SWING)

    def angle(x):
        crank = x + swing / 6 * (1 - mp.cos(6 * x))
        return mp.atan2(mp.sin(crank) / 2, 1 - mp.cos(crank) / 2)

    size, at_deg = greatest(lambda x: mp.diff(angle, x, order))
    design = Design(External(6), gears())
    engagement = design.mechanism.engagements[0]
    # the spline of the crank's angle is known to some units in the last place of a turn
    ends = engagement.entry_deg, engagement.exit_deg
    assert ends == pytest.approx((-60.0, 60.0), rel=0, abs=1e-12)
    found = getattr(worst(design.mechanism), quantity)
    # the ratio is given to six decimals, a degree apart
    assert found.max == pytest.approx(size, rel=1e-4)
    assert found.at_deg == pytest.approx(at_deg, abs=0.01)
    batch = many(design.mechanism.spec, {"drive.n_rpm": np.array([60.0, 90.0])}).machine
    assert worst_peaks(batch, [quantity])[quantity].max == pytest.approx(found.max, rel=4e-15)


@pytest.mark.long
def test_a_curved_slot_behind_such_a_ratio_has_two_branches_of_its_own():
    """The law is symmetric; the crank's way out is not the mirror image of its way in."""
    law, size = Motion(SineGroup(), ratio="matched"), Size(roller_radius_mm=2.0)
    design = Design(External(6), gears(), law, size=size)
    uneven = design.mechanism
    assert uneven.engagements[0].motion.symmetric
    for tolerance in (1e-2, 1e-4):
        x = nodes(uneven, tolerance)
        assert chord_errors(uneven, x).max() <= tolerance
        assert 0.0 in x
