"""Two wheels in series: the way back through the first one keeps its digits."""

import math

import pytest
from mpmath import mp

from geneva_cli.machine.drives.geneva_pair import Keys
from geneva_cli.machine.mechanism import build
from geneva_cli.spec.tables import Drive, Spec, Wheel

PAIRS = [(first, z) for first in (3, 4, 5, 6) for z in range(3, 40) if first * (z - 2) <= 2 * z]


@pytest.mark.parametrize(("first", "z"), PAIRS)
def test_motion_angle(first, z):
    """sin(a + psi) = sin psi / l at the second crank's half motion psi, in 50 digits."""
    station = build(Spec(Wheel(z), Drive("geneva-pair"), Keys(first))).stations[0]
    with mp.workdps(50):
        psi = mp.pi / 2 - mp.pi / z
        sine = min(mp.sin(psi) / mp.sin(mp.pi / first), mp.mpf(1))
        exact = 2 * (mp.asin(sine) - psi) * 180 / mp.pi
    # 6: half a unit of psi's degrees, moved up to fourfold by the arc sine and doubled, and three
    # roundings; the arc sine less psi, which cancels, was up to 13 units off
    assert abs(float(station.motion_deg - exact)) <= 6.0 * math.ulp(station.motion_deg)
