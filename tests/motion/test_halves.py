"""The half-way place of a law whose second half is no mirror image of its first."""

import pytest
from witness import mp

from geneva_cli import SineGroup


def test_a_tilted_law_is_not():
    """s(u) = 1/2 by mpmath, from the closed form of s."""

    def s(u):
        x = mp.pi * u
        even = x - 2 * mp.sin(2 * x) / 3 + mp.sin(4 * x) / 12
        return (even - mp.mpf(64) / 15 * mp.mpf(0.1) * mp.sin(x) ** 5) / mp.pi

    wanted = float(mp.findroot(lambda u: s(u) - mp.mpf(0.5), 0.6))
    assert SineGroup(0.1).half_way == pytest.approx(wanted, abs=2e-16)
