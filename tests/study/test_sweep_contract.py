"""Whatever varies in a sweep, each row has its own design's answers."""

import os

import numpy as np
import pytest
from design_arrays import MACHINES
from words import Motion

import geneva_cli
from geneva_cli import Design, External, Load, SideCrank
from geneva_cli.design import load
from geneva_cli.motion.batch import taken
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many, may_vary
from geneva_cli.study.sweep.best import best_spec
from geneva_cli.study.sweep.outcome import Outcome
from geneva_cli.study.sweep.request import request

DESIGNS = os.path.join(os.path.dirname(__file__), os.pardir, os.pardir, "designs")


def swept(tmp_path, text, *vary, pick):
    """The rows of a sweep without their last column, which says what is wrong: nothing."""
    path = tmp_path / "spec.toml"
    path.write_text(text)
    rows = [row for block in request(str(path), vary, pick=pick).blocks() for row in block]
    assert [row[-1] for row in rows] == [None] * len(rows)
    return [row[:-1] for row in rows]


def test_slots_of_an_unbalanced_wheel_on_a_carrier_vary_alone(tmp_path):
    """A turn of the wheel has as many motions as slots: the sweep ended in a traceback."""
    text = '[wheel]\nz = 5\n[drive]\nkind = "carousel"\n[load]\ninertia_kgm2 = 0.1\n[[mass]]\n'
    text += 'shape = "point"\nmass_kg = 0.7\nradius_mm = 120\nangle_deg = 40\n'
    rows = swept(tmp_path, text, "wheel.z=5,6", pick="loads.input_torque_Nm.max")
    path = str(tmp_path / "spec.toml")
    assert not may_vary(load(path).spec, "wheel.z")
    single = [load(path, [f"wheel.z={z}"]).loads["input_torque_Nm"] for z in (5, 6)]
    assert [row[1] for row in rows] == [max(one.max, -one.min) for one in single]


def test_the_ratio_alone_reaches_the_loads(tmp_path):
    """Of R/L = 1/2 the roller turns back in the slot; else the torque has no lever half-way."""
    text = '[wheel]\nz = 6\n[motion]\nlaw = "cycloidal"\nratio = 0.5\n[load]\ntorque_Nm = 5\n'
    pick = "loads.pin_force_N.max,loads.sliding_m_s.rms"
    rows = swept(tmp_path, text, "motion.ratio=0.5,0.4,0.6", pick=pick)
    assert [row[1] for row in rows] == [pytest.approx(100.0, rel=1e-12), None, None]
    assert [row[2] for row in rows] == pytest.approx([0.1407993, 0.1156889, 0.1803211], rel=1e-6)


def test_the_input_crank_alone_reaches_the_shaft(tmp_path):
    text = '[wheel]\nz = 6\n[drive]\nkind = "side-crank"\nA = 0.6\n[load]\ntorque_Nm = 5\n'
    text += "[shaft]\ncrank_overhang_mm = 25\n"
    pick = "strength.crank_shaft.moment_Nm"
    rows = swept(tmp_path, text, "drive.input_crank_mm=30,40,50", pick=pick)
    assert [round(row[1], 3) for row in rows] == [5.002, 5.067, 5.194]


@pytest.mark.long
def test_the_best_of_a_ratio_that_has_a_bound_at_one_number():
    """A cloud comes near the 1/2 of the spec, and never to it: its own design is tried too."""
    path = os.path.join(DESIGNS, "sine-group.toml")
    asked = request(path, ["motion.ratio=0.4..0.7"], best="min:loads.pin_force_N.max", random=64)
    lines = best_spec(Outcome(asked), asked.blocks())
    assert "of 65 designs, 1 of them within the bounds: 4202.7525." in lines[0]
    single = load(path).loads["pin_force_N"]
    assert max(single.max, -single.min) == pytest.approx(4202.7525, rel=1e-8)


HORN = "[size]\nface_width_mm = 10\n[load]\ninertia_kgm2 = 0.3\n"


@pytest.mark.parametrize(
    "text",
    [
        f'[wheel]\nz = 6\n[motion]\nlaw = "cycloidal"\nratio = "matched"\n{HORN}',
        f'[wheel]\nz = 6\n[drive]\nkind = "cam"\n[motion]\nlaw = "cycloidal"\n{HORN}',
        f'[wheel]\nz = 4\n[drive]\nkind = "epicyclic"\nplanet_ratio = "shockless"\n{HORN}',
    ],
)
def test_horns_of_machines_that_differ_in_size_alone(tmp_path, text):
    """Wheels of one shape and one load: the force goes with 1/L, and so does the stress, times
    1/L² of the sections; the roller and its slot are L/20.
    """
    rows = swept(tmp_path, text, "size.center_distance_mm=100,110", pick="life.horn_stress_MPa")
    assert rows[1][1] / rows[0][1] == pytest.approx(1.1**-2, rel=1e-9)


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_horns_of_rollers_that_vary_alone(tmp_path, friction):
    """Wider slots leave thinner horns under the same force, which rollers rub along otherwise."""
    text = f"[wheel]\nz = 6\n[load]\ninertia_kgm2 = 0.4\nfriction = {friction}\n"
    names = ("stress_MPa", "inwards_mm", "thickness_mm")
    pick = ",".join(f"strength.horn.{name}" for name in names)
    rows = swept(tmp_path, text, "size.roller_radius_mm=9,10", pick=pick)
    for row in rows:
        [alone] = swept(tmp_path, text, f"size.roller_radius_mm={row[0]}", pick=pick)
        assert row == pytest.approx(alone, rel=1e-12)  # rounding of a search along the horn
    assert rows[0][3] > rows[1][3]


def test_a_machine_whose_parts_are_not_built_has_no_horns(tmp_path):
    """The gears between two cranks and a side-crank are not built, nor are the other parts."""
    text = "[wheel]\nz = 8\n[drive]\nrollers = 2\ncrank_steps = [0, 3]\n"
    before = '[drive.before]\nkind = "side-crank"\nA = 0.2\n'
    pick = "life.horn_stress_MPa"
    [[_, stress], _] = swept(tmp_path, text + HORN, "drive.n_rpm=30,60", pick=pick)
    assert stress > 0.0
    rows = swept(tmp_path, text + before + HORN, "drive.n_rpm=30,60", pick=pick)
    assert [row[1] for row in rows] == [None, None]


def test_clearances_alone_reach_the_change_of_sides(tmp_path):
    """Beside where the torque vanishes a wheel's speed is behind by x²/2, and its angle by x³/6."""
    text = "[wheel]\nz = 6\n[load]\ninertia_kgm2 = 0.3\n"
    rows = swept(
        tmp_path, text, "size.slot_clearance_mm=0.00001,0.00002", pick="shock.reversal.jump"
    )
    assert rows[1][1] / rows[0][1] == pytest.approx(2.0 ** (2.0 / 3.0), rel=1e-2)


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_a_gear_sector_under_loads_that_vary_alone(tmp_path, friction):
    """Gears turn the wheel at an even speed; what its inertia alone takes goes with it."""
    text = '[wheel]\nz = 3\n[drive]\nkind = "gear-sector"\nsector_deg = 60\n'
    text += f"[load]\ninertia_kgm2 = 0.3\nfriction = {friction}\n"
    rows = swept(tmp_path, text, "load.inertia_kgm2=0.3,0.6", pick="loads.pin_force_N.max")
    assert rows[1][1] / rows[0][1] == pytest.approx(2.0, rel=1e-12)
    spec = Spec(
        External(3), geneva_cli.GearSector(sector_deg=60.0), load=Load(0.3, friction=friction)
    )
    single = Design(spec.wheel, spec.drive, load=spec.load).loads["pin_force_N"]
    assert rows[0][1] == pytest.approx(max(single.max, -single.min), rel=1e-14)


def test_a_load_without_an_inertia_does_not_swing(tmp_path):
    text = "[wheel]\nz = 6\n[load]\ntorque_Nm = 5\n[shaft]\nstiffness_Nm_rad = 2000\n"
    pick = "vibration.residual_share"
    assert swept(tmp_path, text, "load.torque_Nm=5,6", pick=f"{pick},loads.pin_force_N.max")


def test_shares_of_a_law_are_given_one_by_one(tmp_path):
    text = '[wheel]\nz = 6\n[motion]\nlaw = "scca"\nb = 0.25\nc = 0.5\nd = 0.25\n'
    rows = swept(tmp_path, text, "motion.b=0.25,0.2500001", pick="acceleration.max")
    # of the modified trapezoid 8 pi / (2 + pi), over a third of a turn: 60 deg
    assert rows[0][1] == pytest.approx(8 * np.pi / (2 + np.pi) * (np.pi / 3) / (2 * np.pi / 3) ** 2)
    spec = load(str(tmp_path / "spec.toml")).spec
    assert not may_vary(spec, "motion.b") and may_vary(spec, "motion.alpha0_deg")


@pytest.mark.parametrize(
    ("text", "vary", "refused"),
    [
        ("steps_deg = [72, 48]", "wheel.offset_mm=0,0.003", "remove one of them"),
        ("[drive]\nrollers = 2\nroller_angles_deg = [0, 90]", "wheel.z=4,5", "jam"),
    ],
)
def test_one_of_a_batch_is_left(tmp_path, text, vary, refused):
    """The others are refused in their rows; of one a batch is a batch too."""
    z = 6 if "steps" in text else 4
    path = tmp_path / "spec.toml"
    path.write_text(
        f"[wheel]\nz = {z}\n{text}\n[size]\nface_width_mm = 10\n[load]\ntorque_Nm = 5\n"
    )
    pick = "life.horn_stress_MPa,strength.lock.force_N"
    [[left, other]] = request(str(path), [vary], pick=pick).blocks()
    [[single]] = request(str(path), [f"{vary.split(',')[0]}"], pick=pick).blocks()
    assert left[-1] is None
    assert left[1:-1] == pytest.approx(single[1:-1], rel=1e-14)
    assert other[1:-1] == [None, None]
    assert refused in other[-1]


@pytest.mark.parametrize(
    ("text", "vary", "refused"),
    [
        ("z = 8\n[drive]\nrollers = 2\ncrank_steps = [0, 3]", "tolerance.slot_width_mm", "cranks"),
        ('z = 8\ngearing = "linear"', "tolerance.slot_width_mm", "for a wheel"),
        ('z = 8\ngearing = "linear"', "support.radius_mm", "for a wheel"),
    ],
)
def test_a_table_that_a_machine_refuses(tmp_path, text, vary, refused):
    """A value of 0 sets nothing; the other is refused in its row."""
    path = tmp_path / "spec.toml"
    path.write_text(f"[wheel]\n{text}\n")
    [[zero, other]] = request(str(path), [f"{vary}=0,0.01"], pick="velocity.max").blocks()
    [[alone]] = request(str(path), ["drive.n_rpm=60"], pick="velocity.max").blocks()
    assert zero[-1] is None
    assert zero[1] == alone[1] > 0.0
    assert other[1] is None
    assert refused in other[-1]


@pytest.mark.parametrize("kind", ["four-bar", "slider-crank"])
def test_a_batch_refuses_the_distance_of_a_linkage(kind):
    """100 mm is the default, and any other distance follows from the linkage."""
    spec = MACHINES[kind][0]
    batch = many(spec, {"size.center_distance_mm": np.array([100.0, 50.0])})
    assert batch.refused.tolist() == [False, True]


def test_a_batch_knows_how_many_it_has():
    """Whatever varies in it, in parts of it, and in one of it."""
    spec, _ = MACHINES["side-crank"]
    found = many(spec, {"drive.A": np.array([0.5, 2.0, 0.5, 0.5])})
    assert found.machine.designs == 3
    assert taken(found.machine, slice(1, 3)).designs == 2
    assert taken(found.machine, np.array([1])).designs == 1
    assert taken(found.machine, 1).designs == 1
    assert taken(found.machine, 1).design == 2
    plain = Spec(External(6), SideCrank(A=0.5), motion=Motion(None))
    assert many(plain, {"size.pin_mm": np.array([4.0, 4.0])}).machine.designs == 2
