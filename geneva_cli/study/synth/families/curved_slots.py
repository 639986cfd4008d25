"""Curved slots and cams along the crank: a law gives the motion, with an extra dwell alpha_0.

Both take as many rollers as the plain wheel, and more as long as their parts can be built.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial
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
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import MARGIN
from geneva_cli.study.law_values import characteristic
from geneva_cli.study.synth.families import closed
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


@cache
def standard(law: str) -> Law:
    """A law by its name, with standard parameters."""
    return registry.law(law)()


def with_laws(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """Curved slots and cams with each law.

    In a range of motions the longest is the gentlest, and the plain crank's own is added. With
    bounds or another goal, every motion of the range is possible. Below a limit of acceleration
    alone, the motion nearest to the plain crank's is best; the law's peak gives it in closed form.
    """
    lines = [
        own
        for wheel in wheels
        if wheel.FLAT
        for law in target.laws
        for own in _lines(target, wheel, law)
    ]
    several = more_rollers(target, [(own.natural, own.some) for own in lines])
    for own, more in zip(lines, several, strict=True):
        yield from own.families(more)


def _lines(target: Target, wheel: Gearing, law: str) -> tuple[_LawMachines, _LawMachines]:
    """Curved slots, and cams, of a wheel and a law."""
    natural, until = natural_deg(wheel), partial(_until_parallel, wheel)
    step, cost = 2.0 * math.pi / wheel.z, characteristic(standard(law))
    limit = target.acceleration_max
    least = closed.law_motion_deg(step, cost.acceleration, limit * (1.0 - MARGIN)) if limit else 0.0
    fast = cost.velocity * step if wheel.SIGN < 0.0 else 0.0

    def matched(motion: float) -> float:
        """The motion, or a longer one for a wheel that is too quick for curved slots inside.

        Where it turns half as fast as the crank, R/L is 1; at 0.45 it is 9/11.
        """
        return math.degrees(fast / 0.45) if fast >= 0.5 * math.radians(motion) else motion

    make, grooved = partial(curved, target, wheel, law), partial(cam, target, wheel, law)
    return (
        _LawMachines(target, natural, make, lambda motions: motions, least, matched),
        _LawMachines(target, natural, grooved, until, least, lambda motion: motion),
    )


class _LawMachines(NamedTuple):
    """Machines of one wheel and law: ``make`` takes the number of rollers and the motion."""

    target: Target
    natural: float
    make: Callable[[int, float], Spec]
    reached: Callable[[AllowedSpan], AllowedSpan]
    least: float
    possible: Callable[[float], float]

    def families(self, more: Sequence[Spec]) -> Iterator[Family]:
        """The families, including those with ``more`` rollers than the plain wheel takes."""
        if self.target.only_acceleration:
            every = [*rollers(self.target, self.natural), *(spec.drive.rollers for spec in more)]
            yield from map(self._below, every)
            return
        for m in rollers(self.target, self.natural):
            free = self._motions(m)
            if free is None:
                continue
            own = allows(free, self.natural)
            plain = AllowedSpan(self.natural, self.natural)
            yield self._free(m, plain if own and free.exact else free)
            if own:
                yield Family(self.make(m, self.natural))
        for spec in more:
            m = spec.drive.rollers
            yield self._free(m, self._motions(m) or AllowedSpan(self.natural, self.natural))

    def some(self, m: int) -> list[Spec]:
        """The gentlest machine of m rollers and, in a range, some others."""
        if self.target.only_acceleration:
            return [self.make(m, self._below(m).best)]
        free = self._motions(m)
        if not free:
            return []
        low, high = free
        return [self.make(m, x) for x in dict.fromkeys((high, 0.5 * (low + high), low))]

    def _below(self, m: int) -> Family:
        """The machines below a limit of acceleration; the nearest to the plain crank is best."""
        most = longest_deg(m)
        best = self.possible(max(self.least, min(self.natural, most)))
        return self._line(m, AllowedSpan(self.least, max(most, best)), best)

    def _motions(self, m: int) -> AllowedSpan | None:
        allowed = closed_span(allowed_motions(self.target, m, self.natural), m)
        return self.reached(allowed) if allowed else None

    def _free(self, m: int, motion: AllowedSpan) -> Family:
        """The machines of a range of motions, the longest of which is the gentlest."""
        best = math.nan if self.target.bounds or self.target.sort else motion.high
        return self._line(m, motion, best)

    def _line(self, m: int, motion: AllowedSpan, best: float) -> Family:
        keys = partial(_motions, self.target, self.natural, m)
        return line(self.make(m, motion.high), keys, motion, plain=(self.natural,), best=best)


def _until_parallel(wheel: Gearing, motion: AllowedSpan) -> AllowedSpan:
    """The range up to the motion at which crank and slot would be parallel."""
    parallel = (1.0 - OPEN_END) * (360.0 - wheel.SIGN * 360.0 / wheel.z)
    inside = not motion.exact and motion.low < parallel
    return AllowedSpan(motion.low, min(motion.high, parallel)) if inside else motion


def more_rollers(
    target: Target, lines: Sequence[tuple[float, Callable[[int], Sequence[Spec]]]]
) -> list[list[Spec]]:
    """More rollers than the plain wheel takes, for each line as long as parts can be built."""
    specs_of_line: list[list[Spec]] = [[] for _ in lines]
    if target.rollers is not None:
        return specs_of_line
    more = [int(m) for m in target.counts if m >= 1.0]
    begin = [next((m for m in more if m > rollers_max(natural)), None) for natural, _ in lines]
    growing = {i: m for i, m in enumerate(begin) if m}
    while growing:
        specs = {i: some for i, m in growing.items() if (some := lines[i][1](m))}
        compute_parts_data(first for first, *_ in specs.values())
        stuck = {i for i, (first, *_) in specs.items() if not has_no_obstacle(first)}
        compute_parts_data(spec for i in stuck for spec in specs[i][1:])
        stuck = {i for i in stuck if not any(map(has_no_obstacle, specs[i][1:]))}
        growing = {i: growing[i] + 1 for i in specs if i not in stuck}
        for i in growing:
            specs_of_line[i].append(specs[i][0])
    return specs_of_line


def curved(target: Target, wheel: Gearing, law: str, m: int, motion: float) -> Spec:
    """Curved slots, with the motion's alpha_0."""
    law_motion = Motion(
        standard(law), alpha0_deg=_alpha0(target, natural_deg(wheel), motion), ratio="matched"
    )
    return machine(target, wheel, lambda n: Crank(n_rpm=n, rollers=m), m, motion, law_motion)


def cam(target: Target, wheel: Gearing, law: str, m: int, motion: float) -> Spec:
    """A cam: straight slots with the law's motion, made by a groove along the crank."""
    law_motion = Motion(standard(law), alpha0_deg=_alpha0(target, natural_deg(wheel), motion))
    return machine(target, wheel, lambda n: Cam(n_rpm=n, rollers=m), m, motion, law_motion)


def _motions(target: Target, natural: float, m: int, at: Array) -> dict[str, Array]:
    motions = at[:, 0].tolist()
    alpha0 = np.array([_alpha0(target, natural, motion) for motion in motions])
    return {"motion.alpha0_deg": alpha0, **speeds(target, m, motions)}


def _alpha0(target: Target, natural: float, motion: float) -> float:
    """The shortest alpha_0 that makes a motion."""
    alpha0 = natural - motion
    spare = 2e-15 * natural  # the rounding of a difference of two angles
    # A motion that is shorter, by however little, would break a limit that it just keeps.
    most = alpha0 if target.acceleration_max else alpha0 + spare
    return closed.shortest(alpha0 - spare, most)
