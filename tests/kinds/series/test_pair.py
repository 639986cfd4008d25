"""Two wheels in series: the way back through the first one keeps its digits."""

import math

import pytest
from mpmath import mp
from words import Drive, Keys, Spec, Wheel

from geneva_cli.motion.mechanism import build

PAIRS = [(first, z) for first in (3, 4, 5, 6) for z in range(3, 40) if first * (z - 2) <= 2 * z]


@pytest.mark.parametrize(("first", "z"), PAIRS)
def test_motion_angle(first, z):
    """sin(a + psi) = sin psi / l at the second crank's half motion psi, in 50 digits."""
    engagement = build(
        Spec(Wheel(z), Drive("geneva-pair"), Keys("geneva-pair", first))
    ).engagements[0]
    with mp.workdps(50):
        psi = mp.pi / 2 - mp.pi / z
        sine = min(mp.sin(psi) / mp.sin(mp.pi / first), mp.mpf(1))
        exact = 2 * (mp.asin(sine) - psi) * 180 / mp.pi
    # 6: half a unit of psi's degrees, moved up to fourfold by the arc sine and doubled, and three
    # roundings; the arc sine less psi, which cancels, was up to 13 units off
    assert abs(float(engagement.motion_deg - exact)) <= 6.0 * math.ulp(engagement.motion_deg)
