"""Peaks of large batches of designs of every machine.

They are compared with single designs and with scripts: a grid over a handbook's formulas, or the
closed form of a law. The manual's table of designs per second comes from here and from ``sweep``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

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
from bench.method import Method, Subject, Task
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many, worst_peaks
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peaks import peak
from geneva_cli.numerics.jet import Array

PEAK_QUANTITIES = ("velocity", "acceleration")


def subject(quick: bool) -> Subject:
    """One task for each machine."""
    return Subject(
        "Peaks of velocity and acceleration of many designs of every machine",
        f"greatest relative error of {QUICK_CHECKED if quick else CHECKED} designs' peaks against "
        "the search of one design",
        [_task(kind, QUICK if quick else kind.designs) for kind in KINDS],
        floor=1e-14,
    )


def _task(kind: VariedMachine, count: int) -> Task:
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
    return task_of_many(f"{built} {kind.name}", built, partial(_error, truth), methods)


def _built_together(spec: Spec, varied: Mapping[str, Any]) -> Array:
    machine = many(spec, varied).machine
    assert machine is not None
    return _together(machine)


def _together(machine: Mechanism) -> Array:
    peaks = worst_peaks(machine, PEAK_QUANTITIES)
    both: Array = np.column_stack([peaks[name].max for name in PEAK_QUANTITIES])
    return both


def _one(machine: Mechanism) -> list[float]:
    """Peaks of one design, by its own search."""
    motion = machine.engagements[0].motion
    return [peak(motion, name).max for name in PEAK_QUANTITIES]


def _error(truth: Array, peaks: Sequence[Array] | Array) -> float:
    """Greatest relative error of the first designs."""
    known = truth[: len(peaks)]
    return float(np.abs(np.array(peaks[: len(known)]) / known - 1.0).max())
