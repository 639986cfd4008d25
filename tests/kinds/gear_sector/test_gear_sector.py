"""Slot, gears at constant ratio, slot: in pieces, and so apart from the other machines' tests."""

import math

import numpy as np
import pytest
from witness import Geneva, mp, to_degrees, to_radians
from words import Drive, Keys, Spec, Wheel

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import peaks

CASES = [(3, 60.0, "shockless"), (6, 20.0, "shockless"), (3, 200.0, 0.5), (4, 150.0, 0.4)]


def machine(z, sector, ratio="shockless"):
    return build(Spec(Wheel(z), Drive("gear-sector"), Keys("gear-sector", sector, ratio)))


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


@pytest.mark.parametrize(("z", "sector", "ratio"), CASES)
def test_against_50_digits(z, sector, ratio):
    """16 units in the last place of each peak, and what b's own last place moves (its slope in b
    is below 8 peaks): b is a root found in doubles, and every value hangs on it."""
    s = machine(z, sector, ratio).engagements[0]
    b = mp.mpf(s.through.half_step)
    slot, D = slots(b), to_radians(sector)
    a_t, u = to_radians(s.motion.handover_deg), mp.mpf(s.motion.u)
    x = np.linspace(s.entry_deg, s.exit_deg, 101)
    got = s.motion(x).derivatives()
    rows = []
    for v in x:
        phi = to_radians(float(v))
        if abs(phi) <= D / 2:
            rows.append((u * phi, u, mp.mpf(0), mp.mpf(0)))
        else:
            side = mp.sign(phi)
            psi, *rest = slot(phi - side * (D / 2 - a_t))
            rows.append((psi + side * (u * D / 2 - slot(a_t)[0]), *rest))
    for k in range(4):
        exact = [float(r[k]) for r in rows]
        peak = max(abs(e) for e in exact)
        worst = max(abs(float(mp.mpf(float(g)) - r[k])) for g, r in zip(got[k], rows, strict=True))
        assert worst <= (16.0 + 8.0) * math.ulp(peak)


@pytest.mark.parametrize(("z", "sector", "ratio"), CASES)
def test_a_step(z, sector, ratio):
    """The step and both handovers: 2 (b - psi_t) + u D, speeds that agree."""
    s = machine(z, sector, ratio).engagements[0]
    first, last = (s.motion(x).derivatives() for x in (s.entry_deg, s.exit_deg))
    assert last[0] - first[0] == pytest.approx(2.0 * math.pi / z, abs=1e-14)
    assert (first[1], last[1]) == (0.0, 0.0)
    before, after = (
        s.motion(x, 1).c[1] for x in (-s.motion.half_sector, -s.motion.half_sector + 1e-9)
    )
    assert before == pytest.approx(after, abs=4e-15)  # a_t: a few ulp of the speed
    assert s.motion_deg == pytest.approx(
        2.0 * (s.through.exit_deg - s.motion.handover_deg) + sector, rel=1e-15
    )


def test_no_jump_at_l_over_1_minus_l():
    """u = l/(1-l): a_t = 0, and the wheel of six slots' first half is Geneva's own."""
    s = machine(3, 60.0).engagements[0]
    assert s.motion.u == pytest.approx(1.0, abs=1e-14)  # b = 30 degrees: 60 + 1 * 60 = 120
    assert s.motion(-s.motion.half_sector, 2).derivatives()[2] == pytest.approx(0.0, abs=1e-14)
    witness = Geneva(6).derivatives(-20.0)
    ours = s.motion(-20.0 - s.motion.half_sector).derivatives()
    assert ours[1] == pytest.approx(float(witness[1]), abs=1e-14)


def test_the_jump_is_the_slots_acceleration_there():
    s = machine(3, 200.0, 0.5).engagements[0]
    slot = slots(mp.mpf(s.through.half_step))
    jump = s.motion(-s.motion.half_sector, 2).derivatives()[2]
    assert jump == pytest.approx(float(abs(slot(to_radians(s.motion.handover_deg))[2])), abs=1e-13)
    assert s.motion(0.0, 2).c[2] == 0.0
    assert peaks(s).acceleration.max >= jump
    assert to_degrees(mp.mpf(1)) > 57


@pytest.mark.parametrize(
    ("z", "sector", "ratio", "moved"),
    [(3, 40.39888175618229, 2.870674432158498, 5e-15), (4, 103.253047, 0.4966296005942192, 2e-13)],
)
def test_from_the_keys(z, sector, ratio, moved):
    """A half angle of 86 degrees, and a handover at 0.04: b solved for in 50 digits.

    One unit in the last place of a key moves the handover, and the jump there, by so much of
    themselves; six of these are allowed.
    """
    D, u = to_radians(sector), mp.mpf(ratio)

    def handover(b):
        l = mp.sin(b)
        return mp.acos((u * (1 + l * l) + l * l) / (l * (1 + 2 * u)))

    def excess(b):
        return b - slots(b)(handover(b))[0] + u * D / 2 - mp.pi / z

    ends = mp.asin(u / (1 + u)) + mp.mpf("1e-20"), mp.pi / 2 - mp.mpf("1e-4")
    b = mp.findroot(excess, ends, solver="ridder", maxsteps=200)
    s = machine(z, sector, ratio).engagements[0]
    jump = s.motion(-s.motion.half_sector, 2).derivatives()[2]
    assert jump == pytest.approx(float(-slots(b)(handover(b))[2]), rel=6.0 * moved)
    assert s.motion.handover_deg == pytest.approx(float(to_degrees(handover(b))), rel=6.0 * moved)
    assert s.through.half_step == pytest.approx(float(b), rel=2e-15)


@pytest.mark.parametrize(("sector", "bound"), [(60.0, "at least"), (300.0, "at most")])
def test_out_of_reach(sector, bound):
    with pytest.raises(GenevaError, match=bound) as refused:
        machine(3, sector, 0.5)
    named = float(str(refused.value).split(bound)[1].split()[0].rstrip(","))
    inside = named + (1e-3 if bound == "at least" else -1e-3)
    assert machine(3, inside, 0.5)


@pytest.mark.parametrize(
    ("z", "sector", "ratio", "words"),
    [
        # a slot of asin(3/4) turns the wheel by more than 90 degrees: no least sector
        (4, 40.0, 3.0, "above 0 and at most 30"),
        # asin(1/3): 2 (60 - 19.47)/0.5 = 162.12; all of the step in gear: 120/0.5
        (3, 300.0, 0.5, "at least 162.115 and at most 240"),
        (3, 100.0, 0.1, "needs a sector_deg of 1095.68, more than 330"),
        # all of the step in gear: 120/0.35, but the key ends at 330
        (3, 1.0, 0.35, "and at most 330"),
    ],
)
def test_a_refusal_names_sectors_that_can_be_set(z, sector, ratio, words):
    with pytest.raises(GenevaError, match=words):
        machine(z, sector, ratio)
