"""Slot, gears at constant ratio, slot: in pieces, and so apart from the other machines' tests."""

import math

import numpy as np
import pytest
from witness import Geneva, mp, to_radians
from words import Drive, Keys, Spec, Wheel

from geneva_cli.motion.mechanism import build

CASES = [(3, 60.0), (6, 20.0), (3, 200.0), (4, 150.0)]


def machine(z, sector):
    return build(Spec(Wheel(z), Drive("gear-sector"), Keys("gear-sector", sector)))


def slots(b):
    """The straight slot of half angle b in 50 digits: angle and derivatives by the crank's."""
    l, c = mp.sin(b), mp.cos(b)

    def at(a):
        D = 1 - 2 * l * mp.cos(a) + l * l
        return (
            mp.atan2(l * mp.sin(a), 1 - l * mp.cos(a)),
            l * (mp.cos(a) - l) / D,
            -l * c * c * mp.sin(a) / D**2,
            l * c * c * (4 * l - (1 + l * l) * mp.cos(a) - 2 * l * mp.cos(a) ** 2) / D**3,
        )

    return at


@pytest.mark.parametrize(("z", "sector"), CASES)
def test_against_50_digits(z, sector):
    """16 units in the last place of each peak, and what b's own last place moves (its slope in b
    is below 8 peaks): b is a root found in doubles, and every value hangs on it."""
    s = machine(z, sector).engagements[0]
    b = mp.mpf(s.through.half_step)
    slot, D = slots(b), to_radians(sector)
    u = mp.mpf(s.motion.u)
    x = np.linspace(s.entry_deg, s.exit_deg, 101)
    got = s.motion(x).derivatives()
    rows = []
    for v in x:
        phi = to_radians(float(v))
        if abs(phi) <= D / 2:
            rows.append((u * phi, u, mp.mpf(0), mp.mpf(0)))
        else:
            side = mp.sign(phi)
            psi, *rest = slot(phi - side * D / 2)
            rows.append((psi + side * u * D / 2, *rest))
    for k in range(4):
        exact = [float(r[k]) for r in rows]
        peak = max(abs(e) for e in exact)
        worst = max(abs(float(mp.mpf(float(g)) - r[k])) for g, r in zip(got[k], rows, strict=True))
        assert worst <= (16.0 + 8.0) * math.ulp(peak)


def test_no_jump_at_l_over_1_minus_l():
    """u = l/(1-l), and the wheel of six slots' first half is Geneva's own."""
    s = machine(3, 60.0).engagements[0]
    assert s.motion.u == pytest.approx(1.0, abs=1e-14)  # b = 30 degrees: 60 + 1 * 60 = 120
    assert s.motion(-s.motion.half_sector, 2).derivatives()[2] == pytest.approx(0.0, abs=1e-14)
    witness = Geneva(6).derivatives(-20.0)
    ours = s.motion(-20.0 - s.motion.half_sector).derivatives()
    assert ours[1] == pytest.approx(float(witness[1]), abs=1e-14)
