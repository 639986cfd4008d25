"""Monte Carlo of the tolerances of one machine: its lock, its motion and its entry."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.locking import Lock
from geneva_cli.analysis.tolerance.dimensions import Draws
from geneva_cli.analysis.tolerance.entry_jump import entry_jumps
from geneva_cli.analysis.tolerance.motion_error import motion_errors
from geneva_cli.analysis.tolerance.random_machines import random_machines
from geneva_cli.bench.method import Method, Subject, Task
from geneva_cli.kinematics.wheels.external import External
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.spec.tables import Size

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

Z, L, AT_DEG = 6, 100.0, 20.0
# centre distance, crank, roller, slot, slot's angle, disc, recess: mm and radians
SIZES = (0.02, 0.02, 0.01, 0.01, 3e-4, 0.01, 0.01)
LOCK = Lock(L, 1.0, 39.9, 39.95, 86.75, 2.0)


class Means(NamedTuple):
    """Results of a method: mean play of the lock, mean error in motion, mean jump."""

    dwell: float
    motion: float
    jump: float


def subject(quick: bool) -> Subject:
    """Ours, compared with plain NumPy and a plain loop, with pseudo-random machines."""
    count, sample = 20_000 if quick else 1_000_000, 200
    angles = np.linspace(0.0, 1.0, count)
    true = _ours(1 << 16 if quick else 1 << 22)()
    task = Task(
        f"{count} machines of seven dimensions",
        f"one np.sin + np.cos over {count} numbers",
        lambda: (np.sin(angles), np.cos(angles)),
        lambda results: max(abs(a - b) / abs(b) for a, b in zip(results, true, strict=True)),
        [
            Method("NumPy, pseudo-random", None, partial(_plain, count)),
            Method(
                f"plain loop (extrapolated from {sample})",
                None,
                partial(_loop, sample),
                times=count / sample,
            ),
            Method("ours", None, _ours(count), True),
        ],
    )
    return Subject(
        f"Tolerances: {count} machines drawn at random",
        "greatest relative error of the three means",
        [task],
    )


def _ours(count: int) -> partial[Means]:
    mechanism = build(Spec(External(Z), size=Size(slot_clearance_mm=0.02)))
    error, entry = motion_errors(mechanism)[0], entry_jumps(mechanism)[0]

    def run() -> Means:
        results = random_machines(Draws(SIZES, False, 1), count, LOCK, (error, AT_DEG, 1.0), entry)
        return Means(*(float(part.mean()) for part in results[:3]))

    return partial(run)


def _plain(count: int) -> Means:
    """Textbook formulas on arrays of machines."""
    rng = np.random.default_rng(1)
    dL, dR, dd, dw, da, dk, dr = (rng.uniform(-s, s, count) for s in SIZES)
    R, away, p = L * math.sin(math.pi / Z) + dR, L + dL, LOCK.corner
    recess, disc = LOCK.recess + dr, LOCK.lock + dk
    dwell = np.arccos((L * L + p * p - recess**2) / (2 * L * p))
    dwell = dwell - np.arccos((away**2 + p * p - disc**2) / (2 * away * p)) + da
    phi = math.radians(AT_DEG)
    x, y = away - R * math.cos(phi), R * math.sin(phi)
    clearance = 0.02 + 0.5 * (dw - dd)
    motion = np.arctan2(y, x) + np.arcsin(clearance / np.hypot(x, y)) + da
    motion -= math.atan2(0.5 * math.sin(phi), 1.0 - 0.5 * math.cos(phi))
    jump = _jumps(R / away)
    return Means(float(dwell.mean()), float(motion.mean()), float(jump.mean()))


def _jumps(ratio: Array) -> Array:
    b = math.pi / Z
    sine = math.sin(b) / ratio
    met = sine < 1.0
    a, l = math.pi - np.arcsin(sine[met]) - b, ratio[met]
    jump = np.zeros(len(ratio))
    jump[met] = -l * (np.cos(a) - l) / (1.0 - 2.0 * l * np.cos(a) + l * l)
    return jump


def _loop(count: int) -> Means:
    """Textbook formulas, machine by machine."""
    rng = np.random.default_rng(1)
    rows = [_one([rng.uniform(-s, s) for s in SIZES]) for _ in range(count)]
    return Means(*(sum(column) / count for column in zip(*rows, strict=True)))


def _one(deviations: Sequence[float]) -> tuple[float, float, float]:
    dL, dR, dd, dw, da, dk, dr = deviations
    R, away, p = L * math.sin(math.pi / Z) + dR, L + dL, LOCK.corner
    recess, disc = LOCK.recess + dr, LOCK.lock + dk
    dwell = math.acos((L * L + p * p - recess**2) / (2 * L * p))
    dwell -= math.acos((away**2 + p * p - disc**2) / (2 * away * p)) - da
    phi = math.radians(AT_DEG)
    x, y = away - R * math.cos(phi), R * math.sin(phi)
    motion = math.atan2(y, x) + math.asin((0.02 + 0.5 * (dw - dd)) / math.hypot(x, y)) + da
    motion -= math.atan2(0.5 * math.sin(phi), 1.0 - 0.5 * math.cos(phi))
    return dwell, motion, float(_jumps(np.array([R / away]))[0])
