"""Loads, strength, motor, vibration, impacts and play of a batch of designs.

They are compared with the same designs one by one, as no other program computes them.
"""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np

from bench.kinds import KINDS, QUICK, VariedMachine, drawn, one_by_one, task_of_many
from bench.method import Method, Subject, Task
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.wheels.external import External
from geneva_cli.numerics.jet import Array
from geneva_cli.spec.tables import Load, Shaft, Tolerance
from geneva_cli.study.batches import columns


class LoadedMachine(NamedTuple):
    """A machine under load, and the torque that resists in addition to friction."""

    kind: VariedMachine
    torque_Nm: float = 0.0


class QuantityRequest(NamedTuple):
    """Quantities that are requested of each design, under a name."""

    name: str
    quantities: tuple[str, ...]


THREE = ("pin_force_N", "input_torque_Nm", "contact_stress_MPa")
LOADS = (
    QuantityRequest("greatest pin force", ("loads.pin_force_N.max",)),
    QuantityRequest(
        "extremes and means of three loads",
        tuple(f"loads.{name}.{what}" for name in THREE for what in ("max", "min", "mean", "rms")),
    ),
)
# what is computed of side-cranks alone
OTHERS = (
    QuantityRequest("moment in a shaft", ("strength.wheel_shaft.moment_Nm",)),
    QuantityRequest("stress in a horn", ("strength.horn.stress_MPa",)),
    QuantityRequest("equivalent force of a roller", ("life.equivalent_force_N",)),
    QuantityRequest("motor and flywheel", ("sizing.motor_torque_rms_Nm",)),
    QuantityRequest("dynamic factor", ("vibration.dynamic_factor",)),
    QuantityRequest("jump at entry", ("shock.entry.jump",)),
    QuantityRequest("jump at a change of sides", ("shock.reversal.jump",)),
    QuantityRequest("play of a motion", ("tolerance.motion_play.worst_deg",)),
)


def loaded_machines() -> tuple[LoadedMachine, ...]:
    """Return the machines whose loads are computed; all of their loads are bounded."""
    by_name = {kind.name: kind for kind in KINDS}
    # At mid-motion the pin crosses the radius. Its force there is bounded without a torque, or if
    # friction holds it; and no wall is sharper than the roller.
    spec = Spec(External(4), motion=Motion(ModifiedSine()))
    curved = VariedMachine("curved slots", spec, "motion.alpha0_deg", -110, -35)
    names = ("side-crank", "plain crank", "spherical", "elliptical gears", "four-bar")
    return (*(LoadedMachine(by_name[name]) for name in names), LoadedMachine(curved, 10.0))


def subject(quick: bool) -> Subject:
    """One task for each request to each machine, with friction and without."""
    machines = loaded_machines()
    side_crank = machines[0]
    tasks = [_task(request, side_crank, 0.1, quick) for request in OTHERS]
    for loaded in machines[:1] if quick else machines:
        for friction in (0.1,) if quick else (0.0, 0.1):
            tasks += [_task(request, loaded, friction, quick) for request in LOADS]
    return Subject(
        "Results of a sweep for a batch of designs; no other program computes them",
        "greatest relative error against the results of single designs",
        tasks,
        floor=1e-12,
        seconds=0.2,  # for each of some seventy methods
    )


def _task(request: QuantityRequest, loaded: LoadedMachine, friction: float, quick: bool) -> Task:
    kind = loaded.kind
    spec = kind.spec.replace(
        size=kind.spec.size.replace(face_width_mm=10.0, slot_clearance_mm=0.01),
        load=Load(1.0, loaded.torque_Nm if friction else 0.0, friction=friction),
        shaft=Shaft(
            stiffness_Nm_rad=5e3, damping_ratio=0.02, wheel_diameter_mm=20.0, wheel_overhang_mm=30.0
        ),
        tolerance=Tolerance(crank_radius_mm=0.02, slot_width_mm=0.02),
    )
    machine, built, alone = drawn(kind, spec, QUICK if quick else min(4_096, kind.designs))
    names = request.quantities
    truth = np.array([_values(names, 1, one)[0] for one in alone])
    methods = [
        one_by_one(alone, built, partial(_alone, names), 2 if quick else 5),
        Method("together", None, partial(_values, names, built, machine), True),
    ]
    name = f"{request.name} of {built} {kind.name}" + (" with friction" if friction else "")
    return task_of_many(name, built, partial(_error, truth), methods)


def _values(names: tuple[str, ...], count: int, machine: Mechanism) -> Array:
    """Return the quantities of the designs of a machine: (count, quantities)."""
    values = columns(machine, names, count)
    assert values is not None, names
    return np.column_stack(values)


def _alone(names: tuple[str, ...], machine: Mechanism) -> Array:
    """Return the quantities of one design, which is built anew, as results are cached."""
    return _values(names, 1, build(machine.spec))


def _error(truth: Array, computed: Array | list[Array]) -> float:
    """Return the greatest relative error of the first designs; where 0 is right, the error."""
    values = np.reshape(computed, (-1, truth.shape[1]))[: len(truth)]
    exact = truth[: len(values)]
    return float((np.abs(values - exact) / np.where(exact == 0.0, 1.0, np.abs(exact))).max())
