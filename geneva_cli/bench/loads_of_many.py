"""Loads of a large batch of designs, compared with single designs and with the formulas alone.

The loads are the greatest pin force, input torque and contact stress, and the root mean squares of
the three. They are computed one by one, and all at once with both extremes. All designs have
bounded loads. No search can be faster than the formulas alone, at as few places as give the answer.
That is a row of its own, ``formulas alone``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.contact import mirrored
from geneva_cli.analysis.forces import load_case
from geneva_cli.analysis.load_functions import NO_MORE, LoadFunctions, load_batch
from geneva_cli.analysis.quantities import SQUARED
from geneva_cli.analysis.stretches import spans_of
from geneva_cli.bench import load_truth
from geneva_cli.bench.kinds import (
    KINDS,
    QUICK,
    VariedMachine,
    drawn,
    one_by_one,
    task_of_many,
    values_of,
)
from geneva_cli.bench.load_truth import LOADS
from geneva_cli.bench.method import Method, Task
from geneva_cli.kinematics.laws.standard import ModifiedSine
from geneva_cli.kinematics.motion import Motion
from geneva_cli.kinematics.wheels.external import External
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.means import load_means, powers
from geneva_cli.loads.summaries import load_peaks, load_summaries
from geneva_cli.loads.summary import summaries
from geneva_cli.machine.many import taken
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.spec import Spec
from geneva_cli.named_tuple import NamedTuple
from geneva_cli.numerics.adaptive_quadrature import NODES
from geneva_cli.numerics.chebyshev import POINTS
from geneva_cli.numerics.quadrature import rule
from geneva_cli.spec.tables import Load

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

EXACT, QUICK_EXACT = 4, 1  # designs whose loads are computed with 50 digits
LOOP, QUICK_LOOP = 5, 2  # designs that are computed one after the other


class LoadedMachine(NamedTuple):
    """A machine whose loads are computed, and the torque that resists in addition to friction."""

    kind: VariedMachine
    torque_Nm: float = 0.0
    A: Callable[[float], float] | None = None  # of a side-crank, from the varied value


def loaded_machines() -> tuple[LoadedMachine, ...]:
    """The machines whose loads are computed; all of their loads are bounded."""
    by_name = {kind.name: kind for kind in KINDS}
    # At mid-motion the pin crosses the radius. Its force there is bounded without a torque, or if
    # friction holds it; and no wall is sharper than the roller.
    spec = Spec(External(4), motion=Motion(ModifiedSine()))
    curved = VariedMachine("curved slots", spec, "motion.alpha0_deg", -110, -35)
    return (
        LoadedMachine(by_name["side-crank"], A=lambda A: A),
        LoadedMachine(by_name["plain crank"], A=lambda z: 0.0),
        LoadedMachine(by_name["spherical"]),
        LoadedMachine(by_name["elliptical gears"]),
        LoadedMachine(curved, torque_Nm=10.0),
        LoadedMachine(by_name["four-bar"]),
    )


class LoadRequest(NamedTuple):
    """Loads that are requested of each design."""

    name: str
    loads: tuple[str, ...]
    sized: bool  # their greatest sizes
    summed: bool  # their root mean squares


def tasks(quick: bool) -> list[Task]:
    """Requests to each machine, with friction and without."""
    requests = (
        LoadRequest("greatest pin force", LOADS[:1], True, False),
        LoadRequest("greatest input torque", LOADS[1:2], True, False),
        LoadRequest("greatest contact stress", LOADS[2:], True, False),
        LoadRequest("rms of the three loads", LOADS, False, True),
        LoadRequest("extremes and rms of the three", LOADS, True, True),
    )
    machines = loaded_machines()
    out = []
    for loaded in machines[:1] if quick else machines:
        count = QUICK if quick else min(4_096, loaded.kind.designs)
        for friction in (0.1,) if quick else (0.0, 0.1):
            of = _designs(loaded, count, friction)
            out += [_task(request, *of) for request in (requests[2:] if quick else requests)]
    return out


class LoadedDesigns(NamedTuple):
    """Designs of a machine: the whole batch, the first ones alone, and the A of side-cranks."""

    name: str
    together: Mechanism
    alone: list[Mechanism]
    A: list[float]


def _designs(loaded: LoadedMachine, count: int, friction: float) -> tuple[LoadedDesigns, int]:
    kind, torque = loaded.kind, loaded.torque_Nm if friction else 0.0
    load = Load(inertia_kgm2=1.0, torque_Nm=torque, friction=friction)
    spec = kind.spec.replace(load=load, size=kind.spec.size.replace(face_width_mm=10.0))
    together, built, alone = drawn(kind, spec, count)
    exact = values_of(kind, count)[: QUICK_EXACT if count <= QUICK else EXACT].tolist()
    A = [loaded.A(value) for value in exact] if loaded.A else []
    name = f"{built} {kind.name}" + (" with friction" if friction else "")
    return LoadedDesigns(name, together, alone, A), built


def _task(request: LoadRequest, of: LoadedDesigns, built: int) -> Task:
    most = LOOP if built > QUICK else QUICK_LOOP
    methods = [
        one_by_one(of.alone, built, partial(_one, request), most),
        Method(
            "formulas alone, nothing searched",
            _places(request, of.together, built),
            partial(_formulas, request, of.together, built),
        ),
        Method("together", None, partial(_together, request, of.together), True),
    ]
    if of.A:
        both = zip(of.alone, of.A, strict=False)
        truth = np.array([_exact(request, machine, A) for machine, A in both])
    else:
        truth = np.array([_one(request, machine) for machine in of.alone])
    name = f"{request.name} of {of.name}"
    return task_of_many(name, built, partial(first_errors, truth), methods)


def first_errors(truth: Array, every: Sequence[Array] | Array) -> float:
    """Greatest relative error of the first designs; two loads without a bound agree."""
    computed, truth = np.array(every[: len(truth)]), truth[: len(every)]
    with np.errstate(invalid="ignore"):
        wrong = np.where(computed == truth, 0.0, np.abs(computed / truth - 1.0))
    return float(wrong.max())


def _exact(request: LoadRequest, machine: Mechanism, A: float) -> list[float]:
    """Loads of one design in 50 digits."""
    which = [LOADS.index(name) for name in request.loads]
    sizes = load_truth.greatest(machine, A) if request.sized else ()
    sums = load_truth.roots(machine, A) if request.summed else ()
    return [every[k] for every in (sizes, sums) if every for k in which]


def _one(request: LoadRequest, machine: Mechanism) -> list[float]:
    """Loads of one design by its own search and sums."""
    cycle, out = Cycle(machine), []
    if request.sized:
        out = [max(one.max, -one.min) for one in map(cycle.extremes.__getitem__, request.loads)]
    if request.summed:
        totals = summaries(cycle)
        out += [rms for name in request.loads if (rms := totals[name].rms) is not None]
    return out


def _together(request: LoadRequest, machine: Mechanism) -> Array:
    if not request.summed:
        greatest = load_peaks(machine, request.loads).values()
        return np.column_stack([one.max for one in greatest])
    if not request.sized:
        means = load_means(machine, request.loads, requested=("rms",)).values()
        return np.column_stack([one.rms for one in means])
    totals = load_summaries(machine, request.loads, requested=("rms",)).values()
    sizes = [np.maximum(one.max, -one.min) for one in totals]
    return np.column_stack([*sizes, *[one.rms for one in totals if one.rms is not None]])


def _places(request: LoadRequest, machine: Mechanism, count: int) -> int:
    """Mean number of places per motion at which the formulas are evaluated."""
    spans = spans_of(machine.engagements[0], count)
    return len(spans) * (len(POINTS) * request.sized + NODES * request.summed)


def _formulas(request: LoadRequest, mechanism: Mechanism, count: int) -> Array:
    """Results of samples and of Gauss's rule at as many places as the search starts with."""
    blocks, block = [], 512  # designs at a time
    every = load_batch(mechanism.engagements[0], load_case(mechanism), request.loads, NO_MORE)
    period = np.broadcast_to(np.ravel(mechanism.period_deg), (count,))
    for i in range(0, count, block):
        n = min(block, count - i)
        load = LoadFunctions(taken(every, slice(i, i + n)), request.loads)
        rows = [_sampled(load, n)] if request.sized else []
        if request.summed:
            rows.append(
                np.sqrt(_summed(load, n) / (period[i : i + n] if period.size > 1 else period))
            )
        blocks.append(np.concatenate(rows))
    return np.concatenate(blocks, axis=1).T


def _sampled(load: LoadFunctions, n: int) -> Array:
    """Greatest values of samples."""
    spans = spans_of(load.engagement, n)
    spans = spans[: len(spans) // 2] if load.repeats else spans
    most = np.zeros((load.wanted, n))
    for a, b in spans:
        x = np.asfortranarray(0.5 * (a + b) + 0.5 * (b - a) * POINTS)
        _, (value,) = load.evaluate(load.at(x, slice(0, n), 0))
        most = np.maximum(most, np.abs(value[load.signs :]).max(axis=2))
    squared = [name in SQUARED for name in load.names]
    most[squared] = np.sqrt(most[squared])
    return most


def _summed(load: LoadFunctions, n: int) -> Array:
    """Integrals of the squares, without a search for sign changes."""
    node, weight = rule(NODES)
    spans, total = spans_of(load.engagement, n), np.zeros((load.wanted, n))
    for a, b in spans[: len(spans) // 2] if load.mirrored else spans:
        half = 0.5 * (b - a)
        x = np.asfortranarray(0.5 * (a + b) + half * node)
        state = load.at(x, np.arange(n), 0)
        image = state._replace(contact=mirrored(state.contact))
        states = [state, image] if load.mirrored else [state]
        for one in states:
            total += (powers(load, one, None, False) @ weight) * half[:, 0]
    return total
