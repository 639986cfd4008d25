"""Curved slots and cams along the crank: a law gives the motion, with an extra dwell alpha_0.

Both take as many rollers as the plain wheel, and more as long as their parts can be built.
"""

import math
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import product
from typing import NamedTuple

import numpy as np

from geneva_cli.drives.cam import Cam
from geneva_cli.drives.crank import Crank
from geneva_cli.motion import registry
from geneva_cli.motion.laws.law import Law, Motion
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.wheels.classic import rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Array, Mask
from geneva_cli.study.batches import built
from geneva_cli.study.synth.families.family import Family, natural_deg
from geneva_cli.study.synth.suiting import suiting
from geneva_cli.study.target import OPEN_END, AllowedSpan, Target
from geneva_cli.verdict.advice import short

MORE = 4  # rollers that are tried where nothing demands more
PARTS, ROUNDS = 4, 5  # of a range of motions: its division, and how often a part is divided again


def with_laws(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """Curved slots and cams with each law.

    A range of motions ends at the longest with parts that can be built, which is the gentlest. The
    plain crank's own motion is added. With bounds or another goal any of the range may be best.
    """
    counts = [int(m) for m in target.counts if m >= 1.0]
    several = [m for m in counts if m <= max(MORE, counts[0])] if counts else []
    if not wheels[0].FLAT:
        return
    for name, is_cam in product(target.laws, (False, True)):
        lines, law = list[_LawLine](), registry.law(name)()
        for wheel, m in product(wheels, several):
            natural = natural_deg(wheel)
            most, own = rollers_max(natural), target.free_motions(m, natural)
            if own is None or (m > most and target.rollers is not None):
                continue
            # a cam's motion is shorter than that of a slot parallel to the crank
            parallel = (1.0 - OPEN_END) * (360.0 - wheel.SIGN * 360.0 / wheel.z)
            if is_cam and not own.exact and own.low < parallel:
                own = AllowedSpan(own.low, min(own.high, parallel))
            lines.append(_LawLine(target, wheel, law, is_cam, m, m > max(most, several[0]), own))
        for one, longest in zip(lines, _longest(lines) if lines else (), strict=True):
            yield from one.families(longest)


class _LawLine(NamedTuple):
    """Machines of one wheel and law: curved slots, or straight ones with a groove on the crank."""

    target: Target
    wheel: Gearing
    law: Law
    is_cam: bool
    m: int  # rollers
    is_extra: bool  # more than the plain wheel takes: the longest motion alone is tried
    free: AllowedSpan  # the allowed motions

    def spec(self, motion_deg: float) -> Spec:
        alpha0 = _alpha0(natural_deg(self.wheel), motion_deg)
        motion = Motion(self.law, alpha0_deg=alpha0, ratio=None if self.is_cam else "matched")
        drive = (Cam if self.is_cam else Crank)(rollers=self.m)
        return self.target.machine(self.wheel, drive, motion)

    def families(self, longest: float) -> Iterator[Family]:
        """Those of the allowed motions, of which ``longest`` can be built; NaN if none can."""
        target, free, natural = self.target, self.free, natural_deg(self.wheel)
        if math.isnan(longest):
            if self.m > rollers_max(natural):
                return
            longest = free.high
        is_searched = target.bounds or target.sort or target.soft_bounds
        keys = partial(_keys, natural)
        own = free.allows(natural)
        if not (own and free.exact):
            spec = self.spec(longest)
            yield Family(spec, keys, free.low, longest, natural) if is_searched else Family(spec)
        if own:
            yield Family(self.spec(natural))


def _longest(lines: Sequence[_LawLine]) -> list[float]:
    """The longest motion of each line with parts that can be built; NaN if none can."""
    low, high = np.array([own.free for own in lines]).T
    able = _buildable(lines, high)
    found = np.where(able, high, math.nan)
    is_tried = np.array([not own.is_extra for own in lines])
    left, top, step = np.flatnonzero(~able & (low < high) & is_tried), high, (high - low) / PARTS
    for _ in range(ROUNDS):
        tried = top[left, None] - step[left, None] * np.arange(1, PARTS + 1)
        each = [lines[i] for i in left.tolist() for _ in range(PARTS)]
        able = _buildable(each, tried.ravel()).reshape(tried.shape)
        some = able.any(axis=1)
        left = left[some]
        found[left] = tried[some, able[some].argmax(axis=1)]
        top, step = found + step, step / PARTS
    return [*found.tolist()]


def _buildable(lines: Sequence[_LawLine], motions: Array) -> Mask:
    """Mask (n,) of the lines, alike but for slots and rollers, whose parts can be built."""
    able = np.zeros(len(lines), dtype=bool)
    if not lines:
        return able
    rows = [(natural_deg(own.wheel), own.wheel.z, own.m) for own in lines]
    natural, z, rollers = np.array(rows).T
    varied = {"wheel.z": z.astype(int), "motion.alpha0_deg": natural - motions}
    first = lines[0]._replace(m=1).spec(motions[0])
    for members, batch in built(first, varied, np.arange(len(lines))):
        _, obstacles = suiting(batch, rollers[members], largest=False)
        able[members] = [not why for why in obstacles]
    return able


def _keys(natural: float, at: Array) -> dict[str, Array]:
    return {"motion.alpha0_deg": np.array([_alpha0(natural, motion) for motion in at.tolist()])}


def _alpha0(natural: float, motion: float) -> float:
    """The extra dwell: of all numbers within rounding that of fewest digits."""
    extra, spare = natural - motion, 2e-15 * natural
    return short(extra, spare) if abs(extra) > spare else 0.0
