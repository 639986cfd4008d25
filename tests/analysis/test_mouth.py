"""A roller that meets its mouth's corner: by the corner's and the roller's motions at 50 digits."""

import math

import mpmath
import numpy as np
import pytest
from witness import mp
from words import Spec, Wheel

from geneva_cli import Design, External, SideCrank
from geneva_cli.analysis.mouth import mouth_contacts
from geneva_cli.machine.mechanism import build


def witness(z, error, roller, clearance, rate):
    """Where the roller is its radius away from the corner, and how fast that turns the wheel.

    The corner is the one that an arm too long (``error`` > 0) or too short comes to.

    The crank's axis is the origin, the slot's axis x = R, inwards upwards; the wheel's axis is
    (R, far). What the wheel must turn for the corner to keep its distance is differentiated.
    """
    with mpmath.workdps(50):
        R, far = mp.sin(mp.pi / z), mp.cos(mp.pi / z)
        arm, wide = R * (1 + mp.mpf(error)), mp.mpf(roller) + clearance

        def distance(turn, wheel):
            x, y = arm * mp.cos(turn), arm * mp.sin(turn)
            cx, cy = mp.sign(error) * wide, -far  # of the corner, seen from the wheel's axis
            c, s = mp.cos(wheel), mp.sin(wheel)
            return mp.hypot(x - R - c * cx + s * cy, y - far - s * cx - c * cy)

        early = mp.findroot(lambda t: distance(t, 0) - roller, -mp.sqrt(2 * roller * abs(error)))
        by_turn = mp.diff(distance, (early, 0), (1, 0))
        by_wheel = mp.diff(distance, (early, 0), (0, 1))
        return early, rate * by_turn / by_wheel  # > 0: against the crank, as such a wheel indexes


@pytest.mark.parametrize("gearing", ["external", "internal"])
@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize(
    ("z", "error", "roller", "clearance"),
    [(6, 1e-4, 0.05, 0.0), (3, 1e-3, 0.1, 5e-4), (12, 1e-6, 0.02, 0.0)],
)
def test_the_corner_s_and_the_roller_s_motions(gearing, z, error, roller, clearance, sign):
    """The mouth of an internal wheel is the same; it runs off the other way. 1e-9: 2r is near 2w"""
    [engagement] = build(Spec(Wheel(z, gearing))).engagements
    found = mouth_contacts(engagement, sign * error, 0.0, roller, clearance)
    early, jump = witness(z, sign * error, roller, clearance, 1)
    assert found.jump[0] == pytest.approx(float(jump), rel=1e-9)
    at = engagement.entry_deg + math.degrees(float(early))
    assert found.at_deg[0] == pytest.approx(at, abs=1e-9)


@pytest.mark.parametrize("sign", [-1, 1])
def test_to_first_order_it_is_a_root_too(sign):
    [engagement] = build(Spec(Wheel(6))).engagements
    short = np.array([[1e-6], [1e-8], [1e-10]])
    found = mouth_contacts(engagement, sign * short, 0.0, 0.05, 0.0).jump
    first = (
        math.tan(math.pi / 6) * np.sqrt(2.0 * short[:, 0]) * math.sqrt((0.5 + sign * 0.05) / 0.05)
    )
    assert found == pytest.approx(-sign * first, rel=2e-3)
    assert found[2] == pytest.approx(-sign * first[2], rel=2e-5)
    # a centre distance too long by a share is an arm too short by it, to first order
    assert mouth_contacts(engagement, 0.0, -sign * 1e-8, 0.05, 0.0).jump == pytest.approx(
        found[1], rel=1e-5
    )


def test_a_quick_crank_strikes_as_much_harder():
    """A side-crank's arm turns at its own rate as it enters."""
    [engagement] = Design(External(6), SideCrank(A=0.6)).mechanism.engagements
    rate = abs(engagement.carrier(engagement.entry_deg).c[0])
    found = mouth_contacts(engagement, -1e-4, 0.0, 0.05, 0.0)
    assert found.jump[0] == pytest.approx(float(witness(6, -1e-4, 0.05, 0.0, rate)[1]), rel=1e-9)


def test_with_room_it_meets_nothing():
    [engagement] = build(Spec(Wheel(6))).engagements
    assert np.isnan(mouth_contacts(engagement, -1e-4, 0.0, 0.05, 1e-4).jump[0])
    assert np.isnan(mouth_contacts(engagement, 1e-4, 0.0, 0.05, 1e-4).jump[0])
    assert np.isnan(mouth_contacts(engagement, 0.0, 0.0, 0.05, 0.0).jump[0])
    [sphere] = build(Spec(Wheel(6, "spherical"))).engagements
    assert mouth_contacts(sphere, -1e-4, 0.0, 0.05, 0.0) is None
