"""Monte Carlo of the tolerances of one machine: its lock, its motion and its entry.

Scripts draw machines with NumPy or SciPy and put them into a handbook's formulas.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from bench.kinds import task_of_many
from bench.method import Method, Subject
from geneva_cli.loads.tolerance.draws import Draws
from geneva_cli.loads.tolerance.entry_jump import entry_jumps
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.loads.tolerance.motion_error import motion_errors
from geneva_cli.loads.tolerance.random_machines import random_machines
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.external import External
from geneva_cli.numerics.jet import Array
from geneva_cli.spec.tables import Size

Z, L, AT_DEG = 6, 100.0, 20.0
# centre distance, crank, roller, slot, slot's angle, disc, recess: mm and radians
SIZES = (0.02, 0.02, 0.01, 0.01, 3e-4, 0.01, 0.01)
# So loose that in every machine a corner of the recess meets the disc, as handbooks assume.
LOCK = Lock(L, 1.0, 39.85, 39.95, 86.75, 2.0)


class Means(NamedTuple):
    """Results of a method: mean play of the lock, mean error in motion, mean jump."""

    dwell: float
    motion: float
    jump: float


def subject(quick: bool) -> Subject:
    """Ours, compared with scripts, at several numbers of machines."""
    counts = (1 << 12, 1 << 14) if quick else (1 << 14, 1 << 17, 1 << 20)
    every: list[tuple[str, Callable[[int], Means], bool]] = [
        ("NumPy, pseudo-random", pseudo_random, False),
        ("SciPy qmc.Sobol", quasi_random, False),
        ("SciPy qmc.Sobol, in blocks", partial(quasi_random, block=1 << 15), False),
        ("ours", _ours(), True),
    ]
    methods = [
        Method(name, count, partial(run, count), is_ours)
        for name, run, is_ours in every
        for count in counts
    ]
    true = exact_means()
    task = task_of_many(
        "means over machines of seven dimensions",
        counts[-1],
        lambda means: max(abs(a - b) / abs(b) for a, b in zip(means, true, strict=True)),
        methods,
    )
    return Subject(
        "Tolerances: machines drawn at random",
        "greatest relative error of the three means, against Gauss's rule",
        [task._replace(designs=None)],
    )


def _ours() -> Callable[[int], Means]:
    mechanism = build(Spec(External(Z), size=Size(slot_clearance_mm=0.02)))
    error, entry = motion_errors(mechanism)[0], entry_jumps(mechanism)[0]

    def run(count: int) -> Means:
        results = random_machines(Draws(SIZES, False, 1), count, LOCK, (error, AT_DEG, 1.0), entry)
        return Means(*(float(part.mean()) for part in results[:3]))

    return run


def pseudo_random(count: int) -> Means:
    """Means over machines from NumPy's generator."""
    rng = np.random.default_rng(1)
    results = textbook([rng.uniform(-size, size, count) for size in SIZES])
    return Means(*(float(values.mean()) for values in results))


def quasi_random(count: int, block: int = 1 << 30) -> Means:
    """Means over machines from SciPy's scrambled Sobol sequence, a block of machines at a time."""
    from scipy.stats.qmc import Sobol

    sequence, sums = Sobol(len(SIZES), rng=np.random.default_rng(1)), np.zeros(3)
    for start in range(0, count, block):
        unit = sequence.random(min(block, count - start))
        deviations = (unit.T * 2.0 - 1.0) * np.reshape(SIZES, (-1, 1))
        sums += [values.sum() for values in textbook(deviations)]
    return Means(*(sums / count).tolist())


def textbook(deviations: Iterable[Array]) -> tuple[Any, ...]:
    """Play of the lock, error in motion and jump at entry of machines with these deviations."""
    dL, dR, dd, dw, da, dk, dr = deviations
    dwell = corner(L, LOCK.recess + dr) - corner(L + dL, LOCK.lock + dk) + da
    return dwell, leaned(dL, dR, 0.5 * (dw - dd)) + da, jumps(L + dL, arm() + dR)


def arm() -> float:
    """Length of the crank, mm."""
    return L * math.sin(math.pi / Z)


def corner(away: Any, radius: Any) -> Any:
    """Angle of the recess's corner on a circle about a point at a distance."""
    p = LOCK.corner
    return np.acos((away * away + p * p - radius * radius) / (2.0 * away * p))


def leaned(dL: Any, dR: Any, play: Any) -> Any:
    """Error of the wheel's angle while the roller leans on one wall of the slot."""
    phi = math.radians(AT_DEG)
    R, away = arm() + dR, L + dL
    x, y = away - R * math.cos(phi), R * math.sin(phi)
    true = math.atan2(arm() * math.sin(phi), L - arm() * math.cos(phi))
    return np.atan2(y, x) + np.asin((0.02 + play) / np.hypot(x, y)) - true


def jumps(away: Any, R: Any) -> Any:
    """Speed at which the wheel starts: 0 where the roller misses the slot's axis."""
    b, l = math.pi / Z, R / away
    sine = math.sin(b) / l
    c = np.cos(math.pi - np.asin(np.minimum(sine, 1.0)) - b)
    return np.where(sine < 1.0, -l * (c - l) / (1.0 - 2.0 * l * c + l * l), 0.0)


def exact_means() -> Means:
    """Means by Gauss's rule in each dimension: all but the jump are smooth over the tolerances.

    The jump begins as a square root where the crank just reaches the slot's axis. Above that length
    its root is the variable, in which the jump is smooth. Deviations that add count as 0.
    """
    node, weight = np.polynomial.legendre.leggauss(12)
    half = 0.5 * weight
    dL, dR, dd, dw, _, dk, dr = (size * node for size in SIZES)
    recess = half @ corner(L, LOCK.recess + dr)
    disc = half @ corner(L + dL[:, None], LOCK.lock + dk) @ half
    play = 0.5 * (dw[:, None] - dd).ravel()
    motion = leaned(dL[:, None, None], dR[:, None], play) @ np.outer(half, half).ravel()
    away, longest = L + dL[:, None], arm() + SIZES[1]
    reach: Array = np.sqrt(longest - away * math.sin(math.pi / Z))
    root = 0.5 * reach * (1.0 + node)
    density = root * reach / SIZES[1]  # of the root, with its weights: d(root²) over the range
    jump = jumps(away, away * math.sin(math.pi / Z) + root**2) * density @ half
    return Means(float(recess - disc), float(half @ motion @ half), float(half @ jump))
