"""[Handbook] Methodical handbook no. 7, section "Maltese mechanisms" (Russian).

Its formulas are lost; these are its statements, and what is wrong in three of them.
"""

import math
from fractions import Fraction

import numpy as np
import pytest
from witness import near

from geneva_cli.errors import GenevaError
from geneva_cli.motion.timing import timings

Z = range(3, 25)


@pytest.mark.parametrize(
    ("z", "limit", "most"),
    [(3, Fraction(6), 5), (4, Fraction(4), 3), (5, Fraction(10, 3), 3), (6, Fraction(3), 2)],
)
def test_rollers(machine, z, limit, most):
    """m0 = 2z/(z-2) = 6, 4, 10/3, 3, and m < m0 strictly: 5, 3, 3, 2 rollers."""
    assert Fraction(2 * z, z - 2) == limit
    assert machine(z).rollers_max == most == math.ceil(limit) - 1
    assert timings(machine(z, rollers=most))[0].dwell_deg > 0.0
    with pytest.raises(GenevaError, match="jam"):
        machine(z, rollers=most + 1)


def test_rollers_of_more_slots_and_inside(machine):
    assert [machine(z).rollers_max for z in range(6, 25)] == [2] * 19
    assert [machine(z, "internal").rollers_max for z in Z] == [1] * 22
    with pytest.raises(GenevaError, match="at most 1"):
        machine(6, "internal", rollers=2)


def test_share_of_the_motion_runs_from_1_6_to_11_24(machine):
    shares = [timings(machine(z))[0].tau for z in Z]
    assert shares == sorted(shares)
    assert shares[0] == near(1 / 6, 4e-16)
    assert shares[-1] == near(11 / 24, 4e-16)


@pytest.mark.parametrize("z", Z)
def test_slot_and_crank_stand_at_right_angles_only_at_the_ends(engagement, z):
    """The handbook: the angle O1 A O2 is always pi/2. It is so at entry and exit, never between."""
    s = engagement(z)

    def cosine(deg):
        x, y = (v.c[0] for v in s.path(deg, 0))
        return (x * (x - 1.0) + y * y) / (math.hypot(x, y) * math.hypot(x - 1.0, y))

    for deg in (s.entry_deg, s.exit_deg):
        assert cosine(deg) == pytest.approx(0.0, abs=1e-15)
    for share in (0.99, 0.5, 0.1, 0.0, -0.3, -0.9):
        assert cosine(share * s.entry_deg) < -1e-3


@pytest.mark.parametrize("gearing", ["external", "internal"])
@pytest.mark.parametrize("z", [3, 4, 6, 24])
def test_soft_shock_at_entry(engagement, gearing, z):
    """The handbook: the roller's velocity against the cross is zero at entry.

    Only its part across the slot is, so the wheel starts from rest; along the slot it is R w.
    """
    s = engagement(z, gearing)
    for deg, sign in ((s.entry_deg, -1.0), (s.exit_deg, 1.0)):
        x, y = s.path(deg, 1)
        position, velocity = np.array([x.c[0], y.c[0]]), np.array([x.c[1], y.c[1]])
        ray = position / np.hypot(*position)
        along, across = ray @ velocity, ray[0] * velocity[1] - ray[1] * velocity[0]
        inward = sign if gearing == "external" else -sign  # an internal slot is entered outwards
        assert along == near(inward * math.sin(math.pi / z), 1e-15)
        # 3e-16: two products of sizes below 1, each rounded
        assert across == pytest.approx(0.0, abs=3e-16)
        assert s.motion(deg).derivatives()[1] == 0.0


def gap(engagement, deg):
    """Angle by which the pin leads the slot's own mid line, in the wheel: 0 for a straight slot."""
    x, y = engagement.slot(deg, 0)
    return np.degrees(np.arctan2(y.c[0], x.c[0]))


def test_not_almost_any_law_for_one_curved_slot(engagement):
    """The handbook: curved slots give almost any law. But in and out must use one track.

    The pin passes each radius twice, at input angles -x and x, and meets one track only where the
    slot leads by the same angle both times. 6 slots, 120 degrees, R/L = 1/2: largest lead, degrees.
    """
    x = np.linspace(-60.0, 0.0, 4001)
    for law, least, greatest in (
        ("cycloidal", 0.0, 0.817),
        ("3-4-5", -0.566, 0.375),
        ("sine-group", 0.0, 4.566),
    ):
        s = engagement(6, law=law)
        lead, lag = gap(s, x), gap(s, -x)
        assert lead == pytest.approx(-lag, abs=1e-13)  # odd: two tracks, mirror images
        assert np.max(lead) == pytest.approx(greatest, abs=6e-4)  # three digits, and the grid
        assert np.min(lead) == pytest.approx(least, abs=6e-4)
    assert np.all(gap(engagement(6, law="harmonic"), x[1:-1]) < 0.0)
    straight = engagement(6)
    assert np.all(gap(straight, x) == 0.0)
