"""The cycle under load: published cases, a balance of work, and invariances."""

import json
import math

import numpy as np
import pytest
import repo
from load_states import integrals
from typer.testing import CliRunner
from words import Drive, Motion, Spec, Wheel, load

from geneva_cli import Design, External, Load, NoncircularGears, Shaft, Size, Spherical
from geneva_cli.cli.app import app
from geneva_cli.loads.cycle import Cycle, back_driven_deg
from geneva_cli.loads.instant import QUANTITIES
from geneva_cli.loads.load_tables import reversals_deg, summaries
from geneva_cli.motion.mechanism import build
from geneva_cli.numerics.angles import omega

DESIGNS = sorted(repo.DESIGNS.glob("*.toml"))
TURRET = Spec(
    Wheel(8),
    Drive(n_rpm=40.0),
    size=Size(250.0, 12.0, face_width_mm=18.0),
    load=Load(1.2, 20.0, efficiency=0.95, friction=0.05),
)
# theory-loads.md, section 8
STEADY = Spec(
    Wheel(6),
    size=Size(200.0, 8.0, face_width_mm=20.0, pin_mm=4.0),
    load=Load(0.4, 15.0, friction=0.1),
)


def test_a_turret_of_eight_stations():
    """The issue's case, to the digits that it has.

    Peak and least over the motion (the least, at the exit, is friction alone), mean and root of
    the mean square over the whole cycle with its dwell, and a roller fixed to its pin. The root is
    5.8159 N m, printed there with its last digit cut off.
    """
    found = summaries(Cycle(build(TURRET)))
    torque = found["input_torque_Nm"]
    assert round(found["power_W"].max, 1) == 75.2
    assert math.floor(torque.rms * 100.0) / 100.0 == 5.81
    assert round(torque.mean, 2) == 2.75
    assert (round(torque.min, 2), torque.min_at_deg) == (0.28, 67.5)


@pytest.mark.parametrize("path", DESIGNS, ids=lambda path: path.stem)
def test_the_first_row_is_the_limit_of_those_after_it(path):
    """A roller that begins to slide from rest has friction of the sense in which it slides."""
    spec, heavy = load(path).spec, Load(0.3, 2.0, friction=0.2)
    spec = spec.replace(load=spec.load.replace(friction=0.2) if spec.load.mass_kg else heavy)
    cycle, names = Cycle(build(spec)), ("pin_force_N", "sliding_m_s", "input_torque_Nm")
    first = cycle.mechanism.engagements[0]
    begin = first.mid_deg + first.entry_deg
    at, after = cycle.states(np.array([begin, begin + 1e-9 * first.motion_deg]), names).T
    # a billionth of a motion later, of the greatest of all
    greatest = [abs(cycle.extremes[name].max) for name in names]
    assert (abs(after - at) <= 1e-6 * np.array(greatest)).all()


def test_a_load_that_changes_walls():
    """Without friction: reversal, greatest force, friction's work per unit of it, roller turns.

    By mpmath, 40 digits, N = T/rho and v = rho' + sigma (1 + psi') r cut at each change of sign.
    theory-loads.md, 8, has the first to all its digits, 324.503703 N, and the last two to 3e-7 and
    1e-4: integrals that run over the second reversal, at 43.03 deg, without a cut (test_roller).
    """
    still = Cycle(build(STEADY.replace(load=Load(0.4, 15.0))))
    first, _ = reversals_deg(still)
    assert first == pytest.approx(10.3447585591609, rel=1e-13)
    force = summaries(still)["pin_force_N"]
    assert force.max == pytest.approx(324.50370415267853, rel=1e-14)
    size = integrals(still, lambda i: i.force_N * QUANTITIES["sliding_m_s"](i).value * i.slides)
    per_second = still.case.speed_rad_s
    assert size[0] / per_second == pytest.approx(16.229000563314397, rel=1e-13)
    turns = (
        integrals(still, lambda i: QUANTITIES["sliding_m_s"](i).value * i.slides)[0] / per_second
    )
    assert turns / (2.0 * math.pi * 0.008) == pytest.approx(2.6551484499207021, rel=1e-13)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_the_work_closes(path):
    """Input work is what resists over the step and what rubs: 1e-12 of it; 1e-14 of the energy.

    What the inertia takes it gives back, so the mean of torque times speed is the resistance's.
    """
    mechanism = load(str(path))
    mechanism = mechanism._replace(spec=mechanism.spec.replace(load=Load(0.02, 3.0, friction=0.1)))
    cycle = Cycle(mechanism)
    w = cycle.case.speed_rad_s
    paid, moved, rubbed, taken = integrals(
        cycle,
        lambda i: i.input_torque_Nm,
        lambda i: i.wheel_torque_Nm * i.at.velocity,
        lambda i: i.slot_torque_Nm - i.wheel_torque_Nm * i.at.velocity,
        lambda i: i.at.acceleration * i.at.velocity * (w * w),
    )
    step = sum(2.0 * engagement.half_step for engagement in mechanism.engagements)
    assert moved == pytest.approx(cycle.case.resists_Nm * step, rel=1e-12)
    assert paid == pytest.approx(cycle.case.resists_Nm * step + rubbed, rel=1e-12)
    assert abs(taken) <= 1e-12 * w * w * step


def test_where_the_wheel_drives_the_motor():
    """Without friction the input is driven just where the wheel's torque is below 0."""
    cycle = Cycle(build(STEADY.replace(load=Load(0.4, 15.0))))
    (where,) = back_driven_deg(cycle)
    assert list(where) == pytest.approx(reversals_deg(cycle), rel=1e-14)
    drag = 0.4 * omega(60.0) ** 2 * 1.3496372759019029  # theory.md 7: the peak of psi''
    warnings = Design.of(cycle.mechanism.spec).warnings
    assert any(f"{drag:.4g} N m in all" in text for text in warnings)
    dragged = Design.of(STEADY.replace(load=Load(0.4, drag * (1.0 + 1e-12))))
    assert dragged.loads["input_torque_Nm"].min >= 0.0


@pytest.mark.long
def test_each_bearing_of_a_shaft():
    """A lever of 30 on bearings 60 apart: one and a half times the load, and half of it."""
    shaft = Shaft(wheel_overhang_mm=30.0, wheel_span_mm=60.0)
    found = Design(External(6), load=Load(0.4, 15.0), shaft=shaft).loads
    both = found["wheel_near_bearing_N"].max, found["wheel_far_bearing_N"].max
    assert both == pytest.approx([1.5 * found["wheel_bearing_N"].max, both[0] / 3.0], rel=1e-15)
    assert found["crank_near_bearing_N"].max is None
    # where shafts meet there is no such lever
    ball = Design(Spherical(6), load=Load(0.4, 15.0), shaft=shaft)
    assert ball.loads["wheel_near_bearing_N"].max is None
    notes = ball.loads_table.to_dict()["warnings"]
    assert any("crank_far_bearing_N: need parallel shafts; on a sphere" in note for note in notes)


def test_a_row_at_mid_motion_has_the_limits_of_the_way_in():
    """A pin that crosses the radius there has no lever, and without resistance no torque.

    Its force is I w^2 psi3 over the lever's rate (v^2 + (1 - l) c) / v, with v = l - psi1 (1 - l)
    and c = l + 2 psi1 l - psi1^2 (1 - l): 209.674322308232641534 N by mpmath. There was none, and
    of which wall the sliding was told hung on a rounding.
    """
    spec = Spec(
        Wheel(6),
        motion=Motion("cycloidal", alpha0_deg=10.0),
        size=Size(100.0, face_width_mm=10.0),
        load=Load(1.0),
    )
    x, names = np.array([-1e-5, 0.0]), ["sliding_m_s", "pin_force_N", "contact_stress_MPa"]
    for friction in (0.0, 0.05):
        cycle = Cycle(build(spec.with_("load.friction", friction)))
        slid, pressed, stressed = cycle.states(x, names)
        assert slid[1] == pytest.approx(slid[0], rel=1e-9)
        force = 0.0 if friction else 209.674322308232641534
        # beside a ten-thousandth of the motion a rounding is 1e-12 of the force
        assert pressed[1] == pytest.approx(force, rel=1e-11, abs=1e-10)
        assert np.isfinite(stressed).all()
    pushed = Cycle(build(spec.with_("load.torque_Nm", 2.0)))
    there, pressed, _ = pushed.states(x, names)
    assert pressed[1] == math.inf  # a torque without a lever
    assert there[1] == pytest.approx(slid[0], rel=1e-9)


def run(*arguments, text):
    return CliRunner().invoke(app, ["loads", "-", *arguments], input=text)


WHEEL = "[wheel]\nz = 6\n"


@pytest.mark.parametrize("law", ["cycloidal", "3-4-5", "modified-sine"])
def test_a_row_at_either_end_has_the_sliding_beside_it(law):
    """Without a torque there no wall bears, and the sign of a rounding chose one.

    The roller, r = 5 mm, slides by its path along the slot, less that of its surface. 1e-5: what
    these change over 1e-4 degrees.
    """
    cycle = Cycle(build(Spec(Wheel(6), motion=Motion(law), load=Load(0.1))))
    (engagement,) = cycle.mechanism.engagements
    ends = np.array([engagement.entry_deg, engagement.exit_deg])
    beside = ends + np.array([1e-4, -1e-4])
    rows, near = (cycle.states(x, ["sliding_m_s"])[0] for x in (ends, beside))
    assert rows == pytest.approx(near, abs=1e-5 * abs(near).max())
    slides = cycle.extremes["sliding_m_s"]
    assert (rows <= slides.max).all()
    assert (rows >= slides.min).all()


def test_two_changes_of_the_wall_near_each_other_are_found():
    """Between them the wheel drives; so the roller slides most at the exit, on its first wall."""
    drive = NoncircularGears(n_rpm=43.142026952680055, A=0.662432371170093)
    carried = Load(1.119759070451892, 11.059624638270671, efficiency=0.9678628151540175)
    cycle = Design(External(6), drive, load=carried).cycle
    (engagement,) = cycle.mechanism.engagements
    x = np.linspace(engagement.entry_deg, engagement.exit_deg, 1001)
    rows = cycle.states(x, ["sliding_m_s"])[0]
    assert cycle.extremes["sliding_m_s"].max == pytest.approx(rows.max(), rel=1e-12) == rows[-1]


def test_each_null_names_its_key():
    tree = json.loads(run("--format", "json", text=WHEEL + "[load]\ntorque_Nm = 3\n").stdout)
    assert tree["contact_stress_MPa"]["max"] is None
    assert "contact_stress_MPa: needs face_width_mm in [size]" in tree["warnings"]


@pytest.mark.sampled(2)
def test_absurd_units_are_said():
    said = run(text=WHEEL + "[load]\ninertia_kgm2 = 4000\n").stdout
    assert "if it is in kg cm², write 0.4" in " ".join(said.split())
