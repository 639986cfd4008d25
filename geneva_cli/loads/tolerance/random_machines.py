"""Machines with random deviations, block by block; worst case, RSS and Monte Carlo of an angle."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.loads.impacts.entry import RestingAxis, arm_mm
from geneva_cli.loads.tolerance.built_jump import BuiltJump, built_jumps
from geneva_cli.loads.tolerance.dimensions import Deviations, deviations, slope_of
from geneva_cli.loads.tolerance.locking import CutLock
from geneva_cli.loads.tolerance.motion_error import MotionError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Mask, array
from geneva_cli.numerics.jet import Array, Jet, Number
from geneva_cli.numerics.sobol import Sobol
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
        sequence = Sobol.scrambled(len(deviate), self.seed)
        for start in range(0, samples, size):
            count = min(size, samples - start)
            quantiles = sequence.points(start, 1 << (count - 1).bit_length())[:, :count]
            columns: list[Number] = [0.0] * len(self.sizes)
            for i, quantile in zip(deviate, quantiles, strict=True):
                columns[i] = self._spread(quantile) * self.sizes[i]
            yield deviations(columns)

    def _spread(self, quantile: Array) -> Array:
        """Deviations over the tolerance for quantiles of the distribution."""
        if not self.normal:
            return 2.0 * quantile - 1.0
        from scipy.special import ndtri

        # The plus or minus is three standard deviations; a quantile of 0 would be infinite.
        out: Array = ndtri(np.maximum(quantile, 2.0**-53)) / 3.0
        return out


class RandomMachines(NamedTuple):
    """Errors of n machines with random dimensions: arrays (n,), 0 for what is not requested."""

    dwell: Array  # error of the wheel's angle in the dwell, radians
    motion: Array  # error of the wheel's angle at one input angle of a motion, radians
    jump: Array  # jump of the wheel's velocity at entry, over the input's speed
    missed: float  # fraction whose roller misses the slot's axis
    jams: float | None  # fraction that does not fit together; None without a lock and a motion


def random_machines(
    machines: Draws,
    samples: int,
    lock: CutLock | None,
    error: tuple[MotionError, float, float] | None,
    entry: EntryJump | None,
) -> RandomMachines:
    """Errors of ``samples`` machines: the play of a lock, the error of a motion, the jump at entry.

    ``error`` is one engagement's motion error, the input angle in degrees, and the side of the slot
    (1 or -1) on which the roller bears. Arguments that are None are left out.
    """
    start = 0
    dwell, motion, jump = (np.zeros(samples) for _ in range(3))
    missed = jams = 0
    for by in tracked(machines.blocks(samples, BLOCK), "blocks of machines", -(-samples // BLOCK)):
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
    """Error of the wheel's angle towards one side, degrees.

    ``mean`` and ``std`` are of that angle with its sign. ``p997`` is the size that 99.7 % of the
    machines keep. ``parts`` has the contribution of each dimension's plus or minus.
    """

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


def likely_place(
    machines: Draws, samples: int, errors: Sequence[MotionError]
) -> tuple[MotionError, float, float]:
    """The motion, the input angle and the side with the greatest error of 99.7 % of machines.

    Some thousand machines have mean and deviation at each place, but too few beyond 99.7 %. So the
    sums of mean and some deviations name places, of which 65536 machines select one.
    """
    few = next(machines.blocks(min(samples, 4096), 4096))
    many = next(machines.blocks(min(samples, 65536), 65536))
    places: list[tuple[MotionError, float, float]] = []
    for one, side in product(errors, (1.0, -1.0)):
        (entry,), (exit_,) = map(np.ravel, one.ends_deg)
        grid = np.linspace(entry, exit_, 121)
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

    def one(number: int | None) -> float:
        """The angle without deviations, or its slope by a dimension."""
        by = deviations([0.0] * len(sizes)) if number is None else slope_of(number)
        return float(np.ravel(angle(by).c[number is not None])[0])

    parts = [one(i) * size if size else 0.0 for i, size in enumerate(sizes)]
    return Spread(
        math.degrees(worst),
        math.degrees(abs(one(None)) + math.sqrt(math.fsum(part * part for part in parts))),
        math.degrees(drawn.mean()),
        math.degrees(drawn.std()),
        math.degrees(_p997(drawn)),
        tuple(math.degrees(abs(part)) for part in parts),
    )


class Branch(NamedTuple):
    """The true path on one side of its entry, for crossings of the axis by paths with errors.

    ``side`` is the side of the axis on which the true path is; the others are arrays along it.
    """

    side: float
    root: Array  # square root of its distance from the axis, over L
    # Speed of its approach to the axis over that root, nearly constant, and as imaginary part the
    # wheel's lever to the roller: one search interpolates both.
    speed_and_lever: Array


class EntryJumpFunction(NamedTuple):
    """The jump at one engagement's entry as a function of deviations; lengths in millimetres."""

    axis: RestingAxis
    L: float
    arm: float
    branches: tuple[Branch, ...]

    def __call__(self, by: Deviations) -> tuple[Array, Mask]:
        """Sizes of the jumps, over the input's speed, and a mask of machines that miss the axis.

        A machine that misses it has a jump of 0: its roller meets the mouth instead.
        """
        crank, center = by.crank_radius_mm.c[0] / self.arm, by.center_distance_mm.c[0] / self.L
        offset = np.atleast_1d(self.axis.offset(array(crank), array(center)))
        moved = np.broadcast_to((center - crank) / (1.0 + crank) * self.axis.along, offset.shape)
        jump, missed = np.zeros(len(offset)), offset != 0.0
        for branch in self.branches:
            here = np.flatnonzero(offset * branch.side > 0.0)
            at = np.sqrt(abs(offset[here]))
            both = np.interp(at, branch.root, branch.speed_and_lever, right=np.nan)
            speed, lever = at * both.real, both.imag + moved[here]
            jump[here] = np.nan_to_num(speed / lever)
            missed[here] = np.isnan(speed)
        return jump, missed


EntryJump: TypeAlias = EntryJumpFunction | BuiltJump


def entry_jumps(mechanism: Mechanism) -> list[EntryJump]:
    """Entry jump of each engagement whose roller enters along its slot's axis, or as built."""
    L = mechanism.center_distance_mm
    out: list[EntryJump] = [*built_jumps(mechanism)]
    for engagement in mechanism.engagements:
        axis = RestingAxis.of(engagement)
        if axis is not None:
            # the path after the true entry counts if it is on the other side
            before, after = _branch(axis, -1.0), _branch(axis, 1.0)
            branches = (before,) if before.side == after.side else (before, after)
            arm = arm_mm(mechanism, engagement)
            out.append(EntryJumpFunction(axis, L, arm, branches))
    return out


def _branch(axis: RestingAxis, sense: float) -> Branch:
    anchor = axis.anchor
    span = 0.5 * axis.engagement.motion_deg * DEGREE
    # In geometric progression from next to the true entry to half-way through the motion: between
    # two places, interpolation has a relative error of 1e-6 at most.
    tau = sense * span * np.geomspace(1e-7, 1.0, 8193)
    along, across = anchor.displacement(tau, 1)
    off, slope = across.arrays()
    root = np.sqrt(abs(off))
    first = int(np.argmax(root > 3e-8))  # the root of a distance that is not rounding
    leaves = np.append(np.diff(root[first:]) > 0.0, False)
    part = slice(first, first + int(np.argmin(leaves)) + 1)  # as far as it leaves the axis
    side, root = float(np.sign(off[first])), root[part]
    lever = anchor.along + along.arrays()[0][part]
    return Branch(side, root, abs(slope)[part] / root + 1j * lever)
