"""Batch results of a sweep: strength, motor, vibration, impacts, play.

They are compared with single designs, as no other program computes them. The designs are
side-cranks with six slots, A from -0.9 to 0.9, with an inertia on an elastic shaft and friction.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from geneva_cli.analysis import impacts
from geneva_cli.analysis.tolerance.dimensions import corners
from geneva_cli.analysis.tolerance.motion_error import motion_errors
from geneva_cli.analysis.tolerance.worst_effects import motion_plays, used
from geneva_cli.analysis.vibration.oscillator import required_oscillator
from geneva_cli.analysis.vibration.shape import shape
from geneva_cli.analysis.vibration.vibration import design_vibrations, oscillators_of, vibrations
from geneva_cli.bench.kinds import one_by_one, task_of_many
from geneva_cli.bench.method import Method, Subject, Task
from geneva_cli.kinematics.wheels.external import External
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.sizing import sizing, sizings
from geneva_cli.loads.strength import horn, roller, shafts
from geneva_cli.machine.drives.side_crank import SideCrank
from geneva_cli.machine.many import many
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.named_tuple import NamedTuple
from geneva_cli.spec.tables import Load, Shaft, Size, Tolerance

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

HORN = (5.01, 40.0, 10.0)  # half the slot's width, radius of the recess, the wheel's thickness: mm


class BatchQuantity(NamedTuple):
    """A quantity: its function of one design, and of a batch."""

    name: str
    one: Callable[[Mechanism], float]
    together: Callable[[Mechanism], Any]


def _shaft(machine: Mechanism) -> float:
    result = shafts.shaft(machine, shafts.wheel_shaft(machine.spec.shaft), shafts.on_wheel)
    assert result is not None
    return result.moment_Nm


def _shafts(machine: Mechanism) -> Any:
    ends = shafts.wheel_shaft(machine.spec.shaft)
    result = shafts.shafts_under_load(machine, ends, shafts.on_wheel)
    return result and result.moment_Nm


def _horn(machine: Mechanism) -> float:
    result = horn.horn(machine, *HORN)
    assert result is not None
    return result.stress_MPa


def _force(machine: Mechanism) -> float:
    result = roller.life(machine)
    assert result is not None
    return result.equivalent_force_N


def _motor(machine: Mechanism) -> float:
    result = sizing(Cycle(machine))[0]["motor_torque_rms_Nm"]
    assert result is not None
    return result


def _swing(machine: Mechanism) -> float:
    shape.cache_clear()
    oscillators = oscillators_of(machine, required_oscillator(machine))
    return float(vibrations(oscillators, ("dynamic_factor",)).dynamic_factor[0])


def _swings(machine: Mechanism) -> Any:
    result = design_vibrations(machine, ("dynamic_factor",))
    return result and result.dynamic_factor


def _jump(impact: Any) -> float:
    return 0.0 if impact is None else abs(impact.jump)


def _play(machine: Mechanism) -> float:
    result = motion_errors(machine)[0].greatest(corners(list(used(machine).values())))
    return float(np.degrees(result.error[0]))


def _plays(machine: Mechanism) -> Any:
    result = motion_plays(machine)
    return result and result.worst_deg


BATCH_QUANTITIES = (
    BatchQuantity("moment in a shaft", _shaft, _shafts),
    BatchQuantity(
        "stress in a horn", _horn, lambda many: horn.horn_stresses(many, *HORN).stress_MPa
    ),
    BatchQuantity(
        "equivalent force of a roller",
        _force,
        lambda machine: roller.lives(machine, roller.passages(machine)).equivalent_force_N,
    ),
    BatchQuantity(
        "motor and flywheel",
        _motor,
        lambda machine: sizings(machine)["motor_torque_rms_Nm"],
    ),
    BatchQuantity("dynamic factor", _swing, _swings),
    BatchQuantity(
        "jump at entry",
        lambda machine: _jump(impacts.entry_impact(machine)),
        lambda machine: abs(impacts.entry_impacts(machine).jump),
    ),
    BatchQuantity(
        "jump at a change of sides",
        lambda machine: _jump(impacts.reversal_impact(machine)),
        lambda machine: np.nan_to_num(abs(impacts.reversal_impacts(machine).jump)),
    ),
    BatchQuantity("play of a motion", _play, _plays),
)


def subject(quick: bool) -> Subject:
    """One task for each quantity."""
    count, checked = (100, 4) if quick else (4096, 20)
    spec = Spec(
        External(6),
        SideCrank(A=0.0),
        size=Size(face_width_mm=10.0, slot_clearance_mm=0.01),
        load=Load(inertia_kgm2=1.0, friction=0.1),
        shaft=Shaft(stiffness_Nm_rad=5e3, damping_ratio=0.02, wheel_overhang_mm=30.0),
        tolerance=Tolerance(crank_radius_mm=0.02, slot_width_mm=0.02),
    )
    A = np.random.default_rng(12).uniform(-0.9, 0.9, count)
    machine = many(spec, {"drive.A": A}).machine
    assert machine is not None
    alone = [build(spec.with_("drive.A", a)) for a in A[:checked].tolist()]
    return Subject(
        "Results of a sweep for a batch of designs; no other program computes them",
        f"greatest relative error of {checked} designs, against the result of one design",
        [_task(quantity, machine, count, alone) for quantity in BATCH_QUANTITIES],
        floor=1e-12,
    )


def _task(quantity: BatchQuantity, machine: Mechanism, count: int, alone: list[Mechanism]) -> Task:
    truth = np.array([quantity.one(m) for m in alone])
    most = 5 if len(alone) > 4 else 2  # designs that are computed one after the other
    methods = [
        one_by_one(alone, count, partial(_again, quantity), most),
        Method("together", None, lambda: quantity.together(machine), True),
    ]
    name = f"{quantity.name} of {count} side-cranks"
    return task_of_many(name, count, partial(_error, truth), methods)


def _again(quantity: BatchQuantity, machine: Mechanism) -> float:
    """The quantity of a design, with empty caches."""
    roller.passage.cache_clear()
    horn.horn.cache_clear()
    return quantity.one(machine)


def _error(truth: Array, values: Any) -> float:
    computed = np.asarray(values)[: len(truth)]
    known = truth[: len(computed)]
    return float(np.max(np.abs(computed - known) / np.where(known == 0.0, 1.0, known)))
