"""Curved slots, and a cam along the crank: a law gives the motion, with an extra dwell alpha_0.

Curved slots take as many rollers as those of the plain wheel, and more for as long as their parts
can be built.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from itertools import count

from geneva_cli.analysis.law_values import Characteristic, characteristic
from geneva_cli.errors import GenevaError
from geneva_cli.machine import registry
from geneva_cli.machine.drives.cam import Cam
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Motion, Spec
from geneva_cli.machine.wheels.classic import rollers_max
from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.study.synthesis.families import closed
from geneva_cli.study.synthesis.families.family import (
    SHORTEST,
    Family,
    Frame,
    closed_span,
    holds,
    natural_deg,
    only,
    rollers,
    wanted,
)
from geneva_cli.study.synthesis.parts import parts
from geneva_cli.study.synthesis.wish import Wish

ROUNDING = 2e-15  # share of the natural motion: what a difference of two angles may be off by


@cache
def law_costs(law: str) -> Characteristic:
    """The greatest values of a law."""
    return characteristic(registry.law(law)())


def with_laws(wish: Wish, wheel: Gearing) -> Iterator[Family]:
    """Curved slots, and cams, with each law: the longest motion is the gentlest, see ``best``."""
    if not wheel.FLAT:
        return
    natural = natural_deg(wheel)
    for law in wish.laws:

        def at(m: int, law: str = law, *, high: bool) -> Spec | None:
            free = closed_span(wanted(wish, m, natural), m)
            if free is None:
                return None
            motion = natural if holds(free, natural) and (free.exact or not high) else free.high
            return curved(wish, wheel, m, motion, law)

        for high in (True, False):
            for m in rollers(wish, natural):
                spec = at(m, high=high)
                if spec is not None:
                    yield only(spec)
                    yield _cam(wish, spec, natural)
            yield from map(only, more_rollers(wish, natural, lambda m: at(m, high=True)))


def _cam(wish: Wish, spec: Spec, natural: float) -> Family:
    """The same, in a range with a motion after which crank and slot are not yet parallel."""
    m, wheel, motion = spec.drive.rollers, spec.wheel, spec.motion
    assert motion is not None
    free = wanted(wish, m, natural)
    parallel = (1.0 - SHORTEST) * (360.0 - wheel.SIGN * 360.0 / wheel.z)
    longest = natural - motion.alpha0_deg
    if not free.exact and free.low < parallel < longest:
        spec = curved(wish, wheel, m, parallel, motion.law.NAME)
    return only(cam(spec))


def cam(spec: Spec) -> Spec:
    """The law of curved slots with straight ones, made by a groove along the crank."""
    given = spec.drive
    assert spec.motion is not None
    drive = Cam(n_rpm=given.n_rpm, rollers=given.rollers)
    return spec.but(drive=drive, motion=spec.motion.but(ratio=None))


def more_rollers(wish: Wish, natural: float, make: Callable[[int], Spec | None]) -> Iterator[Spec]:
    """More rollers than the straight slots take, while the curved ones can be built."""
    if wish.rollers is not None:
        return
    for m in count(rollers_max(natural) + 1):
        spec = make(m)
        try:
            if spec is None or parts(build(spec)).why:
                return
        except GenevaError:
            return
        yield spec


def curved(wish: Wish, wheel: Gearing, m: int, motion: float, law: str) -> Spec:
    """Curved slots, with the shortest alpha_0 that makes the motion."""
    natural = natural_deg(wheel)
    alpha0, spare = natural - motion, ROUNDING * natural
    # A motion that is shorter, by however little, would break a limit that it just keeps.
    most = alpha0 if wish.acceleration_max else alpha0 + spare
    shortest = closed.shortest(alpha0 - spare, most)
    given = Motion(registry.law(law)(), alpha0_deg=shortest, ratio="matched")
    return Frame(wish).spec(wheel, lambda n: Crank(n_rpm=n, rollers=m), m, motion, given)
