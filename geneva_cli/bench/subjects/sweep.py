"""What a sweep works out together: strength, motor, swing, blows, play.

Beside it, one design after the other.

Of side-cranks of six slots, A from -0.9 to 0.9, that carry an inertia on an elastic shaft and are
rubbed by friction.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geneva_cli.analysis.blows import entry_blow, entry_blows, reversal_blow, reversal_blows
from geneva_cli.analysis.loads.cycle import Cycle
from geneva_cli.analysis.loads.sizing import sizing, sizings_of_many
from geneva_cli.analysis.strength import horn, roller, shafts
from geneva_cli.analysis.tolerance.dimensions import corners
from geneva_cli.analysis.tolerance.many import motion_plays, used
from geneva_cli.analysis.tolerance.motion_error import motion_errors
from geneva_cli.analysis.vibration.oscillator import required_oscillator
from geneva_cli.analysis.vibration.shape import shape
from geneva_cli.analysis.vibration.vibration import loads_of, vibrations, vibrations_of_many
from geneva_cli.bench.kinds import one_by_one, task_of_many
from geneva_cli.bench.method import Method, Subject, Task
from geneva_cli.machine.drives.side_crank import SideCrank
from geneva_cli.machine.many import many
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.machine.wheels.external import External
from geneva_cli.spec.tables import Load, Shaft, Size, Tolerance

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

DESIGNS, QUICK = 4096, 100
LOOP, QUICK_LOOP = 5, 2  # designs that are had one after the other
CHECKED, QUICK_CHECKED = 20, 4  # designs whose error is measured
HORN = (5.01, 40.0, 10.0)  # half the slot's width, radius of the recess, the wheel's thickness: mm
GIVEN = Spec(
    External(6),
    SideCrank(A=0.0),
    size=Size(face_width_mm=10.0, slot_clearance_mm=0.01),
    load=Load(inertia_kgm2=1.0, friction=0.1),
    shaft=Shaft(stiffness_Nm_rad=5e3, damping_ratio=0.02, wheel_overhang_mm=30.0),
    tolerance=Tolerance(crank_radius_mm=0.02, slot_width_mm=0.02),
)


class Answer(NamedTuple):
    """A quantity: of one design, and of all of them together."""

    name: str
    one: Callable[[Mechanism], float]
    together: Callable[[Mechanism], Any]


def _shaft(machine: Mechanism) -> float:
    found = shafts.shaft(machine, shafts.wheel_shaft(machine.spec.shaft), shafts.on_wheel)
    assert found is not None
    return found.moment_Nm


def _shafts(machine: Mechanism) -> Any:
    ends = shafts.wheel_shaft(machine.spec.shaft)
    found = shafts.shaft_of_many(machine, ends, shafts.on_wheel)
    return found and found.moment_Nm


def _horn(machine: Mechanism) -> float:
    found = horn.horn(machine, *HORN)
    assert found is not None
    return found.stress_MPa


def _force(machine: Mechanism) -> float:
    found = roller.life(machine)
    assert found is not None
    return found.equivalent_force_N


def _motor(machine: Mechanism) -> float:
    found = sizing(Cycle(machine))[0]["motor_torque_rms_Nm"]
    assert found is not None
    return found


def _swing(machine: Mechanism) -> float:
    shape.cache_clear()
    loads = loads_of(machine, required_oscillator(machine))
    return float(vibrations(loads, ("dynamic_factor",)).dynamic_factor[0])


def _swings(machine: Mechanism) -> Any:
    found = vibrations_of_many(machine, ("dynamic_factor",))
    return found and found.dynamic_factor


def _jump(found: Any) -> float:
    return 0.0 if found is None else abs(found.jump)


def _play(machine: Mechanism) -> float:
    found = motion_errors(machine)[0].greatest(corners(list(used(machine).values())))
    return float(np.degrees(found.error[0]))


def _plays(machine: Mechanism) -> Any:
    found = motion_plays(machine)
    return found and found.worst_deg


ANSWERS = (
    Answer("moment in a shaft", _shaft, _shafts),
    Answer("stress in a horn", _horn, lambda machine: horn.horn_of_many(machine, *HORN).stress_MPa),
    Answer(
        "equivalent force of a roller",
        _force,
        lambda machine: roller.lives(machine, roller.passages(machine)).equivalent_force_N,
    ),
    Answer(
        "motor and flywheel",
        _motor,
        lambda machine: sizings_of_many(machine)["motor_torque_rms_Nm"],
    ),
    Answer("dynamic factor", _swing, _swings),
    Answer(
        "jump at entry",
        lambda machine: _jump(entry_blow(machine)),
        lambda machine: abs(entry_blows(machine).jump),
    ),
    Answer(
        "jump at a change of sides",
        lambda machine: _jump(reversal_blow(machine)),
        lambda machine: np.nan_to_num(abs(reversal_blows(machine).jump)),
    ),
    Answer("play of a motion", _play, _plays),
)


def subject(quick: bool) -> Subject:
    """A task a quantity."""
    count, checked = (QUICK, QUICK_CHECKED) if quick else (DESIGNS, CHECKED)
    A = np.random.default_rng(12).uniform(-0.9, 0.9, count)
    machine = many(GIVEN, {"drive.A": A}).machine
    assert machine is not None
    alone = [build(GIVEN.with_("drive.A", a)) for a in A[:checked].tolist()]
    return Subject(
        "What a sweep works out of many designs together",
        f"greatest relative error of {checked} designs, against the answer of one design",
        [_task(answer, machine, count, alone) for answer in ANSWERS],
        floor=1e-12,
    )


def _task(answer: Answer, machine: Mechanism, count: int, alone: list[Mechanism]) -> Task:
    most, truth = LOOP if count > QUICK else QUICK_LOOP, np.array([answer.one(m) for m in alone])
    methods = [
        one_by_one(alone, count, partial(_again, answer), most),
        Method("together", None, lambda: answer.together(machine), True),
    ]
    name = f"{answer.name} of {count} side-cranks"
    return task_of_many(name, count, partial(_error, truth), methods)


def _again(answer: Answer, machine: Mechanism) -> float:
    """The answer of a design that nothing is known of."""
    roller.passage.cache_clear()
    horn.horn.cache_clear()
    return answer.one(machine)


def _error(truth: Array, found: Any) -> float:
    there = np.asarray(found)[: len(truth)]
    known = truth[: len(there)]
    return float(np.max(np.abs(there - known) / np.where(known == 0.0, 1.0, known)))
