"""Gear sectors that replace the slot at a constant ratio, for steps that a slot cannot make.

The roller starts the wheel in a straight slot of half angle b. On the line of centres the wheel
turns at u = l/(1-l) times the crank's speed, l = sin b, without acceleration. There toothed sectors
take over, and drive it at that ratio for a crank angle D. Then the next roller stops the wheel in
its own slot. The step is 2 b + u D, and the pitch circles are R and L - R.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar, cast

from geneva_cli.motion import registry
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.engagement import Engagement, Slot, WheelMotion
from geneva_cli.motion.pivots import Dimension, Joint, Layout, Link, Teeth
from geneva_cli.motion.wheels import classic
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Array, Batchable, choose, larger, library, size
from geneva_cli.numerics.jet import Jet, Number, Path, Vector, piecewise
from geneva_cli.numerics.roots import boundary
from geneva_cli.spec.rules import Range

if TYPE_CHECKING:
    from geneva_cli.drives.transmission import Transmission
    from geneva_cli.motion.laws.law import Motion
    from geneva_cli.motion.wheels.gearing import Gearing


class GearSector(Drive, kw_only=True):
    """Slot, gears at constant ratio, slot; ``sector_deg`` is the crank's angle in gear.

    >>> Design(External(3), GearSector(sector_deg=60)).timing.motion_deg
    180.0
    """

    NAME: ClassVar[str] = "gear-sector"
    WORDS: ClassVar[str] = "a crank with gear sectors"
    ONE_ARM: ClassVar[bool] = True  # both rollers are on the crank
    round_gears: ClassVar[tuple[str, ...]] = ("crank gear", "wheel gear")
    sector_deg: Annotated[float, Range(0.0, 330.0, "(]"), "crank angle in gear, D"]

    def distance_mm(self, wheel: Gearing, motion: Motion | None, radius_mm: float) -> float:
        """Centre distance L for a crank radius, mm: R = L sin b, with the slot's half angle b."""
        b, _ = self._solved(math.pi / wheel.z)
        return radius_mm / library(b).sin(b)

    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        """The engagement of each roller; the slot's half angle follows from the step."""
        b, u = self._solved(math.pi / wheel.z)
        place = wheel.place(classic.HalfStep.of_deg(library(b).degrees(b)), L)
        crank = cast("Transmission", registry.drive("crank")())
        (inner,) = crank.straight(wheel, [place], L).engagements
        turned = _SectorMotion(inner.motion, self.sector_deg, u)
        path, slot = _SectorPath(inner.path, turned), _SectorSlot(inner.slot, turned)
        half = turned.half_sector
        pair = (inner, half), (inner, -half)  # of the starting roller and the stopping one: D apart
        own = Engagement(0.0, path, slot, turned, inner.body, pair=pair)
        return self.planned(own, library(b).sin(b), L)

    def layout(self, plan: Plan, sign: float) -> Layout:
        """Dimensions of slot and gears, and angles between rollers and between slots."""
        L, (engagement, *_) = plan.center_distance_mm, plan.engagements
        b, u = self._solved(engagement.half_step)
        (_, first), (_, last) = engagement.passages
        return (
            Dimension("crank radius", L * plan.ratio, "mm"),
            Dimension("slot's half angle b", math.degrees(b), "deg"),
            Dimension("between the rollers", first - last, "deg"),
            Dimension("between a pair's slots", math.degrees(2.0 * engagement.apart), "deg"),
            Dimension("gears' ratio u", u),
            Dimension("sector's angle", self.sector_deg, "deg"),
            Dimension("crank gear's pitch radius", L * u / (1.0 + u), "mm"),
            Dimension("wheel gear's pitch radius", L / (1.0 + u), "mm"),
        )

    def links(self, plan: Plan, sign: float, input_deg: Array) -> tuple[Link, ...]:
        """Both toothed sectors; the rollers are on the crank's arm."""
        L, half_step = plan.center_distance_mm, plan.engagements[0].half_step
        still = 0.0 * input_deg
        _, u = self._solved(half_step)
        teeth = Teeth(round(math.pi / half_step), u * self.sector_deg)
        own, shaft, radius = Teeth(1, self.sector_deg, 180.0), (Joint.SHAFT,), L / (1.0 + u)
        return (
            Link("crank gear", ((still + L, still),), shaft, 2, L * u / (1.0 + u), own),
            Link("wheel gear", ((still, still),), shaft, 2, radius, teeth),
        )

    def _solved(self, half_step: float) -> tuple[float, float]:
        """Half angle b of the slot and ratio u of the gears that give the step."""
        D = radians(self.sector_deg)

        def ratio(b: float) -> float:
            m = library(b)
            return m.sin(b) / (2.0 * m.sin(0.5 * (0.5 * math.pi - b)) ** 2)  # l/(1 - l)

        # the step grows with b
        b = boundary(lambda b: b + 0.5 * ratio(b) * D >= half_step, half_step, 1e-9)
        return b, ratio(b)


class _SectorMotion(WheelMotion):
    """The slot's motion at both ends, and the gears' motion between them."""

    def __init__(self, inner: WheelMotion, sector_deg: float, u: float) -> None:
        self.inner, self.u, self.half_sector = inner, u, 0.5 * sector_deg
        half = inner.exit_deg + self.half_sector
        super().__init__(-half, half, inner.half_step + u * radians(self.half_sector))

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        return (self.entry_deg, -self.half_sector, 0.0, self.half_sector, self.exit_deg)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        half = self.half_sector
        inner = {at + math.copysign(half, at) for at in self.inner.seams_deg if at}
        return tuple(sorted(inner | {*self.breaks_deg}))

    def slot_deg(self, input_deg: Number) -> Number:
        """Crank angle in the slot's own motion; 0 while the gears drive."""
        out = larger(size(input_deg) - self.half_sector, 0.0)
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


class _SectorPath(Batchable):
    """The roller's path in its slot; while the gears drive it stays on the line of centres."""

    def __init__(self, inner: Path, motion: _SectorMotion) -> None:
        self.inner, self.motion = inner, motion

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        return self.inner(self.motion.slot_deg(input_deg), order)


class _SectorSlot(_SectorPath, Slot):
    """The slot, and the gears' pitch circle L/(1+u) while they drive, without sliding."""

    inner: Slot
    walls_flat = False

    def axis(self, input_deg: Number, order: int = 0) -> Vector:
        lever, place = self.inner.axis(self.motion.slot_deg(input_deg), order)
        slot = self.touches(input_deg)
        return lever * slot + (1.0 - slot) / (1.0 + self.motion.u), place * slot

    def touches(self, input_deg: Number) -> Number:
        return choose(size(input_deg) >= self.motion.half_sector, 1.0, 0.0)
