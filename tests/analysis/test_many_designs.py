"""Every answer of the analysis for designs at once: those of each design built alone.

Sizes within 16 units in the last place of the quantity's; NaN where one design has none.
"""

import math
from functools import cache, partial

import numpy as np
import pytest
from design_arrays import MACHINES, alone, drawn
from load_states import state

from geneva_cli.analysis import change_of_sides, impacts, undercut
from geneva_cli.analysis import positive_drive as positive
from geneva_cli.analysis.locking import Lock
from geneva_cli.analysis.tolerance.dimensions import corners
from geneva_cli.analysis.tolerance.motion_error import motion_errors
from geneva_cli.analysis.tolerance.random_machines import spread
from geneva_cli.analysis.tolerance.worst_effects import entry_jumps_worst, motion_plays, used
from geneva_cli.analysis.vibration.answers import values
from geneva_cli.analysis.vibration.oscillator import required_oscillator
from geneva_cli.analysis.vibration.vibration import design_vibrations
from geneva_cli.kinematics import registry
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.sizing import SIZING_NAMES, sizing, sizings
from geneva_cli.loads.strength import horn, lock, roller, shafts
from geneva_cli.loads.strength.wear import wears_mm
from geneva_cli.machine.many import many
from geneva_cli.numerics.arrays import only_of
from geneva_cli.spec.tables import (
    Load,
    Motor,
    RollerMaterial,
    Shaft,
    Support,
    Tolerance,
    WheelMaterial,
)

ULPS = 16 * 2.0**-52
# Searches under a load: 32 units, as for the loads themselves. Sums: what quadrature leaves.
SEARCHED, SUMMED = 2 * ULPS, 1e-12
PLACE = 1e-4 / 360.0  # of a top, which is flat: to the root of a rounding
# Of the standard laws, which test_peak_search and test_load_summaries compare one by one, that with
# most pieces: what is answered here asks any motion for its derivatives, and nothing more.
KINDS = [n for n in MACHINES if n not in registry.STANDARD_LAWS or n == "modified-trapezoid"]
CARRIED = [
    ("load.inertia_kgm2", 0.5, 3.0),
    ("load.torque_Nm", 0.0, 30.0),
    ("support.friction", 0.0, 0.2),
    ("motor.inertia_kgm2", 0.0, 0.1),
    ("motor.gear_ratio", 1.0, 20.0),
    ("drive.n_rpm", 5.0, 100.0),
    ("size.face_width_mm", 5.0, 20.0),
    ("size.slot_clearance_mm", 0.01, 0.05),
    ("size.roller_radius_mm", 3.0, 16.0),
    ("shaft.stiffness_Nm_rad", 1e3, 1e5),
    ("shaft.damping_ratio", 0.0, 0.1),
    *[(f"shaft.{shaft}_overhang_mm", 10.0, 50.0) for shaft in ("wheel", "crank")],
    ("shaft.wheel_diameter_mm", 10.0, 50.0),
    ("tolerance.center_distance_mm", 0.0, 0.05),
    ("material.wheel.youngs_modulus_GPa", 3.0, 210.0),
]


@cache
def designs(name):
    """Four designs of a machine together, and the last of them built alone."""
    spec, rules = MACHINES[name]
    given = Load(inertia_kgm2=1.0, friction=0.1)
    spec = spec.replace(
        load=given,
        tolerance=Tolerance(roller_diameter_mm=0.01),
        shaft=Shaft(wheel_span_mm=40.0, shear_stress_max_MPa=60.0),
        material_wheel=WheelMaterial(wear_mm3_Nm=1e-8),
        material_roller=RollerMaterial(dynamic_capacity_N=5000.0),
        motor=Motor(speed_variation=0.05, gear_efficiency=0.8),
        support=Support(radius_mm=100.0, force_N=50.0),
    )
    if spec.drive.ONE_ARM:
        spec = spec.with_("tolerance.crank_radius_mm", 0.02)
    carried = CARRIED
    if spec.drive.cranks[1:]:  # [tolerance] has no key for the places of several
        spec = spec.replace(tolerance=Tolerance())
        carried = [rule for rule in CARRIED if not rule[0].startswith("tolerance.")]
    varied = drawn([*rules, *carried], 24, 7)
    built = many(spec, varied).which[:4]
    varied = {key: values[built] for key, values in varied.items()}
    found = many(spec, varied)
    assert not found.refused.any()
    return found.machine, [(i, alone(spec, varied, i)) for i in [len(built) - 1]]


def same(found, i, one, close=ULPS, size=0.0):
    """The i-th of many answers against that of a design, in units of it or of a greater size."""
    if found is None:
        assert one is None
        return
    here = np.ravel(found)[i if np.size(found) > 1 else 0]
    if one is None:
        assert np.isnan(here)
    else:
        assert here == pytest.approx(float(one), rel=close, abs=max(close * size, 1e-300))


def records(many, i, one, size=0.0, close=ULPS, places=1e-9):
    """Numbers by their names; input angles to the root of a rounding, as tops are flat."""
    found = many._asdict()
    for name in type(one)._fields if one else found:
        near = (places, 1.0) if name.endswith("deg") else (close, size)
        if name in found:
            same(found[name], i, one and one._asdict()[name], *near)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", KINDS)
def test_shocks(name):
    machine, each = designs(name)
    entry, back = impacts.entry_impacts(machine), impacts.reversal_impacts(machine)
    drag = change_of_sides.lasting_drag_Nm(machine)
    for i, one in each:
        records(entry, i, impacts.entry_impacts(one).only)
        records(back, i, impacts.reversal_impacts(one).only)
        same(impacts.mouth_jumps_worst(machine), i, impacts.mouth_jumps_worst(one).item())
        # what the inertia asks for less what resists: in units of either
        same(drag, i, change_of_sides.lasting_drag_Nm(one), size=one.spec.load.torque_Nm)


def test_answers_of_one_design_are_not_the_first_of_many():
    """Asked of several, they refuse."""
    machine, _ = designs("modified-trapezoid")
    for ask in (
        lambda several: impacts.entry_impacts(several).only,
        lambda several: impacts.reversal_impacts(several).only,
        undercut.undercut,
    ):
        with pytest.raises(ValueError, match=r"size 1|ambiguous"):
            ask(machine)


@pytest.mark.parametrize("name", MACHINES)
def test_states(name):
    machine, each = designs(name)
    for number, engagement in enumerate(machine.engagements):
        x = engagement.entry_deg + engagement.motion_deg * np.linspace(0.0, 1.0, 6)
        found, first = state(machine, engagement, x), state(machine, engagement, -1.0)
        for i, one in each:
            own = np.broadcast_to(x, (i + 1, 6))[i]
            told = state(one, one.engagements[number], own)
            at = state(one, one.engagements[number], -1.0)
            for name_, rows in told._asdict().items():
                both = (np.atleast_2d(v._asdict()[name_]) for v in (found, first))
                here, there = (v[min(i, len(v) - 1)] for v in both)
                assert here == pytest.approx(rows, rel=SEARCHED, abs=SEARCHED), name_
                assert there == pytest.approx([at._asdict()[name_]], rel=SEARCHED), name_


@pytest.mark.parametrize("name", MACHINES)
def test_walls_of_curved_slots(name):
    machine, each = designs(name)
    cut, drives = undercut.undercuts(machine), positive.positive_drives(machine)
    for i, one in each:
        found, driven = undercut.undercut(one), positive.positive_drives(one)
        if cut is None:
            assert found is driven is drives is None
            continue
        records(cut, i, found, one.center_distance_mm)
        if found:
            assert (found.wall == "left") == cut.left[i]
        for name_ in driven._fields[:4]:  # numbers of each design
            near = (1e-9, 1.0) if name_.endswith("deg") else (ULPS, one.center_distance_mm)
            same(getattr(drives, name_), i, getattr(driven, name_).item(), *near)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", KINDS)
def test_shafts(name):
    machine, each = designs(name)
    on = shafts.on_crank
    shaft = machine.spec.shaft
    asked = [(shafts.wheel_shaft, shafts.on_wheel)]
    if machine.spec.wheel.FLAT:
        asked.append((shafts.crank_shaft, on))
    for ends, loaded in asked:
        found = shafts.shafts_under_load(machine, ends(shaft), loaded)
        for i, one in each:
            alone_ = shafts.shafts_under_load(one, ends(one.spec.shaft), loaded)
            alone_ = shafts.ShaftStress(*only_of(alone_))
            records(found, i, alone_, close=SEARCHED, places=PLACE)


def horn_sizes(machine):
    """Half a slot's width, and a recess that leaves a horn of a tenth to a third of the room."""
    half_width = machine.roller_radius_mm + machine.spec.size.slot_clearance_mm
    x, y = machine.engagements[0].path(machine.engagements[0].entry_deg, 0)
    room = machine.center_distance_mm * np.hypot(x.c[0] - 1.0, y.c[0]) - half_width
    return half_width, room * np.linspace(0.65, 0.9, 4)[:, None]


DRAWN = [name for name in KINDS if MACHINES[name][0].is_flat]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", DRAWN)
def test_horns(name):
    """Of given sizes, at angles of all designs and of each; without a recess there is no horn."""
    machine, each = designs(name)
    half_width, recess = horn_sizes(machine)
    recess[0] = 0.0
    found = horn.horn_stresses(machine, half_width, recess, machine.spec.size.face_width_mm)
    assert np.isnan(found.stress_MPa[0])
    x = np.broadcast_to(machine.engagements[0].entry_deg * np.linspace(1.0, 0.1, 5), (4, 5))
    walls = [
        [side.thickness(*side.wall(at)) for side in horn.horns(machine, half_width, recess)]
        for at in (x, x[:, 1:2])
    ]
    for i, one in each:
        sizes = half_width[i].item(), recess[i].item()
        alone_ = horn.horn_stresses(one, *sizes, one.spec.size.face_width_mm).single
        assert alone_ is not None
        records(found, i, alone_, close=SEARCHED, places=PLACE)
        for number, side in enumerate(horn.horns(one, *sizes)):
            thick = side.thickness(*side.wall(x[i]))[0]
            # a difference of the recess's radius and one as large
            close = {"rel": ULPS, "abs": ULPS * sizes[1]}
            assert walls[0][number][i] == pytest.approx(thick, **close)
            assert walls[1][number][i] == pytest.approx(thick[1:2], **close)


@pytest.mark.parametrize("name", ["crank", "internal", "unequal steps", "modified-trapezoid"])
def test_locks(name):
    """Corners sharp and rounded, ends of short discs, arcs that touch, and no torque or clearance.

    The play is a difference of angles: in units of a radian.
    """
    machine, _ = designs(name)
    varied = {"load.dwell_torque_Nm": np.array([0.0, 2.0, 4.0, 6.0, 8.0, 9.0])}
    varied["size.face_width_mm"] = np.linspace(5.0, 20.0, 6)
    sign, (z, L) = machine.spec.wheel.SIGN, (6, 100.0)
    base = MACHINES[name][0].with_("wheel.z", z).replace(load=Load(torque_Nm=1.0))
    found = many(base, varied)
    assert not found.refused.any()
    disc = np.array([38.0, 38.0, 39.0, 40.0, 30.0, 38.0])[:, None]
    clear = np.array([0.5, 0.02, 0.1, 0.0, 0.2, 0.3])[:, None]
    half = np.array([2.0, 2.0, 1.8, 2.0, 2.5, 0.5])[:, None]
    edge = np.array([0.5, 0.5, 0.0, 1.0, 0.1, 0.2])[:, None]
    by = Lock(L, sign, disc, disc + clear, 86.0, half, edge)
    told = lock.loaded_locks(found.machine, 5.0, by, found.machine.spec.size.face_width_mm)
    kinds = {"corner", "disc's end"} if sign > 0.0 else {"recess", "disc's end"}
    assert set(np.ravel(told.on)) == kinds
    assert np.isnan(told.force_N[0])
    for i in range(6):
        own = Lock(L, sign, *(v[i].item() for v in (disc, disc + clear)), 86.0, half[i].item())
        own = own._replace(edge=edge[i].item())
        one = alone(base, varied, i)
        alone_ = lock.loaded_locks(one, 5.0, own, one.spec.size.face_width_mm)
        if alone_ is None:
            assert i == 0
            continue
        on, *rows = alone_
        assert on == told.on[i, 0]
        alone_ = lock.LockUnderTorque(on, *only_of(rows))
        for field in alone_._fields[1:]:
            radian = 60.0 if field == "play_deg" else 0.0
            same(getattr(told, field), i, getattr(alone_, field), size=radian)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", KINDS)
def test_rollers(name):
    machine, each = designs(name)
    ways = roller.passages(machine)
    life = roller.lives(machine, roller.by_roller(machine))
    worn = wears_mm(machine, [way.rubbing_N for way in ways])
    for i, one in each:
        for way, passage in zip(ways, roller.passages(one), strict=True):
            records(way, i, passage, close=SUMMED)
        records(
            life, i, roller.Life(*only_of(roller.lives(one, roller.by_roller(one)))), close=SUMMED
        )
        rubbing_N = [passage.rubbing_N for passage in roller.passages(one)]
        same(worn, i, wears_mm(one, rubbing_N).item(), SUMMED)


def test_a_roller_that_turns_back_thrice_in_its_slot():
    """An epicyclic drive's: its way is what its distance from the wheel's axis goes up and down."""
    _, each = designs("epicyclic")
    one = each[0][1]
    engagement = one.engagements[0]
    x, y = engagement.path(np.linspace(engagement.entry_deg, engagement.exit_deg, 200_001), 0)
    far = np.diff(np.hypot(x.c[0], y.c[0])) * one.center_distance_mm / 1000.0
    assert (np.sign(far[1:]) != np.sign(far[:-1])).sum() == 3
    # a top between two of the angles is less than 1e-10 of the way above both
    assert roller.passages(one)[0].travel_m == pytest.approx(abs(far).sum(), rel=1e-9)


@pytest.mark.sampled(16)
@pytest.mark.parametrize("name", KINDS)
def test_sizing(name):
    """The work that swings is a difference of sums: 1e-12 of the torque's, as its mean is."""
    machine, each = designs(name)
    found = sizings(machine)
    for i, one in each:
        told, _ = sizing(Cycle(one))
        for field in SIZING_NAMES:
            same(found.get(field), i, told[field], SUMMED)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", MACHINES)
def test_tolerances(name):
    """Angles are differences of directions: rounding is a share of a radian's.

    The root of the squares is told at the worst's place, which is known to 1e-7 of itself.
    """
    machine, each = designs(name)
    plays, jumps = motion_plays(machine), entry_jumps_worst(machine, used(machine))
    for i, one in each:
        use = list(used(one).values())
        if plays is None:
            assert motion_errors(one) == []
            continue
        if one.spec.tolerance == Tolerance():  # nothing deviates
            assert np.isnan(plays.worst_deg[i])
            continue
        every = [(error, error.greatest(corners(use))) for error in motion_errors(one)]
        error, at = max(every, key=lambda found: found[1].error[0])
        there = partial(error, input_deg=at.at_deg[0], side=at.side[0])
        told = spread(there, use, at.error[0], np.zeros(1))
        same(plays.worst_deg, i, told.worst, size=10.0)
        same(plays.rss_deg, i, told.rss, 1e-7)
        jump = entry_jumps_worst(one, used(one))
        assert (jumps is None) == (jump is None)
        if jumps is not None:
            same(jumps, i, jump[0])


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", KINDS)
def test_vibration(name):
    """A share is what is left of a swing many times as large: within 1e-13 of the step."""
    machine, each = designs(name)
    found = design_vibrations(machine)
    for i, one in each:
        told = values(one, required_oscillator(one))
        for field, value in found._asdict().items():
            step = (
                1.0 if field.endswith("deg") else math.degrees(2.0 * one.engagements[0].half_step)
            )
            same(value, i, told[field], 1e-13, step)
