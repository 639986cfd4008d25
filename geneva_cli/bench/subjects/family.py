"""Velocity and acceleration peaks of very many designs of every machine, worked out together.

Beside them one design after the other, and a grid over all of them. In units of one sine and cosine
a design, which take some 15 ns: 70 is a million designs a second, 700 a hundred thousand.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

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
from geneva_cli.machine.spec import Motion, Spec
from geneva_cli.machine.wheels.external import External
from geneva_cli.machine.wheels.internal import Internal
from geneva_cli.machine.wheels.spherical import Spherical
from geneva_cli.spec.tables import Size

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

DESIGNS, QUICK, FEW = 50_000, 100, 2_000
LOOP = 5  # designs that are had one after the other
CHECKED = 20  # designs whose error is measured
GRID, BLOCK = 101, 512
NAMES = ("velocity", "acceleration")


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
        Spec(External(6), motion=Motion(ModifiedSine())),
        "motion.alpha0_deg",
        -60.0,
        60.0,
    ),
    Kind(
        "curved slots of a tilted law",
        Spec(External(6), motion=Motion(SineGroup(0.01))),
        "motion.lambda",
        -0.12,
        0.12,
    ),
    Kind("geneva pair", Spec(External(4), GenevaPair(first_z=4)), "wheel.z", 3.0, 5.0),
    Kind("four-bar", Spec(External(4), FOUR_BAR), "drive.point_deg", -50.0, -35.0, FEW),
)


def subject(quick: bool) -> Subject:
    """A task a machine."""
    return Subject(
        "Velocity and acceleration peaks of many designs of every machine",
        f"greatest relative error of {CHECKED} designs' peaks, against the search of one design",
        [_task(kind, QUICK if quick else kind.most) for kind in KINDS],
        floor=1e-14,
    )


def _task(kind: Kind, count: int) -> Task:
    random = np.random.default_rng(12)
    values: Any = random.uniform(kind.low, kind.high, count)
    if kind.key == "wheel.z":
        values = np.floor(values).astype(int)
    found = many(kind.spec, {kind.key: values})
    machine = found.machine
    assert machine is not None, kind.name
    built = len(found.which)
    some = values[found.which[:CHECKED]].tolist()
    alone = [build(kind.spec.with_(kind.key, value)) for value in some]
    truth = np.array([_one(m) for m in alone])
    angles = np.linspace(0.0, 1.0, built)
    return Task(
        f"{built} {kind.name}",
        f"one np.sin + np.cos over {built} numbers",
        lambda: (np.sin(angles), np.cos(angles)),
        lambda found: float(np.max(np.abs(np.array(found[:CHECKED]) / truth[: len(found)] - 1.0))),
        [
            Method(
                f"one by one (extrapolated from {LOOP})",
                None,
                lambda: [_one(m) for m in alone[:LOOP]],
                True,
                times=built / LOOP,
            ),
            Method("grid of all", GRID, partial(_grid, machine, built)),
            Method("together", None, partial(_together, machine), True),
        ],
    )


def _together(machine: Mechanism) -> Array:
    found = worst_of_many(machine, NAMES)
    both: Array = np.column_stack([found[name].max for name in NAMES])
    return both


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
