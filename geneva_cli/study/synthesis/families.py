"""The machines that may grant a wish: families, each with one number left free, or none.

For every number of slots, gearing and number of rollers: the plain crank, with radial slots and
with slots beside the centre; a side-crank; elliptical gears; a planet that carries the roller;
curved slots, and a cam along the crank, with an extra dwell alpha_0; on a sphere the angle between
the shafts. A side-crank, gears and a planet carry one roller: several would move the wheel
differently. Straight slots take as many rollers as leave a dwell. Curved slots take as many as
those of the plain wheel, and more for as long as their parts can be built.

Where the wish is one motion angle, the free number follows in closed form. Where it is a range,
the family's best is taken: what that is, is ``best``'s to say.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from itertools import count
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine import registry
from geneva_cli.machine.compatible import refuse_clashes
from geneva_cli.machine.drives.cam import Cam
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.drives.drive import Drive
from geneva_cli.machine.drives.elliptical_gears import EllipticalGears
from geneva_cli.machine.drives.epicyclic import Epicyclic
from geneva_cli.machine.drives.side_crank import SideCrank
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Motion, Spec
from geneva_cli.machine.wheels.classic import half_motion_deg, rollers_max
from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.numerics.angles import sin_cos_pi
from geneva_cli.study.synthesis import closed
from geneva_cli.study.synthesis.parts import parts
from geneva_cli.study.synthesis.spans import Span
from geneva_cli.study.synthesis.target import Wish

ROUNDING = 2e-15  # share of the natural motion: what a difference of two angles may be off by
EXACT = 1e-6  # share of the motion angle by which the plain crank may miss the wish
SHORTEST = 0.01  # share of a turn over m that an open end of a wish leaves to motion and to dwell
ASIDE = 0.1  # of L, by which offset slots miss the wheel's centre
PLANETS = ("sun", "ring")


class Family(NamedTuple):
    """Machines that differ in one number x from ``low`` to ``high``: ``make(x)`` is one's spec.

    At ``known``, where that is in the wish, the machine is one of another family.
    """

    make: Callable[[float], Spec]
    low: float = 0.0
    high: float = 0.0
    known: float = math.nan


class Frame:
    """What all machines of a wish have in common: speed, sizes, loads, limits."""

    def __init__(self, wish: Wish) -> None:
        self.wish = wish
        # one set of tables for all: a thousand of them would take a second to make
        self.own = wish.frame or Spec(registry.gearing(wish.gearings[0])(wish.z[0]))

    def spec(
        self,
        wheel: Gearing,
        drive: Callable[[float], Drive],
        m: int,
        motion_deg: float,
        motion: Motion | None = None,
    ) -> Spec:
        """A machine of the frame; ``drive`` makes its drive for an input speed."""
        found = drive(self.wish.n_rpm(m, motion_deg))
        own = self.own
        return own.but(wheel=wheel, drive=found, motion=motion, title="", path="", files=())

    def side_crank(self, wheel: Gearing, A: float) -> Spec:
        """A side-crank in front of a wheel; it carries one roller."""
        motion = closed.side_crank_motion(natural_deg(wheel), A)
        return self.spec(wheel, lambda n: SideCrank(A=A, n_rpm=n), 1, motion)

    def gears(self, wheel: Gearing, e: float) -> Spec:
        """Elliptical gears in front of a wheel, of the phase that the sign of e says."""
        size, phase = closed.phased(e)

        def drive(n: float) -> EllipticalGears:
            return EllipticalGears(eccentricity=size, phase=phase, n_rpm=n)

        return self.spec(wheel, drive, 1, closed.gears_motion(natural_deg(wheel), e))


def natural_deg(wheel: Gearing) -> float:
    """The plain crank's motion angle."""
    return 2.0 * wheel.half_motion_deg(wheel.step)


def wanted(wish: Wish, m: int, natural: float) -> Span:
    """The motion angles for m rollers; without a wish for one the plain crank's own."""
    found = wish.motion_for(m)
    return Span(natural, natural) if found is None else found


def holds(motion: Span, natural: float) -> bool:
    """Whether a motion angle is wished for, but for what the plain crank may miss it by."""
    slack = EXACT * natural
    return motion.low - slack <= natural <= motion.high + slack


def closed_span(motion: Span, m: int) -> Span | None:
    """A wished span of which an open end is taken near its limit; None where nothing is in it."""
    whole = 360.0 / m
    low = motion.low if motion.low > 0.0 else SHORTEST * whole
    high = motion.high if motion.high < whole else (1.0 - SHORTEST) * whole
    if motion.low >= whole or motion.high <= 0.0 or motion.empty:
        return None
    return Span(min(low, high), high) if not motion.exact else motion


def families(wish: Wish) -> Iterator[Family]:
    """All families that may grant a wish for motion angles."""
    for gearing in wish.gearings:
        for z in wish.z:
            wheel = registry.gearing(gearing)(z)
            yield from straight(wish, wheel)
            if wheel.FLAT:
                yield from _with_laws(wish, wheel)


def rollers(wish: Wish, natural: float) -> range:
    """The numbers of rollers to look at: as many as the straight slots take, or those asked for."""
    if wish.rollers is not None:
        return range(wish.rollers, wish.rollers + 1)
    return range(1, rollers_max(natural) + 1)


def plain(wish: Wish, wheel: Gearing, m: int) -> Spec:
    """The plain crank."""
    natural = natural_deg(wheel)
    return Frame(wish).spec(wheel, lambda n: Crank(n_rpm=n, rollers=m), m, natural)


def straight(wish: Wish, wheel: Gearing) -> Iterator[Family]:
    """The families with straight slots."""
    natural = natural_deg(wheel)
    for m in rollers(wish, natural):
        motion = wanted(wish, m, natural)
        if holds(motion, natural):
            yield _only(plain(wish, wheel, m))
            yield from _aside(wish, wheel, m)
            if m == 1:
                yield from planets(wish, wheel, natural)
        free = closed_span(motion, m)
        if m == 1 and free is not None and not (free.exact and holds(free, natural)):
            yield from _driven(wish, wheel, natural, free)
    if not wheel.FLAT:
        yield from _inclined(wish, wheel)


def _aside(wish: Wish, wheel: Gearing, m: int) -> Iterator[Family]:
    """Slots that miss the wheel's centre by a tenth of the centre distance: a gentler entry."""
    if "offset_mm" not in wheel.as_dict():
        return
    spec = plain(wish, wheel, m)
    e = spec.given_distance_mm * ASIDE
    yield Family(lambda x: spec.with_("wheel.offset_mm", e))


def planets(wish: Wish, wheel: Gearing, natural: float) -> Iterator[Family]:
    """A roller on a planet: without a jump at entry, and with its planet's crank left free."""
    z, frame = wheel.z, Frame(wish)
    if z not in (3, 4, 6):
        return

    def make(rp: float | str, fixed: str) -> Spec:
        def drive(n: float) -> Epicyclic:
            return Epicyclic(planet_ratio=rp, fixed=fixed, n_rpm=n)

        return frame.spec(wheel, drive, 1, natural)

    for fixed in PLANETS:
        try:
            refuse_clashes(make("shockless", fixed))
        except GenevaError:  # a wheel that it does not drive
            return
        yield Family(lambda x, fixed=fixed: make("shockless", fixed))  # type: ignore[misc]
        l, teeth = sin_cos_pi(1, z)[0], 2 * z // (z - 2)
        c = 1.0 + teeth if fixed == "sun" else 1.0 - teeth
        least = -l / (1.0 + c if c > 0.0 else teeth)
        inside = least * (1.0 - 1e-6), l / (c * c - 1.0) * (1.0 - 1e-9)
        yield Family(lambda rp, fixed=fixed: make(rp, fixed), *inside)  # type: ignore[misc]


def _driven(wish: Wish, wheel: Gearing, natural: float, motion: Span) -> Iterator[Family]:
    """The drives in front of the crank that make a motion angle."""
    frame = Frame(wish)
    side_crank, gears = partial(frame.side_crank, wheel), partial(frame.gears, wheel)
    yield from _between(side_crank, closed.side_crank, natural, motion)
    yield from _between(gears, closed.eccentricity, natural, motion)


def _between(
    make: Callable[[float], Spec],
    inverse: Callable[[float, float], float],
    natural: float,
    motion: Span,
) -> Iterator[Family]:
    """A drive whose parameter rises with its motion, as far as it goes."""
    low, high = (inverse(natural, x) for x in motion)
    if low <= closed.MOST and high >= -closed.MOST:
        plain_too = 0.0 if holds(motion, natural) else math.nan
        yield Family(make, max(low, -closed.MOST), min(high, closed.MOST), plain_too)


def _inclined(wish: Wish, wheel: Gearing) -> Iterator[Family]:
    """Plain cranks on shafts that meet at another angle than a right one."""
    z, frame = wheel.z, Frame(wish)
    least = 2.0 * half_motion_deg(1.0, 1, z)
    for m in [wish.rollers] if wish.rollers else range(1, rollers_max(least) + 1):
        motion = wish.motion_for(m)
        free = closed_span(motion, m) if motion else None
        if free is None or (free.exact and holds(free, 180.0)):
            continue

        def make(axes: float, m: int = m) -> Spec:
            reached = closed.axes_motion(z, axes)
            inclined = wheel.with_key("axes_deg", axes)
            return frame.spec(inclined, lambda n: Crank(n_rpm=n, rollers=m), m, reached)

        low, high = (closed.axes(z, x) for x in free)
        if low <= 180.0 - closed.AXES and high >= closed.AXES:
            right = 90.0 if holds(free, 180.0) else math.nan
            yield Family(make, max(low, closed.AXES), min(high, 180.0 - closed.AXES), right)


def _with_laws(wish: Wish, wheel: Gearing) -> Iterator[Family]:
    """Curved slots, and cams, with each law: the longest motion is the gentlest, see ``best``."""
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
                    yield _only(spec)
                    yield _cam(wish, spec, natural)
            yield from map(_only, more_rollers(wish, natural, lambda m: at(m, high=True)))


def _only(spec: Spec) -> Family:
    return Family(lambda x: spec)


def cam(spec: Spec) -> Spec:
    """The law of curved slots with straight ones, made by a groove along the crank."""
    given = spec.drive
    assert spec.motion is not None
    drive = Cam(n_rpm=given.n_rpm, rollers=given.rollers)
    return spec.but(drive=drive, motion=spec.motion.but(ratio=None))


def _cam(wish: Wish, spec: Spec, natural: float) -> Family:
    """The same, in a range with a motion after which crank and slot are not yet parallel."""
    m, wheel, motion = spec.drive.rollers, spec.wheel, spec.motion
    assert motion is not None
    free = wanted(wish, m, natural)
    parallel = (1.0 - SHORTEST) * (360.0 - wheel.SIGN * 360.0 / wheel.z)
    longest = natural - motion.alpha0_deg
    if not free.exact and free.low < parallel < longest:
        spec = curved(wish, wheel, m, parallel, motion.law.NAME)
    return _only(cam(spec))


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
