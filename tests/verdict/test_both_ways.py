"""Machines that turn both ways: loads by the laws of motion, checks in the worse direction.

Seen from behind, a machine that turns backwards turns forwards. There the wheel's acceleration is
that of the mirror, while what resists the motion still resists it.
"""

import math

import numpy as np
import pytest
import repo

from geneva_cli import (
    Cam,
    Crank,
    Design,
    External,
    Limits,
    Load,
    Motion,
    Shaft,
    SideCrank,
    SineGroup,
    Spherical,
    Tuned,
    load,
)
from geneva_cli.motion.both_ways import every_way
from geneva_cli.parts.machine_sizes import built
from geneva_cli.verdict.advice import judged
from geneva_cli.verdict.both_directions import worse_of, worst_checks
from geneva_cli.verdict.checks.check import Check

BOTH = Crank(both_ways=True)
OFFSET = External(6, offset_mm=12.0)
TILTED = Motion(SineGroup(0.1), ratio="matched")
DESIGNS = sorted(path.name for path in repo.DESIGNS.glob("*.toml"))


def one_way(name):
    return load(str(repo.DESIGNS / name))


def both(name, *settings):
    return load(str(repo.DESIGNS / name), ["drive.both_ways=true", *settings])


@pytest.mark.parametrize(
    "machine",
    [
        Design(External(6), BOTH),
        Design(Spherical(6), BOTH),
        Design(External(6, steps_deg=(72, 48)), BOTH),
        Design(External(6), SideCrank(A=0.4, rollers=2, both_ways=True)),
        Design(OFFSET),  # which turns one way
    ],
)
def test_one_machine_serves_both_ways(machine):
    assert every_way(machine.mechanism) == (machine.mechanism,)


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
    got = of.backwards.cycle.states(-x).wheel_torque_Nm
    assert got == pytest.approx(drag - inertia * w * w * bend, rel=1e-11)


def test_inertia_alone_loads_the_pin_alike():
    """Without drag and friction a film of the motion, run backwards, has the same forces."""
    of = Design(OFFSET, load=Load(inertia_kgm2=0.02))
    one, other = (d.loads["pin_force_N"] for d in (of, of.backwards))
    assert max(other.max, -other.min) == pytest.approx(max(one.max, -one.min), rel=1e-12)
    resisted = Design(OFFSET, load=Load(inertia_kgm2=0.02, torque_Nm=3.0))
    one, other = (d.loads["pin_force_N"].max for d in (resisted, resisted.backwards))
    assert other > 1.05 * one


@pytest.mark.parametrize("e", [4.0, 12.0, -20.0])
def test_the_ends_of_an_offset_slot_change_places(e):
    """Entry l/cos(b + d) backwards, with sin d = e/(L cos b): theory.md 1.4."""
    b, d = math.pi / 6, math.asin(e / (100.0 * math.cos(math.pi / 6)))
    ends = Design(External(6, offset_mm=e)).backwards.peaks.ends
    l = math.sin(b) * math.cos(d)
    assert ends.acceleration_entry == pytest.approx(l / math.cos(b + d), rel=1e-13)
    assert ends.acceleration_exit == pytest.approx(l / math.cos(b - d), rel=1e-13)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ["offset-slots.toml", "sine-group.toml", "four-bar-z4.toml"])
def test_default_sizes_hold_the_loads_of_both(name):
    heavy = ("load.inertia_kgm2=0.3", "load.torque_Nm=30", "load.friction=0.1")
    one, other = (built(m).as_dict() for m in every_way(both(name, *heavy).mechanism))
    for key, value in one.items():
        # a linkage's wheel is solved for twice
        close = pytest.approx(value, rel=1e-12) if isinstance(value, float) else value
        assert other[key] == close, key


@pytest.mark.long
def test_a_slot_s_mouth_serves_both_ends():
    """A tilted law takes the roller out at another radius than in: no wall may meet it.

    With the radius at entry alone, the roller cut 0.06 mm into the slot as it left.
    """
    for tilt in (-0.05, 0.05):
        of = Design(External(6), Cam(), Motion(SineGroup(tilt)))
        (engagement,) = of.mechanism.engagements
        entry, exit_ = (engagement.reach(at) for at in (engagement.entry_deg, engagement.exit_deg))
        assert abs(entry - exit_) > 1e-3
        rim = math.hypot(100.0 * min(entry, exit_), of.mechanism.roller_radius_mm)
        assert of.size.wheel_radius_mm == pytest.approx(rim, rel=1e-14)
        assert of.passes


def test_each_check_is_the_worse_one():
    of = both("offset-slots.toml")
    one, other = every_way(of.mechanism)
    rows = {c.name: c for c in worst_checks(of.mechanism)}
    pin = [Design.of(m.spec).strength["strength.pin.stress_MPa"] for m in (one, other)]
    assert rows["pin_stress_MPa"].value == max(pin) == pin[1]
    assert rows["pin_stress_MPa"].direction == "backwards"
    assert rows["dwell_deg"].direction == ""
    assert not any(c.direction for c in worst_checks(one_way("offset-slots.toml").mechanism))


def test_the_worse_of_two_rows():
    good, bad = Check("a", 2.0, "at least", 1.0, True), Check("a", 0.5, "at least", 1.0, False)
    unknown = Check("a", None, "at least", 1.0, None, "why")
    for one, other, want in (
        ([good], [bad], (bad, "backwards")),
        ([bad], [good], (bad, "forwards")),
        ([unknown], [good], (unknown, "forwards")),
        ([good], [unknown], (unknown, "backwards")),
        ([good], [good._replace(value=2.0 + 1e-9)], (good, "")),
        ([], [bad], (bad, "backwards")),
    ):
        row, direction = want
        assert worse_of(one, other) == [row._replace(direction=direction)]
    # two checks of one name stay two
    two = [good, good._replace(limit=3.0, passes=False)]
    assert worse_of(two, two) == two


@pytest.mark.long
def test_advice_serves_both_directions():
    """The entry's 0.548 passes forwards, 0.61 backwards does not."""
    of = Design(External(6, offset_mm=8.0), BOTH, limits=Limits(acceleration_entry_max=0.6))
    (row,) = [c for c in judged(of.mechanism) if c.passes is False]
    assert (row.name, row.direction) == ("acceleration_entry_max", "backwards")
    assert row.value == pytest.approx(0.61002, abs=1e-5)
    key, value = row.nearest.split(" = ")
    assert of.with_(f"wheel.{key}", int(value)).passes
    assert Design(External(6, offset_mm=8.0), limits=of.spec.limits).passes


@pytest.mark.long
def test_warnings_name_what_differs():
    named = {w.name: w for w in both("offset-slots.toml").warnings}
    text = named["differs-backwards"]
    assert "0.541 forwards and 0.6189 backwards, because of offset_mm" in text
    # a symmetric linkage whose roller enters without a jump, to rounding
    assert "differs-backwards" not in {w.name for w in both("four-bar-z4.toml").warnings}
    tilted = Design(External(6), BOTH, TILTED).warnings
    # all derivatives of this law vanish at both ends: half-way is at another time
    (text,) = [w for w in tilted if w.name == "differs-backwards"]
    half = SineGroup(0.1).half_way
    assert f"half-way after {half:.4g} of the motion forwards and {1.0 - half:.4g} backw" in text
    assert 'because of the law "sine-group"' in text


@pytest.mark.long
def test_a_tuned_law_with_damping_is_tuned_forwards_only():
    def swings(law):
        shaft = Shaft(stiffness_Nm_rad=400.0, damping_ratio=law.damping_ratio)
        rests = Design(External(6), Cam(both_ways=True), Motion(law), shaft=shaft, load=Load(0.4))
        names = {w.name for w in rests.warnings}
        left = [
            d.vibration(2.5, law.damping_ratio).to_dict()["residual_share"]
            for d in (rests, rests.backwards)
        ]
        return "tuned-forwards-only" in names, left

    warned, (forwards, back) = swings(Tuned(period_ratio=2.5, damping_ratio=0.05))
    assert warned and forwards < 1e-9 < 1e-3 < back
    warned, (forwards, back) = swings(Tuned(period_ratio=2.5))
    assert not warned and max(forwards, back) < 1e-9


@pytest.mark.long
def test_the_report_shows_what_differs():
    page = both("offset-slots.toml").report.table.to_dict()
    named = {row["quantity"]: row for row in page["both_ways"]}
    row = named["acceleration.entry"]
    assert row["forwards"] == page["acceleration.entry"]
    assert row["backwards"] == page["acceleration.exit"]
    assert "acceleration.max" not in named
