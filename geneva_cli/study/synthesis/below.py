"""A wish for a peak acceleration alone: the plain crank, or the least change that brings it down.

A drive's parameter is the one nearest to the plain crank that does; curved slots and cams get the
motion on which their law's peak is the limit.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial

from geneva_cli.analysis.law_values import Characteristic, characteristic
from geneva_cli.analysis.peaks import acceleration_peak
from geneva_cli.machine import registry
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.study.synthesis import closed
from geneva_cli.study.synthesis import limit as limits
from geneva_cli.study.synthesis.families import (
    Family,
    Frame,
    cam,
    curved,
    more_rollers,
    natural_deg,
    plain,
    planets,
    rollers,
)
from geneva_cli.study.synthesis.target import MARGIN, Wish


def below(wish: Wish, reached: list[float]) -> Iterator[Family]:
    """The families to try; peaks that are as low as a drive brings them go to ``reached``."""
    costs = {law: characteristic(registry.law(law)()) for law in wish.laws}
    for gearing in wish.gearings:
        for z in wish.z:
            wheel = registry.gearing(gearing)(z)
            yield from (_only(s) for s in _specs(wish, wheel, costs, reached))
            if wish.rollers in (None, 1):
                yield from planets(wish, wheel, natural_deg(wheel))


def _only(spec: Spec) -> Family:
    return Family(lambda x: spec)


def _specs(
    wish: Wish, wheel: Gearing, costs: dict[str, Characteristic], reached: list[float]
) -> Iterator[Spec]:
    assert wish.acceleration_max is not None
    natural = natural_deg(wheel)
    every = rollers(wish, natural)
    peak = acceleration_peak(build(plain(wish, wheel, 1)).engagements[0]).max
    if peak <= wish.acceleration_max:
        yield from (plain(wish, wheel, m) for m in every)
        return
    if not wish.rollers or natural * wish.rollers < 360.0:
        reached.append(peak)
    if not wheel.FLAT:
        return
    limit = wish.acceleration_max * (1.0 - MARGIN)
    if 1 in every:
        yield from _driven(wish, wheel, limit, reached)
    for law in wish.laws:
        yield from _curved(wish, wheel, limit, costs[law], law, reached)


def _driven(wish: Wish, wheel: Gearing, limit: float, reached: list[float]) -> Iterator[Spec]:
    """The drives in front of the crank that bring a peak acceleration down, if they do."""
    frame = Frame(wish)
    makes: tuple[tuple[limits.Ratio, Callable[[float], Spec]], ...] = (
        (limits.side_crank, partial(frame.side_crank, wheel)),
        (limits.elliptical_gears, partial(frame.gears, wheel)),
    )
    for ratio, make in makes:
        x, least = limits.least_parameter(limits.peak_of(wheel, ratio), limit)
        reached.append(least)
        if x is not None:
            yield make(x)


def _curved(
    wish: Wish,
    wheel: Gearing,
    limit: float,
    cost: Characteristic,
    law: str,
    reached: list[float],
) -> Iterator[Spec]:
    """Curved slots over a motion so long that the law's peak acceleration is the limit."""
    natural, step = natural_deg(wheel), 2.0 * math.pi / wheel.z
    motion = closed.law_motion_deg(step, cost.acceleration, limit)
    inside, fast = wheel.SIGN < 0.0, cost.velocity * step
    if inside and fast >= 0.5 * math.radians(motion) and motion < natural:
        motion = natural  # the limit's own motion is too quick for any R/L inside

    def make(m: int) -> Spec:
        return curved(wish, wheel, m, motion, law)

    for m in rollers(wish, natural):
        whole = 2.0 * math.pi / m
        if not inside or fast < 0.5 * whole:
            reached.append(cost.acceleration * step / whole**2)
        yield make(m)
        yield cam(make(m))
    yield from more_rollers(wish, natural, make)
