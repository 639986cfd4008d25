"""Curved slots, and a cam along the crank: a law gives the motion, with an extra dwell alpha_0.

Both take as many rollers as the plain wheel, and more for as long as their parts can be built.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache, partial
from itertools import count

from geneva_cli.analysis.law_values import Characteristic, characteristic
from geneva_cli.errors import GenevaError
from geneva_cli.machine import registry
from geneva_cli.machine.drives.cam import Cam
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.spec import Motion, Spec
from geneva_cli.machine.wheels.classic import rollers_max
from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.study.synthesis.families import closed
from geneva_cli.study.synthesis.families.family import (
    SHORTEST,
    Family,
    closed_span,
    holds,
    machine,
    natural_deg,
    only,
    rollers,
    wanted,
)
from geneva_cli.study.synthesis.parts import suited
from geneva_cli.study.synthesis.spans import Interval
from geneva_cli.study.synthesis.wish import Wish

ROUNDING = 2e-15  # share of the natural motion: what a difference of two angles may be off by


@cache
def law_costs(law: str) -> Characteristic:
    """The greatest values of a law."""
    return characteristic(registry.law(law)())


def with_laws(wish: Wish, wheel: Gearing) -> Iterator[Family]:
    """Curved slots, and cams, with each law: of a range the longest motion, which is the gentlest,
    and the plain crank's own; where the wish has bounds, or something else is to be least, any.
    """
    if not wheel.FLAT:
        return
    for law in wish.laws:
        make = partial(curved, wish, wheel, law)
        yield from _of_law(wish, wheel, make, lambda motion: motion)
        yield from _of_law(wish, wheel, partial(_grooved, make), partial(_until_parallel, wheel))


def _of_law(
    wish: Wish,
    wheel: Gearing,
    make: Callable[[int, float], Spec],
    reached: Callable[[Interval], Interval],
) -> Iterator[Family]:
    """``make`` makes the machine of so many rollers and such a motion; ``reached`` says which
    motions of a span it makes.
    """
    natural = natural_deg(wheel)

    def motions(m: int) -> Interval | None:
        asked = closed_span(wanted(wish, m, natural), m)
        return reached(asked) if asked else None

    for m in rollers(wish, natural):
        free = motions(m)
        if free is None:
            continue
        own = holds(free, natural)
        motion = Interval(natural, natural) if own and free.exact else free
        yield _free(wish, partial(make, m), motion, natural)
        if own:
            yield only(make(m, natural))

    def longest(m: int) -> Spec | None:
        free = motions(m)
        return make(m, free.high) if free else None

    for spec in more_rollers(wish, natural, longest):
        m = spec.drive.rollers
        yield _free(wish, partial(make, m), motions(m) or Interval(natural, natural), natural)


def _free(wish: Wish, make: Callable[[float], Spec], motion: Interval, natural: float) -> Family:
    """The machines of some motions, or the one of the longest where only its peak counts."""
    low = motion.low if wish.bounds or wish.sort else motion.high
    return Family(make, low, motion.high, plain=natural)


def _grooved(make: Callable[[int, float], Spec], m: int, motion: float) -> Spec:
    return cam(make(m, motion))


def _until_parallel(wheel: Gearing, motion: Interval) -> Interval:
    """Of a range the motions after which crank and slot are not yet parallel, where there are."""
    parallel = (1.0 - SHORTEST) * (360.0 - wheel.SIGN * 360.0 / wheel.z)
    inside = not motion.exact and motion.low < parallel
    return Interval(motion.low, min(motion.high, parallel)) if inside else motion


def cam(spec: Spec) -> Spec:
    """The law of curved slots with straight ones, made by a groove along the crank."""
    given = spec.drive
    assert spec.motion is not None
    drive = Cam(n_rpm=given.n_rpm, rollers=given.rollers)
    return spec.replace(drive=drive, motion=spec.motion.replace(ratio=None))


def more_rollers(wish: Wish, natural: float, make: Callable[[int], Spec | None]) -> Iterator[Spec]:
    """More rollers than the plain wheel takes, while the parts can be built."""
    if wish.rollers is not None:
        return
    for m in count(rollers_max(natural) + 1):
        spec = make(m)
        try:
            if spec is None or suited(spec)[1].why:
                return
        except GenevaError:
            return
        yield spec


def curved(wish: Wish, wheel: Gearing, law: str, m: int, motion: float) -> Spec:
    """Curved slots, with the shortest alpha_0 that makes the motion."""
    natural = natural_deg(wheel)
    alpha0, spare = natural - motion, ROUNDING * natural
    # A motion that is shorter, by however little, would break a limit that it just keeps.
    most = alpha0 if wish.acceleration_max else alpha0 + spare
    shortest = closed.shortest(alpha0 - spare, most)
    given = Motion(registry.law(law)(), alpha0_deg=shortest, ratio="matched")
    return machine(wish, wheel, lambda n: Crank(n_rpm=n, rollers=m), m, motion, given)
