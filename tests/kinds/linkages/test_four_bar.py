"""A four-bar's coupler point as the roller: the worked reference, to 1e-12.

Links 0.4 : 0.9 : 1 : 1, four slots, no jump of acceleration; theory notes, section 1.10, computed
there with 30 digits. The path has an inflection at entry and at exit, so the index angle is
stationary there and the wheel's place a double root: the hardest case of the search for it.
"""

import math

import pytest
from machine_witness import linkage
from witness import mp, taylor, to_radians
from words import Drive, Keys, Spec, Wheel

from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import worst

BAC = "-36.1383650809511319485453673973"
AC = "1.61519035738111650432595895942"
CENTRE = ("1.14644162513233726498142836109", "0.337480916011512068593513708021")
ENTRY = "123.280444366252671024478759691"  # and exit at 360 less this
FIRST = "8.86163491904886805"  # direction of the first slot from the wheel's centre, degrees
UNIT = 100.0  # mm


@pytest.fixture(scope="module")
def machine():
    keys = Keys(
        "four-bar",
        0.4 * UNIT,
        0.9 * UNIT,
        UNIT,
        UNIT,
        float(AC) * UNIT,
        float(BAC),
        entry_deg=123.28,
    )
    return build(Spec(Wheel(4), Drive("four-bar"), keys))


@pytest.fixture(scope="module")
def engagement(machine):
    return machine.engagements[0]


def test_the_motion_angle(engagement):
    whole = 360.0 - 2.0 * float(ENTRY)
    assert engagement.motion_deg == pytest.approx(whole, rel=1e-12)
    assert (engagement.entry_deg, engagement.exit_deg) == pytest.approx(
        (-whole / 2, whole / 2), rel=1e-12
    )


def test_the_wheel_stands_where_the_reference_has_it(machine, engagement):
    x, y = (float(c) * UNIT for c in CENTRE)
    L = math.hypot(x, y)
    assert machine.center_distance_mm == pytest.approx(L, rel=1e-12)
    # Slots at entry and exit, from the fixed x axis; ours are from the line of centres.
    line = math.degrees(math.atan2(-y, -x))
    for deg, want in (
        (engagement.entry_deg, float(FIRST)),
        (engagement.exit_deg, float(FIRST) + 90.0),
    ):
        px, py = (c.c[0] for c in engagement.path(deg, 1))
        at = math.degrees(math.atan2(py, px)) + line
        assert math.remainder(at - want, 360.0) == pytest.approx(0.0, abs=1e-10)  # 1e-12 rad


def test_peaks(engagement, machine):
    found = worst(machine)
    assert found.velocity.max == pytest.approx(float("3.3051512042012370683"), rel=1e-12)
    assert found.velocity.at_deg == pytest.approx(0.0, abs=1e-9)
    assert found.acceleration.max == pytest.approx(10.680, abs=5e-4)
    assert found.ends.acceleration_entry <= 1e-12
    assert found.ends.acceleration_exit <= 1e-12
    assert found.ends.jerk_entry == pytest.approx(float("0.34262026316054502292"), rel=1e-12)


class Exact:
    """The reference's keys in all their digits; the arm's angle is added where it is used."""

    crank_mm, ground_mm, coupler_mm, rocker_mm = "0.4", "0.9", "1", "1"
    point_mm, point_deg, branch = AC, 0.0, "+"


def test_the_whole_curve(engagement):
    """Against the reference's own geometry, which no search has touched."""
    path, centre = linkage("four-bar", Exact), mp.mpc(*CENTRE)
    arm = mp.expj(mp.mpf(BAC) * mp.pi / 180)

    def pin(phi):
        A = mp.mpf(Exact.crank_mm) * mp.expj(phi)
        return A + (path(phi) - A) * arm - centre

    for t in (-0.98, -0.7, -0.33, -0.05, 0.0, 0.21, 0.5, 0.9):
        x = t * engagement.exit_deg
        psi = taylor(lambda p: mp.arg(pin(mp.pi + p)), to_radians(x), 3)
        psi[0] -= (mp.mpf(FIRST) + 45) * mp.pi / 180
        for value, want in zip(engagement.motion(x).derivatives(), psi, strict=True):
            assert value == pytest.approx(float(want), rel=1e-12, abs=2e-12)
