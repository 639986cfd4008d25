"""Peaks and greatest loads of very many designs of every machine, worked out together.

Beside them one design after the other, and a grid over all of them. Loads are pin force, input
torque and contact stress, of an inertia alone and rubbed by friction: their greatest sizes, or both
extremes and the root mean square over a period. The manual's table of designs a second is this one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.cycle import Cycle
from geneva_cli.analysis.loads.many import greatest_of_many, summaries_of_many
from geneva_cli.analysis.loads.quantities import SQUARED, ends_of
from geneva_cli.analysis.loads.summary import summaries
from geneva_cli.analysis.peaks import peak
from geneva_cli.analysis.peaks_many import worst_of_many
from geneva_cli.bench.method import Method, Subject, Task
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.drives.elliptical_gears import EllipticalGears
from geneva_cli.machine.drives.epicyclic import Epicyclic
from geneva_cli.machine.drives.four_bar import FourBar
from geneva_cli.machine.drives.geneva_pair import GenevaPair
from geneva_cli.machine.drives.side_crank import SideCrank
from geneva_cli.machine.laws.standard import ModifiedSine, SineGroup
from geneva_cli.machine.many import many, taken
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Motion as MotionKeys
from geneva_cli.machine.spec import Spec
from geneva_cli.machine.wheels.external import External
from geneva_cli.machine.wheels.internal import Internal
from geneva_cli.machine.wheels.spherical import Spherical
from geneva_cli.numerics.extrema_many import BLOCK as SCANNED
from geneva_cli.numerics.extrema_many import SCAN
from geneva_cli.spec.tables import Load, Size

if TYPE_CHECKING:
    from geneva_cli.machine.engagement import Motion
    from geneva_cli.numerics.jet import Array

DESIGNS, QUICK, FEW = 50_000, 100, 2_000
LOADS_OF = 10_000  # designs whose loads are had
LOOP, QUICK_LOOP = 5, 2  # designs that are had one after the other
CHECKED, QUICK_CHECKED = 20, 4  # designs whose error is measured
SECONDS = 0.5  # of a method's own time: there are a hundred of them
GRID, BLOCK = 101, 512
NAMES = ("velocity", "acceleration")
LOADS = ("pin_force_N", "input_torque_Nm", "contact_stress_MPa")
# machines with loads too
LOADED = ("side-crank", "plain crank", "spherical", "elliptical gears", "curved slots", "four-bar")


class Kind(NamedTuple):
    """A machine, and the key that is varied between two values."""

    name: str
    spec: Spec
    key: str
    low: float
    high: float
    most: int = DESIGNS


FOUR_BAR = FourBar(
    ground_mm=100.0, crank_mm=40.0, coupler_mm=90.0, rocker_mm=80.0, point_mm=60.0, point_deg=-40.0
)
KINDS = (
    Kind("plain crank", Spec(External(6), Crank()), "wheel.z", 3.0, 24.0),
    Kind("side-crank", Spec(External(6), SideCrank(A=0.0)), "drive.A", -0.9, 0.9),
    Kind("side-crank inside", Spec(Internal(6), SideCrank(A=0.0)), "drive.A", -0.9, 0.9),
    Kind(
        "offset slots",
        Spec(External(6), size=Size(center_distance_mm=100.0)),
        "wheel.offset_mm",
        -40.0,
        40.0,
    ),
    Kind("spherical", Spec(Spherical(6)), "wheel.axes_deg", 20.0, 160.0),
    Kind(
        "elliptical gears",
        Spec(External(6), EllipticalGears(eccentricity=0.1)),
        "drive.eccentricity",
        0.0,
        0.6,
    ),
    Kind(
        "epicyclic",
        Spec(External(4), Epicyclic(planet_ratio=0.01)),
        "drive.planet_ratio",
        -0.05,
        0.02,
    ),
    Kind(
        "curved slots",
        Spec(External(6), motion=MotionKeys(ModifiedSine())),
        "motion.alpha0_deg",
        -60.0,
        60.0,
    ),
    Kind(
        "curved slots of a tilted law",
        Spec(External(6), motion=MotionKeys(SineGroup(0.01))),
        "motion.lambda",
        -0.12,
        0.12,
    ),
    Kind("geneva pair", Spec(External(4), GenevaPair(first_z=4)), "wheel.z", 3.0, 5.0),
    Kind("four-bar", Spec(External(4), FOUR_BAR), "drive.point_deg", -50.0, -35.0, FEW),
)


def subject(quick: bool) -> Subject:
    """A task a machine, and four more of some for their loads."""
    tasks = [_task(kind, QUICK if quick else kind.most) for kind in KINDS]
    for kind in KINDS:
        if kind.name not in (LOADED[:1] if quick else LOADED):
            continue
        count = QUICK if quick else min(LOADS_OF, kind.most)
        for friction in (0.1,) if quick else (0.0, 0.1):
            tasks += [_loads_task(kind, count, friction, asked) for asked in (GREATEST, ROOTS)]
    return Subject(
        "Peaks of velocity, acceleration and loads of many designs of every machine",
        f"greatest relative error of {QUICK_CHECKED if quick else CHECKED} designs' peaks, "
        "against the search of one design",
        tasks,
        floor=1e-14,
        seconds=SECONDS,
    )


def _drawn(kind: Kind, spec: Spec, count: int) -> tuple[Mechanism, int, list[Mechanism]]:
    """The machine of many designs, how many were built, and the first of them one by one."""
    values = _values(kind, count)
    found = many(spec, {kind.key: values})
    assert found.machine is not None, kind.name
    few = CHECKED if count > QUICK else QUICK_CHECKED
    some = values[found.which[:few]].tolist()
    alone = [build(spec.with_(kind.key, value)) for value in some]
    return found.machine, len(found.which), alone


def _values(kind: Kind, count: int) -> Any:
    """The values of what is varied; always the same."""
    values = np.random.default_rng(12).uniform(kind.low, kind.high, count)
    return np.floor(values).astype(int) if kind.key == "wheel.z" else values


def _task(kind: Kind, count: int) -> Task:
    machine, built, alone = _drawn(kind, kind.spec, count)
    varied = {kind.key: _values(kind, count)}
    methods = [
        _one_by_one(alone, built, _one),
        Method("grid of all", GRID, partial(_grid, machine, built)),
        *_formulas_alone(machine, built),
        Method("together", None, partial(_together, machine), True),
        Method("built and together", None, partial(_built_together, kind.spec, varied), True),
    ]
    return _beside(f"{built} {kind.name}", built, np.array([_one(m) for m in alone]), methods)


def _loads_task(kind: Kind, count: int, friction: float, asked: Loads) -> Task:
    load = Load(inertia_kgm2=1.0, friction=friction)
    spec = kind.spec.replace(load=load, size=kind.spec.size.replace(face_width_mm=10.0))
    machine, built, alone = _drawn(kind, spec, count)
    methods = [
        _one_by_one(alone, built, asked.one),
        Method("together", None, partial(asked.together, machine), True),
    ]
    truth = np.array([asked.one(m) for m in alone])
    name = f"{asked.name} of {built} {kind.name}" + (" with friction" if friction else "")
    return _beside(name, built, truth, methods)


def _beside(name: str, built: int, truth: Array, methods: list[Method]) -> Task:
    angles = np.linspace(0.0, 1.0, built)
    return Task(
        name,
        f"one np.sin + np.cos over {built} numbers",
        lambda: (np.sin(angles), np.cos(angles)),
        lambda found: _error(np.array(found[: len(truth)]), truth[: len(found)]),
        methods,
        built,
    )


def _error(found: Array, truth: Array) -> float:
    """The greatest relative error; a load that both say has no bound is right."""
    with np.errstate(invalid="ignore"):
        error = np.where(found == truth, 0.0, np.abs(found / truth - 1.0))
    return float(error.max())


def _one_by_one(
    alone: list[Mechanism], built: int, one: Callable[[Mechanism], list[float]]
) -> Method:
    few = alone[: LOOP if built > QUICK else QUICK_LOOP]
    name = f"one by one (extrapolated from {len(few)})"
    return Method(name, None, lambda: [one(m) for m in few], True, times=built / len(few))


def _one_loaded(machine: Mechanism) -> list[float]:
    """The greatest loads of one design, by the search for one."""
    found = ends_of(Cycle(machine), *LOADS)
    sizes = [max(one.max, -one.min) for one in found]
    return [math.sqrt(v) if n in SQUARED else v for n, v in zip(LOADS, sizes, strict=True)]


def _loaded_together(machine: Mechanism) -> Array:
    found = greatest_of_many(machine, LOADS)
    every: Array = np.column_stack([found[name].max for name in LOADS])
    return every


def _roots_of_one(machine: Mechanism) -> list[float]:
    """Greatest sizes and root mean squares of one design."""
    found = summaries(Cycle(machine))
    told = [(_size(found[n].max, found[n].min), found[n].rms) for n in LOADS]
    return [math.inf if v is None else v for both in told for v in both]


def _roots_together(machine: Mechanism) -> Array:
    found = summaries_of_many(machine, LOADS, told=("rms",))
    rows = [row for n in LOADS for row in (np.maximum(found[n].max, -found[n].min), found[n].rms)]
    every: Array = np.column_stack([row for row in rows if row is not None])
    return every


def _size(most: float | None, least: float | None) -> float | None:
    """The greater size of two extremes; None where one of them has no bound."""
    return None if most is None or least is None else max(most, -least)


class Loads(NamedTuple):
    """What is asked of loads: of one design, and of all of them together."""

    name: str
    one: Callable[[Mechanism], list[float]]
    together: Callable[[Mechanism], Array]


GREATEST = Loads("greatest loads", _one_loaded, _loaded_together)
ROOTS = Loads("extremes and rms of loads", _roots_of_one, _roots_together)


def _built_together(spec: Spec, varied: Mapping[str, Any]) -> Array:
    machine = many(spec, varied).machine
    assert machine is not None
    return _together(machine)


def _together(machine: Mechanism) -> Array:
    found = worst_of_many(machine, NAMES)
    both: Array = np.column_stack([found[name].max for name in NAMES])
    return both


def _formulas_alone(machine: Mechanism, count: int) -> list[Method]:
    """What a search in NumPy cannot do without: the scan's places of all designs, as it has them.

    Of no machine whose peaks are found another way.
    """
    motion = machine.engagements[0].motion
    if motion.closed_peak(NAMES[0]) is not None:
        return []
    pieces = list(pairwise(motion.breaks_deg))
    pieces = pieces[: len(pieces) // 2] if motion.symmetric else pieces
    places = len(pieces) * (SCAN + 1)
    run = partial(_at_places, motion, count, pieces)
    return [Method("formulas alone, nothing searched", places, run)]


def _at_places(motion: Motion, count: int, pieces: list[tuple[float, float]]) -> Array:
    """The greatest of the places' values."""
    most = np.zeros((count, len(NAMES)))
    for piece in pieces:
        a, b = (np.broadcast_to(np.reshape(end, (-1, 1)), (count, 1)) for end in piece)
        for i in range(0, count, SCANNED):
            which = slice(i, i + SCANNED)
            x = a[which] + (b - a)[which] * (np.arange(SCAN + 1) / SCAN)
            rates = taken(motion, which).rough_rates(np.asfortranarray(x), len(NAMES))
            for k, rate in enumerate(rates[: len(NAMES)]):
                np.maximum(most[which, k], np.abs(rate).max(axis=1), out=most[which, k])
    return most


def _grid(machine: Mechanism, count: int) -> Array:
    """The greatest of a grid's values, a block of designs at a time."""
    motion = machine.engagements[0].motion
    ends = [np.broadcast_to(np.ravel(x), (count,)) for x in (motion.entry_deg, motion.exit_deg)]
    found = []
    for i in range(0, count, BLOCK):
        which = slice(i, i + BLOCK)
        a, b = (side[which, None] for side in ends)
        x = a + (b - a) * np.linspace(0.0, 1.0, GRID)
        p = taken(motion, which)(x, 2).derivatives()
        found.append(
            np.column_stack([np.abs(np.broadcast_to(p[k], x.shape)).max(axis=1) for k in (1, 2)])
        )
    both: Array = np.concatenate(found)
    return both


def _one(machine: Mechanism) -> list[float]:
    """The peaks of one design, by the search for one."""
    motion = machine.engagements[0].motion
    return [peak(motion, name).max for name in NAMES]
