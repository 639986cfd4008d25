"""Gear sectors that replace the slot at a constant ratio, for steps that a slot cannot make.

The roller starts the wheel in a straight slot of half angle b. When the wheel reaches u times the
crank's speed, toothed sectors drive it at that ratio for a crank angle D. Then the next roller
stops the wheel in its own slot.

The speeds agree at the crank angle a_t with sin²(a_t/2) = w (1-w) / (2l (1+u) (1 + 2u)), w = 1 -
(1-l)(1+u). The acceleration jumps there, except for w = 0, u = l/(1-l): then a_t = 0 and the pitch
circles are R and L - R. The step is 2 (b - psi_t) + u D.

No ratio below that one gives the step, since b - psi_t is greatest at a_t = 0. With one above it
the slot would still accelerate the wheel. In gear the roller then moves into the wall it pushed.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar, NamedTuple, cast

from geneva_cli.errors import GenevaError, refuse
from geneva_cli.motion import registry
from geneva_cli.motion.drive import PinPath, Plan
from geneva_cli.motion.engagement import Engagement, Path, Slot, SlotAxis, Vector, WheelMotion
from geneva_cli.motion.pivots import Dimension, Joint, Layout, Link, Teeth
from geneva_cli.motion.wheels import poses
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Array, larger, library, parameter, size
from geneva_cli.numerics.jet import Jet, Number, piecewise
from geneva_cli.numerics.roots import boundary
from geneva_cli.spec.rules import POSITIVE, Range, Words
from geneva_cli.spec.schema import Example

if TYPE_CHECKING:
    from geneva_cli.drives.transmission import Transmission
    from geneva_cli.motion.motion import Motion
    from geneva_cli.motion.wheels.gearing import Gearing


class GearSector(PinPath, kw_only=True):
    """Slot, gears at constant ratio, slot.

    ``sector_deg`` is the crank's angle in gear. ``gear_ratio`` is the wheel's speed over the
    crank's in gear, or "shockless" for the ratio without a jump in acceleration at the handover.

    >>> Design(External(3), GearSector(sector_deg=60)).timing.motion_deg
    180.0
    """

    NAME: ClassVar[str] = "gear-sector"
    WORDS: ClassVar[str] = "a crank with gear sectors"
    EXAMPLE: ClassVar[Example] = Example(
        "slot, gears at a constant ratio, slot",
        {"wheel": {"z": 3}, "drive": {"sector_deg": 60.0, "gear_ratio": "shockless"}},
    )
    ONE_ARM: ClassVar[bool] = True  # both rollers are on the crank
    round_gears: ClassVar[tuple[str, ...]] = ("crank gear", "wheel gear")
    sector_deg: Annotated[float, Range(0.0, 330.0, "(]"), "crank angle in gear, D"]
    gear_ratio: Annotated[
        float | str,
        Words(POSITIVE, ("shockless",)),
        'wheel speed / crank speed in gear; "shockless" for no jump, others are slightly above it',
    ] = "shockless"

    def distance_mm(self, wheel: Gearing, motion: Motion | None, radius_mm: float) -> float:
        """Centre distance L for a crank radius, mm: R = L sin b, with the slot's half angle b."""
        b = self._solved(math.pi / wheel.z).half_angle
        return radius_mm / library(b).sin(b)

    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        """The engagement of each roller; the slot's half angle follows from the step."""
        b, u, handover, _ = self._solved(math.pi / wheel.z)
        place = wheel.place(poses.HalfStep.of_deg(library(b).degrees(b)), L)
        crank = cast("Transmission", registry.drive("crank")())
        slot = crank.follows(wheel, place, L)
        engagement = SectorEngagement(slot, handover, self.sector_deg, u)
        return self.planned(engagement, library(b).sin(b), L)

    def layout(self, plan: Plan, sign: float) -> Layout:
        """Dimensions of slot, gears and handover, and angles between rollers and between slots."""
        L, (engagement, *_) = plan.center_distance_mm, plan.engagements
        b, u, handover, _ = self._solved(engagement.half_step)
        (_, first), (_, last) = engagement.passages
        return (
            Dimension("crank radius", L * plan.ratio, "mm"),
            Dimension("slot's half angle b", math.degrees(b), "deg"),
            Dimension("between the rollers", first - last, "deg"),
            Dimension("between a pair's slots", math.degrees(2.0 * engagement.apart), "deg"),
            Dimension("gears' ratio u", u),
            Dimension("sector's angle", self.sector_deg, "deg"),
            Dimension("handover, from the line of centres", math.degrees(handover), "deg"),
            Dimension("crank gear's pitch radius", L * u / (1.0 + u), "mm"),
            Dimension("wheel gear's pitch radius", L / (1.0 + u), "mm"),
        )

    def links(self, plan: Plan, sign: float, input_deg: Array) -> tuple[Link, ...]:
        """Both toothed sectors; the rollers are on the crank's arm."""
        L, still = plan.center_distance_mm, 0.0 * input_deg
        u = self._solved(plan.engagements[0].half_step).ratio
        shaft = Joint.SHAFT
        return (
            Link(
                "crank gear",
                ((still + L, still),),
                (shaft,),
                2,
                L * u / (1.0 + u),
                Teeth(1, self.sector_deg, 180.0),
            ),
            Link(
                "wheel gear",
                ((still, still),),
                (shaft,),
                2,
                L / (1.0 + u),
                Teeth(round(math.pi / plan.engagements[0].half_step), u * self.sector_deg),
            ),
        )

    def _solved(self, half_step: float) -> Handover:
        """The slot and its handover that give the step together with the gears."""
        D, u = radians(self.sector_deg), self.gear_ratio
        if isinstance(u, str):  # the step grows with b
            b = boundary(lambda b: _shockless(b).turned(D) >= half_step, half_step, 1e-9)
            return _shockless(b)
        # A slot with u > l/(1-l) never reaches the speed u. Among the others, the wheel turns less
        # the sooner the slot reaches it.
        ends = (math.pi / 2.0 - 1e-6, 0.0)
        least, most = (2.0 * (half_step - _handover(u, x).turned(0.0)) / u for x in reversed(ends))
        refuse(
            (least > D) | (most < D),
            lambda: self._no_step(half_step, math.degrees(least), math.degrees(most)),
        )
        return _handover(u, boundary(lambda x: _handover(u, x).turned(D) < half_step, *ends))

    def _no_step(self, half_step: float, least_deg: float, most_deg: float) -> GenevaError:
        """The error for a sector that gives no step, with the sectors that would give one."""
        step = f"a step of {math.degrees(2.0 * half_step):.6g} deg"
        if least_deg > 330.0:  # the key's own limit
            return GenevaError(
                f"gear_ratio = {self.gear_ratio:g}: {step} needs a sector_deg of {least_deg:.6g}, "
                "more than 330; set a greater gear_ratio",
                ("drive", "gear_ratio"),
            )
        least = f"at least {least_deg:.6g}" if least_deg > 0.0 else "above 0"
        return GenevaError(
            f"sector_deg = {self.sector_deg:g}: with gear_ratio = {self.gear_ratio:g} it does not "
            f"give {step}; it must be {least} and at most {min(most_deg, 330.0):.6g}",
            ("drive", "sector_deg"),
        )


class Handover(NamedTuple):
    """Half angle b of a slot, and the handover to gears of ratio u: a_t and psi_t, radians."""

    half_angle: float
    ratio: float
    crank: float
    wheel: float

    def turned(self, sector: float) -> float:
        """Half the step, for gears that drive over a crank angle ``sector`` in radians."""
        return self.half_angle - self.wheel + 0.5 * self.ratio * sector


def _shockless(b: float) -> Handover:
    """Handover at mid-motion: u = l/(1-l)."""
    m = library(b)
    short = 2.0 * m.sin(0.5 * (0.5 * math.pi - b)) ** 2  # 1 - l
    return Handover(b, m.sin(b) / short, 0.0, 0.0)


def _handover(u: float, x: float) -> Handover:
    """Handover of the slot with w = sin² x, so that b is smooth up to 90° and a_t down to 0."""
    m = library(u, x)
    s, c = m.sin(x), m.cos(x)
    l, short = (u + s * s) / (1.0 + u), c * c / (1.0 + u)
    sine = s * c / m.sqrt(2.0 * l * (1.0 + u) * (1.0 + 2.0 * u))
    a = 2.0 * m.asin(sine)
    b = m.atan2(l, m.sqrt(short * (1.0 + l)))
    return Handover(b, u, a, m.atan2(l * m.sin(a), short + 2.0 * l * sine * sine))


class _SectorMotion(WheelMotion):
    """The slot's motion at both ends, and the gears' motion between them."""

    def __init__(self, inner: WheelMotion, handover: float, sector_deg: float, u: float) -> None:
        self.inner, self.u = inner, u
        self.half_sector = 0.5 * sector_deg
        self.handover_deg = library(handover).degrees(handover)
        half = inner.exit_deg - self.handover_deg + self.half_sector
        turn = parameter(inner(self.handover_deg, 0).c[0])
        gears = u * radians(self.half_sector)
        super().__init__(-half, half, inner.half_step - turn + gears)

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        return (self.entry_deg, -self.half_sector, 0.0, self.half_sector, self.exit_deg)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        before, after = self.entry_deg - self.inner.entry_deg, self.exit_deg - self.inner.exit_deg
        places = {at + before for at in self.inner.seams_deg if at + before < -self.half_sector}
        places |= {at + after for at in self.inner.seams_deg if at + after > self.half_sector}
        return tuple(sorted(places | {*self.breaks_deg}))

    def slot_deg(self, input_deg: Number) -> Number:
        """Crank angle in the slot's own motion; while the gears drive, that of the handover."""
        out = larger(size(input_deg) - self.half_sector, 0.0) + self.handover_deg
        return library(out, input_deg).copysign(out, input_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        def before(x: Number) -> Jet:
            at = self.inner.entry_deg + (x - self.entry_deg)
            return self.inner(at, order) + (self.inner.half_step - self.half_step)

        def gears(x: Number) -> Jet:
            return Jet.variable(radians(x), order) * self.u

        def after(x: Number) -> Jet:
            at = self.inner.exit_deg + (x - self.exit_deg)
            return self.inner(at, order) + (self.half_step - self.inner.half_step)

        return piecewise(input_deg, (-self.half_sector, self.half_sector), (before, gears, after))


class _SectorPath(NamedTuple):
    """The roller's path in its slot; while the gears drive it stays at the handover."""

    inner: Path
    motion: _SectorMotion

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        return self.inner(self.motion.slot_deg(input_deg), order)


class _SectorSlot(Slot):
    """The slot, and the gears' pitch circle L/(1+u) while they drive, without sliding."""

    relieved = True

    def __init__(self, inner: Slot, motion: _SectorMotion) -> None:
        self.inner, self.motion = inner, motion

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        return self.inner(self.motion.slot_deg(input_deg), order)

    def axis(self, input_deg: Number, order: int = 0) -> SlotAxis:
        axis = self.inner.axis(self.motion.slot_deg(input_deg), order)
        assert axis is not None  # it is straight
        slot = self.touches(input_deg)
        lever = axis.lever * slot + (1.0 - slot) / (1.0 + self.motion.u)
        return SlotAxis(lever, axis.along * slot)

    def touches(self, input_deg: Number) -> Number:
        slot = size(input_deg) >= self.motion.half_sector
        return float(slot) if isinstance(slot, bool) else slot.astype(float)


class SectorEngagement(Engagement):
    """The engagement of slot, gears and slot: the passages of two rollers as one."""

    def __init__(self, inner: Engagement, handover: float, sector_deg: float, u: float) -> None:
        motion = _SectorMotion(inner.motion, handover, sector_deg, u)
        super().__init__(
            0.0, _SectorPath(inner.path, motion), _SectorSlot(inner.slot, motion), motion
        )
        self._inner, self._sector = inner, motion

    def carrier(self, input_deg: Number, order: int = 0) -> Jet:
        """Rate of the plain wheel's crank, on which the roller sits."""
        return self._inner.carrier(self._sector.slot_deg(input_deg), order)

    @property
    def passages(self) -> tuple[tuple[Engagement, float], ...]:
        """The plain wheel's, of the starting roller and of the stopping one: D - 2 a_t apart."""
        half = self._sector.half_sector - self._sector.handover_deg
        return (self._inner, half), (self._inner, -half)

    @property
    def overtaking(self) -> float:
        """Angle 2 (psi_t - u a_t): the slot would turn the wheel by 2 psi_t from -a_t to a_t."""
        a = self._sector.handover_deg
        turn = parameter(self._inner.motion(a, 0).c[0])
        return 2.0 * (turn - self._sector.u * radians(a))
