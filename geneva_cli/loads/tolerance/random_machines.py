"""Machines with random deviations, block by block; worst case, RSS and Monte Carlo of an angle."""

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.loads.tolerance.locking import CutLock, Deviations, deviations, slope_of
from geneva_cli.loads.tolerance.motion_error import EntryJump, MotionError
from geneva_cli.numerics.jet import Array, Jet, Number
from geneva_cli.numerics.sobol import sobol
from geneva_cli.progress import tracked

# a motion's error, the input angle in degrees, and the side on which the roller bears
Place: TypeAlias = tuple[MotionError, float, float]
BLOCK = 32768  # machines at once: they stay in the processor's cache


class Draws(NamedTuple):
    """Quasi-random machines: Sobol's sequence, scrambled by the seed."""

    sizes: tuple[float, ...]
    normal: bool
    seed: int

    def blocks(self, samples: int, size: int) -> Iterator[Deviations]:
        """Deviations of ``samples`` machines, in blocks of ``size``, a power of two."""
        deviate = [i for i, size in enumerate(self.sizes) if size]
        for start in range(0, samples, size):
            count = min(size, samples - start)
            power = 1 << (count - 1).bit_length()
            quantiles = sobol(len(deviate), self.seed, start, power)[:, :count]
            columns: list[Number] = [0.0] * len(self.sizes)
            for i, quantile in zip(deviate, quantiles, strict=True):
                spread: Array = 2.0 * quantile - 1.0
                if self.normal:
                    from scipy.special import ndtri

                    # the plus or minus is three standard deviations
                    spread = ndtri(quantile) / 3.0
                columns[i] = spread * self.sizes[i]
            yield deviations(columns)


class RandomMachines(NamedTuple):
    """Errors of n machines with random dimensions: arrays (n,), 0 for what is not requested."""

    dwell: Array  # error of the wheel's angle in the dwell, radians
    motion: Array  # error of the wheel's angle at one input angle of a motion, radians
    jump: Array  # jump of the wheel's velocity at entry, over the input's speed
    missed: float  # fraction whose roller misses the slot's axis
    jams: float | None  # fraction that does not fit together; None without a lock and a motion


def random_machines(
    draws: Draws, samples: int, lock: CutLock | None, error: Place | None, entry: EntryJump | None
) -> RandomMachines:
    """Errors of ``samples`` machines: the play of a lock, the error of a motion, the jump at entry.

    ``error`` is a motion's at a place.
    """
    dwell, motion, jump = (np.zeros(samples) for _ in range(3))
    start = missed = jams = 0
    for by in tracked(draws.blocks(samples, BLOCK), "blocks of machines", -(-samples // BLOCK)):
        part = slice(start, start + BLOCK)
        jam = np.zeros(len(dwell[part]), dtype=bool)
        if lock:
            play = lock(by)
            dwell[part] = (play.angle + by.slot_angle_deg).c[0]
            jam |= play.jams
        if error:
            one, at, side = error
            motion[part] = one(by, at, side).c[0] * side
            jam |= one.play_mm(by).c[0] < -1e-12  # mm: less is rounding
        if entry:
            jump[part], misses = entry(by)
            missed += int(np.broadcast_to(misses, jam.shape).sum())
        jams += int(jam.sum())
        start += BLOCK
    known = lock or error
    return RandomMachines(dwell, motion, jump, missed / samples, jams / samples if known else None)


class Spread(NamedTuple):
    """Error of the wheel's angle towards one side, degrees; mean and std with its sign."""

    worst: float
    rss: float
    mean: float
    std: float
    p997: float
    parts: tuple[float, ...]

    @property
    def fractions(self) -> tuple[float, ...]:
        """Each dimension's fraction of the squares; 0 if nothing deviates."""
        total = math.fsum(part * part for part in self.parts)
        return tuple(part * part / total if total else 0.0 for part in self.parts)


def likely_place(machines: Draws, samples: int, errors: Sequence[MotionError]) -> Place:
    """The motion, the input angle and the side with the greatest error of 99.7 % of machines.

    The mean and some deviations of few machines name places, of which many machines select one.
    """
    few, many = (next(machines.blocks(min(samples, count), count)) for count in (4096, 65536))
    places: list[Place] = []
    for one, side in product(errors, (1.0, -1.0)):
        grid = np.linspace(one.engagement.entry_deg, one.engagement.exit_deg, 121)
        drawn = [one(few, at_deg, side).c[0] for at_deg in grid]
        mean, deviation = (np.array([f(row) for row in drawn]) for f in (np.mean, np.std))
        # 99.7 % lie within 1.7 deviations of one uniform dimension, and 2.7 of a normal one
        tops = {int(np.argmax(abs(mean) + times * deviation)) for times in (1.7, 2.7)}
        places += [(one, float(grid[i]), side) for i in sorted(tops)]
    return max(places, key=lambda place: _p997(place[0](many, *place[1:]).c[0]))


def _p997(values: Number) -> float:
    """The size that 99.7 % of the values keep: that at its place among the sizes in order."""
    sizes = abs(np.ravel(values))
    k = min(math.ceil(0.997 * len(sizes)), len(sizes)) - 1
    return float(np.partition(sizes, k)[k])


def spread(
    angle: Callable[[Deviations], Jet], sizes: list[float], worst: float, drawn: Array
) -> Spread:
    """Spread of an angle in radians; ``drawn`` has it for random machines."""
    middle = float(np.ravel(angle(deviations([0.0] * len(sizes))).c[0])[0])
    parts = [
        float(np.ravel(angle(slope_of(i)).c[1])[0]) * size if size else 0.0
        for i, size in enumerate(sizes)
    ]
    return Spread(
        math.degrees(worst),
        math.degrees(abs(middle) + math.sqrt(math.fsum(part * part for part in parts))),
        math.degrees(drawn.mean()),
        math.degrees(drawn.std()),
        math.degrees(_p997(drawn)),
        tuple(math.degrees(abs(part)) for part in parts),
    )
