"""Peaks, loads, strength, motor, vibration and play of large batches of designs.

Peaks are compared with single designs and with scripts: a grid over a handbook's formulas, or the
closed form of a law. Of the others no other program computes anything: they are compared with the
same designs one by one.
"""

from functools import partial

import numpy as np

from bench.kinds import (
    CHECKED,
    KINDS,
    QUICK,
    QUICK_CHECKED,
    VariedMachine,
    drawn,
    one_by_one,
    task_of_many,
    values_of,
)
from bench.method import Method, Subject
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many, worst_peaks
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import peak
from geneva_cli.motion.wheels.external import External
from geneva_cli.spec.tables import Load, Shaft, Tolerance
from geneva_cli.study.batches import columns

PEAK_QUANTITIES = ("velocity", "acceleration")


def peaks(quick):
    """One task for each machine."""
    return Subject(
        "Peaks of velocity and acceleration of many designs of every machine",
        f"greatest relative error of {QUICK_CHECKED if quick else CHECKED} designs' peaks against "
        "the search of one design",
        [_peak_task(kind, QUICK if quick else kind.designs) for kind in KINDS],
        floor=1e-14,
    )


def _peak_task(kind, count):
    machine, built, alone = drawn(kind, kind.spec, count)
    values = values_of(kind, count)
    varied, script = {kind.key: values}, kind.script and partial(kind.script, values)
    methods = [
        one_by_one(alone, built, _one, 5 if built > QUICK else 2),
        *([Method("a handbook's formulas in NumPy", None, script)] if script else []),
        Method("together", None, partial(_together, machine), True),
        Method("built and together", None, partial(_built_together, kind.spec, varied), True),
    ]
    truth = np.array([_one(m) for m in alone])
    return task_of_many(f"{built} {kind.name}", built, partial(_peak_error, truth), methods)


def _built_together(spec, varied):
    return _together(many(spec, varied).machine)


def _together(machine):
    peaks = worst_peaks(machine, PEAK_QUANTITIES)
    return np.column_stack([peaks[name].max for name in PEAK_QUANTITIES])


def _one(machine):
    """Peaks of one design, by its own search."""
    motion = machine.engagements[0].motion
    return [peak(motion, name).max for name in PEAK_QUANTITIES]


def _peak_error(truth, peaks):
    """Greatest relative error of the first designs."""
    known = truth[: len(peaks)]
    return float(np.abs(np.array(peaks[: len(known)]) / known - 1.0).max())


THREE = ("pin_force_N", "input_torque_Nm", "contact_stress_MPa")
LOADS = (
    ("greatest pin force", ("loads.pin_force_N.max",)),
    (
        "extremes and means of three loads",
        tuple(f"loads.{name}.{what}" for name in THREE for what in ("max", "min", "mean", "rms")),
    ),
)
# what is computed of side-cranks alone
OTHERS = (
    ("moment in a shaft", ("strength.wheel_shaft.moment_Nm",)),
    ("stress in a horn", ("strength.horn.stress_MPa",)),
    ("equivalent force of a roller", ("life.equivalent_force_N",)),
    ("motor and flywheel", ("sizing.motor_torque_rms_Nm",)),
    ("dynamic factor", ("vibration.dynamic_factor",)),
    ("jump at entry", ("shock.entry.jump",)),
    ("jump at a change of sides", ("shock.reversal.jump",)),
    ("play of a motion", ("tolerance.motion_play.worst_deg",)),
)


def loaded_machines():
    """The machines whose loads are computed, and torques in addition to friction; all bounded."""
    by_name = {kind.name: kind for kind in KINDS}
    # At mid-motion the pin crosses the radius. Its force there is bounded without a torque, or if
    # friction holds it; and no wall is sharper than the roller.
    spec = Spec(External(4), motion=Motion(ModifiedSine()))
    curved = VariedMachine("curved slots", spec, "motion.alpha0_deg", -110, -35)
    names = ("side-crank", "plain crank", "spherical", "elliptical gears", "four-bar")
    return [*((by_name[name], 0.0) for name in names), (curved, 10.0)]


def loads(quick):
    """One task for each request to each machine, with friction and without."""
    machines = loaded_machines()
    tasks = [_load_task(*request, *machines[0], 0.1, quick) for request in OTHERS]
    for machine in machines[:1] if quick else machines:
        for friction in (0.1,) if quick else (0.0, 0.1):
            tasks += [_load_task(*request, *machine, friction, quick) for request in LOADS]
    return Subject(
        "Results of a sweep for a batch of designs; no other program computes them",
        "greatest relative error against the results of single designs",
        tasks,
        floor=1e-12,
        seconds=0.2,  # for each of some seventy methods
    )


def _load_task(what, names, kind, torque_Nm, friction, quick):
    spec = kind.spec.replace(
        size=kind.spec.size.replace(face_width_mm=10.0, slot_clearance_mm=0.01),
        load=Load(1.0, torque_Nm if friction else 0.0, friction=friction),
        shaft=Shaft(
            stiffness_Nm_rad=5e3, damping_ratio=0.02, wheel_diameter_mm=20.0, wheel_overhang_mm=30.0
        ),
        tolerance=Tolerance(crank_radius_mm=0.02, slot_width_mm=0.02),
    )
    machine, built, alone = drawn(kind, spec, QUICK if quick else min(4_096, kind.designs))
    truth = np.array([_values(names, 1, one)[0] for one in alone])
    methods = [
        one_by_one(alone, built, partial(_alone, names), 2 if quick else 5),
        Method("together", None, partial(_values, names, built, machine), True),
    ]
    name = f"{what} of {built} {kind.name}" + (" with friction" if friction else "")
    return task_of_many(name, built, partial(_load_error, truth), methods)


def _values(names, count, machine):
    """Return the quantities of the designs of a machine: (count, quantities)."""
    return np.column_stack(columns(machine, names, count))


def _alone(names, machine):
    """Return the quantities of one design, which is built anew, as results are cached."""
    return _values(names, 1, build(machine.spec))


def _load_error(truth, computed):
    """Return the greatest relative error of the first designs; where 0 is right, the error."""
    values = np.reshape(computed, (-1, truth.shape[1]))[: len(truth)]
    exact = truth[: len(values)]
    return float((np.abs(values - exact) / np.where(exact == 0.0, 1.0, np.abs(exact))).max())
