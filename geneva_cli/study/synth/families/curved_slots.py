"""Curved slots and cams along the crank: a law gives the motion, with an extra dwell alpha_0.

Both take as many rollers as the plain wheel, and more as long as their parts can be built.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from geneva_cli.drives.cam import Cam
from geneva_cli.drives.crank import Crank
from geneva_cli.motion import registry
from geneva_cli.motion.laws.law import Law
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.motion import Motion
from geneva_cli.motion.wheels.classic import rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import MARGIN
from geneva_cli.study.law_values import Characteristic, characteristic
from geneva_cli.study.synth.families.family import (
    OPEN_END,
    Family,
    allowed_motions,
    allows,
    closed_span,
    line,
    longest_deg,
    machine,
    natural_deg,
    rollers,
    speeds,
)
from geneva_cli.study.synth.fast_parts import has_no_obstacle
from geneva_cli.study.synth.parts_data import compute_parts_data
from geneva_cli.study.target import AllowedSpan, Target


def with_laws(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """Curved slots and cams with each law.

    In a range of motions the longest is the gentlest, and the plain crank's own is added. With
    bounds or another goal, every motion of the range is possible. Below a limit of acceleration
    alone, the motion nearest to the plain crank's is best; the law's peak gives it in closed form.
    """
    laws = [(law, characteristic(law)) for law in (registry.law(name)() for name in target.laws)]
    lines = [
        _LawLine(target, wheel, *law, grooved, natural_deg(wheel))
        for wheel in wheels
        if wheel.FLAT
        for law in laws
        for grooved in (False, True)
    ]
    for own, more in zip(lines, _more_rollers(target, lines), strict=True):
        yield from own.families(more)


class _LawLine(NamedTuple):
    """Machines of one wheel and law: curved slots, or straight ones with a groove on the crank."""

    target: Target
    wheel: Gearing
    law: Law
    cost: Characteristic
    grooved: bool
    natural: float  # the plain crank's motion angle

    def spec(self, m: int, motion_deg: float) -> Spec:
        alpha0 = _alpha0(self.target, self.natural, motion_deg)
        motion = Motion(self.law, alpha0_deg=alpha0, ratio=None if self.grooved else "matched")

        def drive(n_rpm: float) -> Cam | Crank:
            kind = Cam if self.grooved else Crank
            return kind(n_rpm=n_rpm, rollers=m)

        return machine(self.target, self.wheel, drive, m, motion_deg, motion)

    def families(self, more: Sequence[Spec]) -> Iterator[Family]:
        """The families, including those with ``more`` rollers than the plain wheel takes."""
        several = rollers(self.target, self.natural)
        more_counts = [spec.drive.rollers for spec in more]
        if self.target.only_acceleration:
            yield from map(self._below, (*several, *more_counts))
            return
        plain = AllowedSpan(self.natural, self.natural)
        for m in several:
            if free := self._motions(m):
                own = allows(free, self.natural)
                yield self._free(m, plain if own and free.exact else free)
                if own:
                    yield Family(self.spec(m, self.natural))
        for m in more_counts:
            yield self._free(m, self._motions(m) or plain)

    def some(self, m: int) -> list[Spec]:
        """The gentlest machine of m rollers and, in a range, some others."""
        if self.target.only_acceleration:
            return [self.spec(m, self._below(m).best)]
        free = self._motions(m)
        motions = (free.high, 0.5 * (free.low + free.high), free.low) if free else ()
        return [self.spec(m, x) for x in dict.fromkeys(motions)]

    def _motions(self, m: int) -> AllowedSpan | None:
        """The allowed motions; with a groove those below that of a slot parallel to the crank."""
        free = closed_span(allowed_motions(self.target, m, self.natural), m)
        parallel = (1.0 - OPEN_END) * (360.0 - self.wheel.SIGN * 360.0 / self.wheel.z)
        if free and self.grooved and not free.exact and free.low < parallel:
            return AllowedSpan(free.low, min(free.high, parallel))
        return free

    def _below(self, m: int) -> Family:
        """The machines below a limit of acceleration; the nearest to the plain crank is best."""
        step, limit = 2.0 * math.pi / self.wheel.z, self.target.acceleration_max
        least = 0.0
        if limit:  # the law's peak is step C_a / motion²
            least = math.sqrt(step * self.cost.acceleration / (limit * (1.0 - MARGIN))) / DEGREE
        most = longest_deg(m)
        best = max(least, min(self.natural, most))
        # where an internal wheel turns half as fast as the crank, R/L is 1; at 0.45 it is 9/11
        fast = self.cost.velocity * step
        if not self.grooved and self.wheel.SIGN < 0.0 and fast >= 0.5 * math.radians(best):
            best = math.degrees(fast / 0.45)
        return self._line(m, AllowedSpan(least, max(most, best)), best)

    def _free(self, m: int, motion: AllowedSpan) -> Family:
        """The machines of a range of motions, the longest of which is the gentlest."""
        best = math.nan if self.target.bounds or self.target.sort else motion.high
        return self._line(m, motion, best)

    def _line(self, m: int, motion: AllowedSpan, best: float) -> Family:
        keys = partial(_keys, self.target, self.natural, m)
        return line(self.spec(m, motion.high), keys, motion, plain=(self.natural,), best=best)


def _keys(target: Target, natural: float, m: int, at: Array) -> dict[str, Array]:
    motions = at[:, 0].tolist()
    alpha0 = np.array([_alpha0(target, natural, motion) for motion in motions])
    return {"motion.alpha0_deg": alpha0, **speeds(target, m, motions)}


def _alpha0(target: Target, natural: float, motion: float) -> float:
    alpha0 = natural - motion
    spare = 2e-15 * natural  # the rounding of a difference of two angles
    # A motion that is shorter, by however little, would break a limit that it just keeps.
    most = alpha0 if target.acceleration_max else alpha0 + spare
    return _shortest(alpha0 - spare, most)


def _shortest(low: float, high: float) -> float:
    """The number of fewest digits near the middle of an interval; 0 if that lies in it."""
    if low <= 0.0 <= high:
        return 0.0
    middle = 0.5 * (low + high)
    for digits in range(1, 17):
        x = float(f"{middle:.{digits}g}")
        if low <= x <= high:
            return x
    return middle


def _more_rollers(target: Target, lines: Sequence[_LawLine]) -> list[list[Spec]]:
    """More rollers than the plain wheel takes, for each line as long as parts can be built."""
    specs_of_line: list[list[Spec]] = [[] for _ in lines]
    if target.rollers is not None:
        return specs_of_line
    more = [int(m) for m in target.counts if m >= 1.0]
    begin = [next((m for m in more if m > rollers_max(own.natural)), None) for own in lines]
    growing = {i: m for i, m in enumerate(begin) if m}
    while growing:
        specs = {i: some for i, m in growing.items() if (some := lines[i].some(m))}
        compute_parts_data(spec for some in specs.values() for spec in some)
        growing = {i: growing[i] + 1 for i in specs if any(map(has_no_obstacle, specs[i]))}
        for i in growing:
            specs_of_line[i].append(specs[i][0])
    return specs_of_line
