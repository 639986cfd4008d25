"""Loads of very many designs together, beside one design after the other, and beside the formulas.

A machine's loads are asked for one by one (the greatest pin force, input torque and contact stress;
the root mean squares of the three), and all at once with both extremes. Every design turns: none
has a load without a bound. What no search can pass is the time of the formulas alone, at as few
places as tell the answer: that is a row of its own, ``formulas alone``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.contact import mirrored
from geneva_cli.analysis.loads.cycle import Cycle
from geneva_cli.analysis.loads.forces import setting
from geneva_cli.analysis.loads.loaded_many import NONE, Loaded, machine
from geneva_cli.analysis.loads.many import greatest_of_many, summaries_of_many
from geneva_cli.analysis.loads.means_many import means_of_many, powers
from geneva_cli.analysis.loads.quantities import SQUARED
from geneva_cli.analysis.loads.stretches import spans_of
from geneva_cli.analysis.loads.summary import summaries
from geneva_cli.bench import load_truth
from geneva_cli.bench.kinds import KINDS, QUICK, Kind, drawn, one_by_one, task_of_many, values_of
from geneva_cli.bench.load_truth import LOADS
from geneva_cli.bench.method import Method, Task
from geneva_cli.machine.laws.standard import ModifiedSine
from geneva_cli.machine.many import taken
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.spec import Motion, Spec
from geneva_cli.machine.wheels.external import External
from geneva_cli.numerics.chebyshev import POINTS
from geneva_cli.numerics.quadrature import rule
from geneva_cli.numerics.quadrature_many import NODES
from geneva_cli.spec.tables import Load

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

LOADS_OF = 4_096  # designs whose loads are had
EXACT, QUICK_EXACT = 4, 1  # designs whose loads are had by 50 digits
LOOP, QUICK_LOOP = 5, 2  # designs that are had one after the other
BLOCK = 512


class LoadedKind(NamedTuple):
    """A machine whose loads are had, and the torque that resists beside friction."""

    kind: Kind
    torque_Nm: float = 0.0
    A: Callable[[float], float] | None = None  # a side-crank's, by what is varied; None: another


BY_NAME = {kind.name: kind for kind in KINDS}
# Their force at mid-motion, where the pin crosses the radius, has a bound without a torque, or with
# friction that holds it; and no wall is sharper than the roller.
CURVED = Kind(
    "curved slots", Spec(External(4), motion=Motion(ModifiedSine())), "motion.alpha0_deg", -110, -35
)
LOADED = (
    LoadedKind(BY_NAME["side-crank"], A=lambda A: A),
    LoadedKind(BY_NAME["plain crank"], A=lambda z: 0.0),
    LoadedKind(BY_NAME["spherical"]),
    LoadedKind(BY_NAME["elliptical gears"]),
    LoadedKind(CURVED, torque_Nm=10.0),
    LoadedKind(BY_NAME["four-bar"]),
)


class Asked(NamedTuple):
    """What is asked of the loads of each design."""

    name: str
    loads: tuple[str, ...]
    sized: bool  # their greatest sizes
    summed: bool  # their root mean squares


ASKED = (
    Asked("greatest pin force", LOADS[:1], True, False),
    Asked("greatest input torque", LOADS[1:2], True, False),
    Asked("greatest contact stress", LOADS[2:], True, False),
    Asked("rms of the three loads", LOADS, False, True),
    Asked("extremes and rms of the three", LOADS, True, True),
)


def tasks(quick: bool) -> list[Task]:
    """What is asked of each machine, with friction and without."""
    found = []
    for loaded in LOADED[:1] if quick else LOADED:
        count = QUICK if quick else min(LOADS_OF, loaded.kind.most)
        for friction in (0.1,) if quick else (0.0, 0.1):
            of = _designs(loaded, count, friction)
            found += [_task(asked, *of) for asked in (ASKED[2:] if quick else ASKED)]
    return found


class Designs(NamedTuple):
    """Of a machine: many designs together, the first ones alone, and A of those that have one."""

    name: str
    together: Mechanism
    alone: list[Mechanism]
    A: list[float]


def _designs(loaded: LoadedKind, count: int, friction: float) -> tuple[Designs, int]:
    kind, torque = loaded.kind, loaded.torque_Nm if friction else 0.0
    load = Load(inertia_kgm2=1.0, torque_Nm=torque, friction=friction)
    spec = kind.spec.replace(load=load, size=kind.spec.size.replace(face_width_mm=10.0))
    together, built, alone = drawn(kind, spec, count)
    exact = values_of(kind, count)[: QUICK_EXACT if count <= QUICK else EXACT].tolist()
    A = [loaded.A(value) for value in exact] if loaded.A else []
    name = f"{built} {kind.name}" + (" with friction" if friction else "")
    return Designs(name, together, alone, A), built


def _task(asked: Asked, of: Designs, built: int) -> Task:
    most = LOOP if built > QUICK else QUICK_LOOP
    methods = [
        one_by_one(of.alone, built, partial(_one, asked), most),
        Method(
            "formulas alone, nothing searched",
            _places(asked, of.together, built),
            partial(_formulas, asked, of.together, built),
        ),
        Method("together", None, partial(_together, asked, of.together), True),
    ]
    if of.A:
        both = zip(of.alone, of.A, strict=False)
        truth = np.array([_exact(asked, machine, A) for machine, A in both])
    else:
        truth = np.array([_one(asked, machine) for machine in of.alone])
    return task_of_many(f"{asked.name} of {of.name}", built, partial(first_errors, truth), methods)


def first_errors(truth: Array, every: Sequence[Array] | Array) -> float:
    """The greatest relative error of the first designs; a load that both say has no bound is
    right.
    """
    found, truth = np.array(every[: len(truth)]), truth[: len(every)]
    with np.errstate(invalid="ignore"):
        wrong = np.where(found == truth, 0.0, np.abs(found / truth - 1.0))
    return float(wrong.max())


def _exact(asked: Asked, machine: Mechanism, A: float) -> list[float]:
    """By 50 digits."""
    which = [LOADS.index(name) for name in asked.loads]
    sizes = load_truth.greatest(machine, A) if asked.sized else ()
    sums = load_truth.roots(machine, A) if asked.summed else ()
    return [every[k] for every in (sizes, sums) if every for k in which]


def _one(asked: Asked, machine: Mechanism) -> list[float]:
    """By the search and the sums of one design."""
    cycle, out = Cycle(machine), []
    if asked.sized:
        out = [max(one.max, -one.min) for one in map(cycle.extremes.__getitem__, asked.loads)]
    if asked.summed:
        found = summaries(cycle)
        out += [rms for name in asked.loads if (rms := found[name].rms) is not None]
    return out


def _together(asked: Asked, machine: Mechanism) -> Array:
    if not asked.summed:
        greatest = greatest_of_many(machine, asked.loads).values()
        return np.column_stack([one.max for one in greatest])
    if not asked.sized:
        means = means_of_many(machine, asked.loads, told=("rms",)).values()
        return np.column_stack([one.rms for one in means])
    found = summaries_of_many(machine, asked.loads, told=("rms",)).values()
    sizes = [np.maximum(one.max, -one.min) for one in found]
    return np.column_stack([*sizes, *[one.rms for one in found if one.rms is not None]])


def _places(asked: Asked, machine: Mechanism, count: int) -> int:
    """How many places of a motion the formulas are worked out at, in the mean of the designs."""
    spans = spans_of(machine.engagements[0], count)
    return len(spans) * (len(POINTS) * asked.sized + NODES * asked.summed)


def _formulas(asked: Asked, mechanism: Mechanism, count: int) -> Array:
    """What samples and Gauss's rule tell, of as many places as our search begins with."""
    found = []
    every = machine(mechanism.engagements[0], setting(mechanism), asked.loads, NONE)
    period = np.broadcast_to(np.ravel(mechanism.period_deg), (count,))
    for i in range(0, count, BLOCK):
        n = min(BLOCK, count - i)
        load = Loaded(taken(every, slice(i, i + n)), asked.loads)
        rows = [_sampled(load, n)] if asked.sized else []
        if asked.summed:
            rows.append(
                np.sqrt(_summed(load, n) / (period[i : i + n] if period.size > 1 else period))
            )
        found.append(np.concatenate(rows))
    return np.concatenate(found, axis=1).T


def _sampled(load: Loaded, n: int) -> Array:
    """The greatest of samples."""
    spans = spans_of(load.machine[0], n)
    spans = spans[: len(spans) // 2] if load.repeats else spans
    most = np.zeros((load.wanted, n))
    for a, b in spans:
        x = np.asfortranarray(0.5 * (a + b) + 0.5 * (b - a) * POINTS)
        _, (value,) = load.look(load.at(x, slice(0, n), 0))
        most = np.maximum(most, np.abs(value[load.signs :]).max(axis=2))
    squared = [name in SQUARED for name in load.names]
    most[squared] = np.sqrt(most[squared])
    return most


def _summed(load: Loaded, n: int) -> Array:
    """The integrals of the squares, where no change of a sign is looked for."""
    node, weight = rule(NODES)
    spans, total = spans_of(load.machine[0], n), np.zeros((load.wanted, n))
    for a, b in spans[: len(spans) // 2] if load.mirrored else spans:
        half = 0.5 * (b - a)
        x = np.asfortranarray(0.5 * (a + b) + half * node)
        given, at, shape, wanted = state = load.at(x, np.arange(n), 0)
        states = [state, (given, mirrored(at), shape, wanted)] if load.mirrored else [state]
        for one in states:
            total += (powers(load, one, None, False) @ weight) * half[:, 0]
    return total
