"""Two Geneva wheels in series: the first wheel carries the crank of the second.

The second wheel moves during one step of the first, once in a turn of the first wheel. It starts
from a crank that is itself starting or running. So its jump is the first wheel's speed squared
times tan b. There is none if both motions begin together, as with four slots on four.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, NamedTuple

from geneva_cli.drives.pushed import CirclingPush, PushedCrank
from geneva_cli.drives.transmission import LocalTransmission, Transmission
from geneva_cli.motion.compatible import KIND, ONE_ROLLER, Conflict, of_transmission, unset
from geneva_cli.motion.drive import Plan
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.pivots import Dimension, Joint, Layout, Link, Pivot, ShaftPlace
from geneva_cli.motion.wheels import classic
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import of_each, radians, sin_cos_pi
from geneva_cli.numerics.arrays import Number, choose, choose_record, library
from geneva_cli.numerics.jet import Array, Displacement, Jet, rotation, sine_versine_of, turning
from geneva_cli.spec.rules import POSITIVE, Z_MAX, Range


class GenevaPair(Transmission, kw_only=True):
    """An external wheel in front of the crank: one index in many turns of the input.

    ``first_z`` is its number of slots, and the number of input turns for one index.

    >>> Design(External(4), GenevaPair(first_z=4)).timing.cycle_s  # at 60 rpm
    4.0
    """

    NAME: ClassVar[str] = "geneva-pair"
    WORDS: ClassVar[str] = "a crank behind a first Geneva wheel"
    length_key: ClassVar[str] = "first_distance_mm"
    first_z: Annotated[int, Range(3, Z_MAX), "number of slots of the first, external wheel"]
    first_distance_mm: Annotated[
        float | None, POSITIVE, "first centre distance, for its forces (parts use L by default)"
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        vars(self)["turns"] = self.first_z
        vars(self)["reach_deg"] = 180.0 / self.first_z  # the first wheel's half step

    def input_shaft(self, plan: Plan, sign: float, sense: float) -> ShaftPlace:
        """The shaft of the first crank, which turns against its wheel."""
        L = plan.center_distance_mm
        return ShaftPlace(L + self._distance_mm(L), -sense)

    def layout(self, plan: Plan, sign: float) -> Layout:
        """Pivots and dimensions of the first pair."""
        L = plan.center_distance_mm
        first = self._distance_mm(L)
        radius = first * classic.HalfStep.of(1, self.first_z).sin_cos[0]
        return (
            Pivot("first crank axis", L + first, 0.0),
            Dimension("first wheel's slots", self.first_z),
            Dimension("first centre distance", first, "mm"),
            Dimension("first crank radius", radius, "mm"),
        )

    def links(self, plan: Plan, sign: float, input_deg: Array) -> tuple[Link, ...]:
        """The first crank, and the rim of the first wheel, at input angles."""
        L, step = plan.center_distance_mm, classic.HalfStep.of(1, self.first_z)
        turn, still, first = radians(input_deg), 0.0 * input_deg, self._distance_mm(L)
        m, R, far = library(turn), first * step.sin_cos[0], L + first
        pin = far - R * m.cos(turn), -sign * R * m.sin(turn)
        axis, shaft = (still + far, still), Joint.SHAFT
        return (
            Link("first crank", (axis, pin), (shaft, Joint.ROLLER), 3),
            Link("first wheel", ((still + L, still),), (shaft,), 2, first * step.sin_cos[1]),
        )

    def first_wheel(self, L: float) -> tuple[int, float]:
        """Slots of the first wheel, and its centre distance."""
        return self.first_z, self._distance_mm(L)

    def _distance_mm(self, L: float) -> float:
        return L if self.first_distance_mm is None else self.first_distance_mm

    def reactions(
        self, wheel: Gearing, advance: Displacement, mid_deg: float, L: float
    ) -> PushedCrank | None:
        """Reactions to the first crank's roller, which pushes across the first wheel's slot."""
        if self.first_distance_mm is None:
            return None
        l = classic.HalfStep.of(1, self.first_z).sin_cos[0]
        distance = self.first_distance_mm / L
        # the first crank turns against its wheel, which turns with the second crank
        height = -wheel.SIGN * l * distance
        return CirclingPush(1.0, -l, distance, height, radians(mid_deg))

    def about(self, crank_deg: float) -> LocalTransmission:
        """Transmission about an angle of the second crank (degrees) within the first step."""
        entry, middle, exit_ = classic.radial(1.0, classic.HalfStep.of(1, self.first_z))
        reach = self.reach_deg
        inside = choose(abs(crank_deg) < reach, crank_deg, 0.0)
        running = _running(middle, _crank_at(self.first_z, inside))
        ends = choose_record(crank_deg < 0.0, entry, exit_)
        pose = choose_record(abs(crank_deg) == reach, ends, running)
        return pose.crank_deg, FirstWheelRotation(pose)


class FirstWheelRotation(NamedTuple):
    """The first wheel, which carries the second crank, about a pose of its own roller."""

    pose: classic.PinPose

    def __call__(self, tau: Number, order: int) -> tuple[Jet, Jet]:
        """sin d and 1 - cos d of its rotation d since then, ``tau`` input radians later."""
        along, across = classic.PinTravel(self.pose, rotation)(tau, max(order, 1))
        along = along + self.pose.along
        rate = turning(along, across)
        return sine_versine_of(rate, across.c[0], along.c[0], order)


def _crank_at(first_z: int, wheel_deg: float) -> float:
    """Angle a of the first crank, radians, with its wheel at psi: sin(a + psi) = sin psi / l.

    With k = l cos(a + psi) = sqrt(sin(b - psi) sin(b + psi)), nothing cancels in

        l sin a = sin psi cos² b / (cos psi + k),   l cos a = k cos psi + sin² psi
    """
    if not (isinstance(first_z, int) and isinstance(wheel_deg, float)):
        return of_each(lambda z, deg: (_crank_at(z, deg),), first_z, wheel_deg)[0]
    step = classic.HalfStep.of(1, first_z)
    n, d = wheel_deg.as_integer_ratio()
    whole = 180 * d * step.q
    here, less = 180 * d * step.p, n * step.q  # b and psi, in fractions of pi
    s, c = sin_cos_pi(less, whole)
    k = math.sqrt(sin_cos_pi(here - less, whole)[0] * sin_cos_pi(here + less, whole)[0])
    return math.atan2(s * step.sin_cos[1] ** 2 / (c + k), k * c + s * s)


def _running(middle: classic.PinPose, a: float) -> classic.PinPose:
    """Pose of the first crank's pin at an angle a (radians) from mid-motion."""
    m = library(a, middle.along)
    l, s, c = middle.bend[0], m.sin(a), m.cos(a)
    x, y = middle.along + 2.0 * l * m.sin(0.5 * a) ** 2, l * s
    rho = m.hypot(x, y)
    u, v = x / rho, y / rho
    along, across = l * (s * u + c * v), l * (c * u - s * v)
    return classic.PinPose(m.degrees(a), m.atan2(y, x), rho, (along, across), (across, -along))


def refuses(spec: Spec) -> Iterator[Conflict]:
    """Rules of a second crank, which has one roller."""
    yield from unset(spec, ONE_ROLLER, f"is not for {KIND}, which carries one roller")
    yield from of_transmission(spec)
