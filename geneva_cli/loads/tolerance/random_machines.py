"""Machines with random deviations, block by block; worst case, RSS and Monte Carlo of an angle."""

import math
from collections.abc import Collection, Iterator, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.tolerance.locking import AS_DRAWN, Deviations, Effect, deviations, slope_of
from geneva_cli.loads.tolerance.motion_error import MotionError
from geneva_cli.numerics.arrays import Array, Mask, Number, blocks
from geneva_cli.numerics.sobol import sobol
from geneva_cli.progress import tracked

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


def random_errors(draws: Draws, samples: int, effects: Collection[Effect]) -> tuple[Array, Mask]:
    """The errors of ``samples`` random machines, and their masks: (effects, samples) each."""
    errors = np.zeros((len(effects), samples))
    masks, parts = errors > 0.0, blocks(samples, BLOCK)
    every = tracked(draws.blocks(samples, BLOCK), "blocks of machines", len(parts))
    for by, part in zip(every, parts, strict=True):
        for effect, error, mask in zip(effects, errors, masks, strict=True):
            jet, mask[part] = effect(by)
            error[part] = jet.c[0]
    return errors, masks


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


def likely_effect(draws: Draws, samples: int, errors: Sequence[MotionError]) -> Effect:
    """A motion's error at the place with the greatest one of 99.7 % of machines.

    The mean and some deviations of few machines name places, of which many machines select one.
    """
    few, many = (next(draws.blocks(min(samples, count), count)) for count in (4096, 65536))
    effects = list[Effect]()
    for one, side in product(errors, (1.0, -1.0)):
        grid = np.linspace(one.engagement.entry_deg, one.engagement.exit_deg, 121)
        drawn = [one(few, at_deg, side).c[0] for at_deg in grid]
        mean, deviation = (np.array([f(row) for row in drawn]) for f in (np.mean, np.std))
        # 99.7 % lie within 1.7 deviations of one uniform dimension, and 2.7 of a normal one
        tops = {int(np.argmax(abs(mean) + times * deviation)) for times in (1.7, 2.7)}
        effects += [one.at(float(grid[i]), side) for i in sorted(tops)]
    return max(effects, key=lambda effect: _p997(effect(many)[0].c[0]))


def _p997(values: Number) -> float:
    """The size that 99.7 % of the values keep: that at its place among the sizes in order."""
    sizes = abs(np.ravel(values))
    k = min(math.ceil(0.997 * len(sizes)), len(sizes)) - 1
    return float(np.partition(sizes, k)[k])


def spread(angle: Effect, sizes: Sequence[float], worst: float, drawn: Array) -> Spread:
    """Spread of an angle in radians; ``drawn`` has it for random machines."""
    middle, parts = np.ravel(angle(AS_DRAWN)[0].c[0]).item(), list[float]()
    for i, size in enumerate(sizes):
        parts.append(np.ravel(angle(slope_of(i))[0].c[1]).item() * size if size else 0.0)
    return Spread(
        math.degrees(worst),
        math.degrees(abs(middle) + math.sqrt(math.fsum(part * part for part in parts))),
        math.degrees(drawn.mean()),
        math.degrees(drawn.std()),
        math.degrees(_p997(drawn)),
        tuple(math.degrees(abs(part)) for part in parts),
    )
