"""The machine turning the other way: its loads by the laws of motion, its ends in other places.

Seen from behind, a machine that turns backwards turns forwards. There the wheel's acceleration is
that of the mirror, while what resists the motion still resists it.
"""

import math

import numpy as np
import pytest
import repo

from geneva_cli import Cam, Design, External, Load, Motion, SineGroup, load

OFFSET = External(6, offset_mm=12.0)


def test_a_pattern_of_steps_runs_the_other_way_round():
    """Of stations a, b, c the crank meets a, c, b."""
    assert External(6, steps_deg=(54, 60, 66)).backwards.steps == (54, 66, 60)


@pytest.mark.parametrize("inertia, drag", [(0.02, 0.0), (0.0, 3.0), (0.02, 3.0)])
def test_torques_by_the_law_of_motion(inertia, drag):
    """M = I w² psi'' + M_r, and psi'' backwards at x is -psi'' at -x."""
    of = Design(OFFSET, load=Load(inertia, drag))
    (engagement,) = of.mechanism.engagements
    x = np.linspace(0.9 * engagement.entry_deg, 0.9 * engagement.exit_deg, 7)
    bend, w = engagement.motion(x, 2).derivatives()[2], 2.0 * math.pi  # at 60 rpm
    got = of.backwards.cycle.states(-x, ["wheel_torque_Nm"])[0]
    assert got == pytest.approx(drag - inertia * w * w * bend, rel=1e-11)


@pytest.mark.parametrize("e", [4.0, 12.0, -20.0])
def test_the_ends_of_an_offset_slot_change_places(e):
    """Entry l/cos(b + d) backwards, with sin d = e/(L cos b): theory.md 1.4."""
    b, d = math.pi / 6, math.asin(e / (100.0 * math.cos(math.pi / 6)))
    ends = Design(External(6, offset_mm=e)).backwards.peaks.ends
    l = math.sin(b) * math.cos(d)
    assert ends.acceleration_entry == pytest.approx(l / math.cos(b + d), rel=1e-13)
    assert ends.acceleration_exit == pytest.approx(l / math.cos(b - d), rel=1e-13)


def test_sizes_that_the_load_chose_stay():
    """Backwards the pin is loaded harder; it is the pin of the same machine all the same."""
    heavy = ["load.inertia_kgm2=0.3", "load.torque_Nm=30", "load.friction=0.1"]
    of = load(str(repo.DESIGNS / "offset-slots.toml"), heavy)
    assert of.size.pin_mm > Design(External(6)).size.pin_mm
    for key in ("pin_mm", "wheel_thickness_mm", "crank_bore_mm"):
        assert getattr(of.backwards.size, key) == getattr(of.size, key)
    here, there = (d.strength["strength.pin.stress_MPa"] for d in (of, of.backwards))
    assert there > here


@pytest.mark.long
def test_a_slot_s_mouth_serves_both_ends():
    """A tilted law takes the roller out at another radius than in: no wall may meet it.

    With the radius at entry alone, the roller cut 0.06 mm into the slot as it left.
    """
    for tilt in (-0.05, 0.05):
        of = Design(External(6), Cam(), Motion(SineGroup(tilt)))
        (engagement,) = of.mechanism.engagements
        entry, exit_ = map(engagement.reach, (engagement.entry_deg, engagement.exit_deg))
        assert abs(entry - exit_) > 1e-3
        rim = math.hypot(100.0 * min(entry, exit_), of.mechanism.roller_radius_mm)
        assert of.size.wheel_radius_mm == pytest.approx(rim, rel=1e-14)
        assert of.passes and of.backwards.passes
