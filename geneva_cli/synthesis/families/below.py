"""Curved slots and cams for a limit of peak acceleration alone.

Their motion is the nearest to the plain crank's that keeps the limit, in a closed form of the law's
peaks. The search over the motion would find it as well, and takes 4 times as long for all laws.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from geneva_cli.analysis.law_values import characteristic
from geneva_cli.kinematics.wheels.gearing import Gearing
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.tolerances import MARGIN
from geneva_cli.study.target import Target
from geneva_cli.synthesis.families import closed
from geneva_cli.synthesis.families.curved import cam, curved, more_rollers, standard
from geneva_cli.synthesis.families.family import Family, longest_deg, natural_deg, only, rollers

PARALLEL = 0.5  # the wheel's velocity at which curved slots inside cannot exist: R/L is 1


def laws_below(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """Curved slots and cams, with a motion long enough for the law's peak to keep the limit."""
    yield from map(only, _with_laws(target, wheels))


def _with_laws(target: Target, wheels: Sequence[Gearing]) -> Iterator[Spec]:
    lines: list[tuple[float, Callable[[int], Spec]]] = []
    for wheel in wheels:
        if wheel.FLAT:
            for law in target.laws:
                lines += _lines(target, wheel, law)
    for natural, make in lines:
        yield from map(make, rollers(target, natural))
    alone = [(natural, lambda m, make=make: [make(m)]) for natural, make in lines]
    for more in more_rollers(target, alone):
        yield from more


def _lines(
    target: Target, wheel: Gearing, law: str
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

    def motion(m: int) -> float:
        return max(least, min(natural, longest_deg(m)))

    def slower(m: int) -> float:
        parallel = inside and fast >= PARALLEL * math.radians(motion(m))
        return math.degrees(fast / 0.45) if parallel else motion(m)  # R/L is 9/11

    yield natural, lambda m: curved(target, wheel, law, m, slower(m))
    yield natural, lambda m: cam(target, wheel, law, m, motion(m))
