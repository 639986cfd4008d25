"""Families for a limit of peak acceleration alone: the plain crank, or the least change from it.

A drive's parameter is the one nearest to the plain crank that keeps the limit. So is the motion of
curved slots and cams.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

from geneva_cli.analysis.law_values import characteristic
from geneva_cli.analysis.peaks import peak
from geneva_cli.kinematics.wheels.gearing import Gearing
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.tolerances import MARGIN
from geneva_cli.study.target import Target
from geneva_cli.synthesis.families import closed
from geneva_cli.synthesis.families import limit as limits
from geneva_cli.synthesis.families.curved import cam, curved, more_rollers, standard
from geneva_cli.synthesis.families.family import Family, longest_deg, natural_deg, only, rollers
from geneva_cli.synthesis.families.straight import (
    driven,
    gears,
    offset_slots,
    plain,
    planets,
    side_crank,
)
from geneva_cli.synthesis.families.two_stages import two_stages

PARALLEL = 0.5  # the wheel's velocity at which curved slots inside cannot exist: R/L is 1


def straight(target: Target, wheels: Sequence[Gearing], reached: list[float]) -> Iterator[Family]:
    """The families with straight slots; the lowest peak of each drive is added to ``reached``."""
    for wheel in wheels:
        yield from map(only, _specs(target, wheel, reached))
        for m in rollers(target, natural_deg(wheel)):
            yield from offset_slots(target, wheel, m)
        if wheel.SHELLS:
            yield from driven(target, wheel)
        if target.rollers in (None, 1):
            yield from planets(target, wheel)
        yield from two_stages(target, wheel)


def _specs(target: Target, wheel: Gearing, reached: list[float]) -> Iterator[Spec]:
    assert target.acceleration_max is not None
    natural = natural_deg(wheel)
    every = rollers(target, natural)
    natural_peak = peak(build(plain(target, wheel, 1)).engagements[0].motion, "acceleration").max
    gentle = natural_peak <= target.acceleration_max
    if gentle:
        yield from (plain(target, wheel, m) for m in every)
    elif not target.rollers or natural * target.rollers < 360.0:
        reached.append(natural_peak)
    if wheel.SHELLS:
        return
    limit = target.acceleration_max * (1.0 - MARGIN)
    if 1 in every and not gentle:
        yield from _driven(target, wheel, limit, reached)


def _driven(target: Target, wheel: Gearing, limit: float, reached: list[float]) -> Iterator[Spec]:
    """The drives in front of the crank that reduce a peak acceleration to the limit."""
    makes: tuple[tuple[limits.Ratio, Callable[[float], Spec]], ...] = (
        (limits.side_crank, partial(side_crank, target, wheel)),
        (limits.elliptical_gears, partial(gears, target, wheel)),
    )
    for ratio, make in makes:
        x, least = limits.least_parameter(limits.peak_of(wheel, ratio), limit)
        reached.append(least)
        if x is not None:
            yield make(x)


def with_laws(target: Target, wheels: Sequence[Gearing], reached: list[float]) -> Iterator[Family]:
    """Curved slots and cams, with a motion long enough for the law's peak to keep the limit."""
    yield from map(only, _with_laws(target, wheels, reached))


def _with_laws(target: Target, wheels: Sequence[Gearing], reached: list[float]) -> Iterator[Spec]:
    lines: list[tuple[float, Callable[[int], Spec]]] = []
    for wheel in wheels:
        if wheel.FLAT:
            for law in target.laws:
                lines += _lines(target, wheel, law, reached)
    for natural, make in lines:
        yield from map(make, rollers(target, natural))
    alone = [(natural, lambda m, make=make: [make(m)]) for natural, make in lines]
    for more in more_rollers(target, alone):
        yield from more


def _lines(
    target: Target, wheel: Gearing, law: str, reached: list[float]
) -> Iterator[tuple[float, Callable[[int], Spec]]]:
    """Makers of a curved slot and a cam by their number of rollers.

    Their motion is the plain crank's, or the nearest to it that its rollers and the limit allow.
    Inside, that may be too quick for curved slots of any R/L: they get a longer one.
    """
    assert target.acceleration_max is not None
    limit = target.acceleration_max * (1.0 - MARGIN)
    natural, step = natural_deg(wheel), 2.0 * math.pi / wheel.z
    cost = characteristic(standard(law))
    least = closed.law_motion_deg(step, cost.acceleration, limit)
    inside, fast = wheel.SIGN < 0.0, cost.velocity * step
    for m in rollers(target, natural):
        whole = 2.0 * math.pi / m
        if not inside or fast < PARALLEL * whole:
            reached.append(cost.acceleration * step / whole**2)

    def motion(m: int) -> float:
        return max(least, min(natural, longest_deg(m)))

    def slower(m: int) -> float:
        parallel = inside and fast >= PARALLEL * math.radians(motion(m))
        return math.degrees(fast / 0.45) if parallel else motion(m)  # R/L is 9/11

    yield natural, lambda m: curved(target, wheel, law, m, slower(m))
    yield natural, lambda m: cam(target, wheel, law, m, motion(m))
