"""Peaks and loads of large batches of designs of every machine.

They are compared with single designs and with scripts: a grid over a handbook's formulas, or the
closed form of a law. The manual's table of
designs per second comes from this subject.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from geneva_cli.analysis.peak_search import worst_peaks
from geneva_cli.analysis.peaks import peak
from geneva_cli.bench import loads_of_many
from geneva_cli.bench.kinds import (
    CHECKED,
    KINDS,
    QUICK,
    QUICK_CHECKED,
    VariedMachine,
    cranks_by_numba,
    drawn,
    one_by_one,
    task_of_many,
    values_of,
)
from geneva_cli.bench.loads_of_many import EXACT, LOOP, QUICK_EXACT, QUICK_LOOP, first_errors
from geneva_cli.bench.method import Method, Subject, Task, missing
from geneva_cli.machine.many import many, taken
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.extrema import BLOCK as SCANNED
from geneva_cli.numerics.extrema import SCAN_INTERVALS

if TYPE_CHECKING:
    from geneva_cli.kinematics.engagement import WheelMotion
    from geneva_cli.numerics.jet import Array

PEAK_QUANTITIES = ("velocity", "acceleration")


def subject(quick: bool) -> Subject:
    """One task for each machine, and one for each request to the loads of some machines."""
    peaks = [_task(kind, QUICK if quick else kind.designs) for kind in KINDS]
    return Subject(
        "Peaks of velocity, acceleration and loads of many designs of every machine",
        f"greatest relative error of {QUICK_CHECKED if quick else CHECKED} designs' peaks against "
        f"the search of one design; of loads of {QUICK_EXACT if quick else EXACT} cranks and "
        "side-cranks against 50 digits",
        [*peaks, *loads_of_many.tasks(quick)],
        floor=1e-14,
        seconds=0.2,  # for each of two hundred methods
        absent=missing("numba"),
    )


def _task(kind: VariedMachine, count: int) -> Task:
    machine, built, alone = drawn(kind, kind.spec, count)
    values = values_of(kind, count)
    varied, script = {kind.key: values}, kind.script and partial(kind.script, values)
    compiled = None
    if kind.cranks and not missing("numba"):
        compiled = partial(cranks_by_numba, *kind.cranks(values))
    methods = [
        one_by_one(alone, built, _one, LOOP if built > QUICK else QUICK_LOOP),
        *([Method("a handbook's formulas in NumPy", None, script)] if script else []),
        *([Method("a handbook's formulas by Numba", None, compiled)] if compiled else []),
        *_formulas_alone(machine, built),
        Method("together", None, partial(_together, machine), True),
        Method("built and together", None, partial(_built_together, kind.spec, varied), True),
    ]
    truth = np.array([_one(m) for m in alone])
    return task_of_many(f"{built} {kind.name}", built, partial(first_errors, truth), methods)


def _built_together(spec: Spec, varied: Mapping[str, Any]) -> Array:
    machine = many(spec, varied).machine
    assert machine is not None
    return _together(machine)


def _together(machine: Mechanism) -> Array:
    peaks = worst_peaks(machine, PEAK_QUANTITIES)
    both: Array = np.column_stack([peaks[name].max for name in PEAK_QUANTITIES])
    return both


def _formulas_alone(machine: Mechanism, count: int) -> list[Method]:
    """Method of the formulas alone, at all places of the scan, without a search.

    None for machines whose peaks are computed in another way.
    """
    motion = machine.engagements[0].motion
    if motion.closed_peak(PEAK_QUANTITIES[0]) is not None:
        return []
    pieces = list(pairwise(motion.breaks_deg))
    pieces = pieces[: len(pieces) // 2] if motion.symmetric else pieces
    places = len(pieces) * (SCAN_INTERVALS + 1)
    run = partial(_at_places, motion, count, pieces)
    return [Method("formulas alone, nothing searched", places, run)]


def _at_places(motion: WheelMotion, count: int, pieces: list[tuple[float, float]]) -> Array:
    """Greatest of the values at the places."""
    most = np.zeros((count, len(PEAK_QUANTITIES)))
    for piece in pieces:
        a, b = (np.broadcast_to(np.reshape(end, (-1, 1)), (count, 1)) for end in piece)
        for i in range(0, count, SCANNED):
            which = slice(i, i + SCANNED)
            x = a[which] + (b - a)[which] * (np.arange(SCAN_INTERVALS + 1) / SCAN_INTERVALS)
            rates = taken(motion, which).rough_rates(np.asfortranarray(x), len(PEAK_QUANTITIES))
            for k, rate in enumerate(rates[: len(PEAK_QUANTITIES)]):
                np.maximum(most[which, k], np.abs(rate).max(axis=1), out=most[which, k])
    return most


def _one(machine: Mechanism) -> list[float]:
    """Peaks of one design, by its own search."""
    motion = machine.engagements[0].motion
    return [peak(motion, name).max for name in PEAK_QUANTITIES]
