"""Drives with a transmission between input shaft and crank: the roller runs on a circle."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from geneva_cli.errors import refuse_text
from geneva_cli.motion import registry
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.engagement import (
    Anchor,
    ConstantRate,
    Displacement,
    Engagement,
    Path,
    Vector,
)
from geneva_cli.motion.path_and_slot import AnchoredPath, ClassicMotion, SideCrankMotion
from geneva_cli.motion.rollers import places
from geneva_cli.motion.wheels.classic import refuse_jam, rollers_max
from geneva_cli.motion.wheels.gearing import Gearing, RollerPlace
from geneva_cli.motion.wheels.poses import PinPose, PinTravel, middle
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Array, parameter
from geneva_cli.numerics.jet import Jet, Number, sine_versine, turning

if TYPE_CHECKING:
    from geneva_cli.drives.pushed import PushedCrank
    from geneva_cli.motion.laws.law import Law
    from geneva_cli.motion.motion import Motion


class LocalTransmission(NamedTuple):
    """A transmission written about one crank angle, so that nothing cancels near it."""

    input_deg: float  # input angle there
    # sin d and 1 - cos d of the crank's rotation d since then, by the input's rotation since then
    advance: Displacement

    def anchor(self, pose: PinPose, middle_deg: float) -> Anchor:
        """A pose at this crank angle as an anchor; mid-motion is at the input ``middle_deg``."""
        travel = PinTravel(pose, self.advance)
        return Anchor(self.input_deg - middle_deg, pose.wheel, pose.along, travel)


def same(tau: Number, order: int) -> Vector:
    """sin d and 1 - cos d of a crank that turns as the input does."""
    return sine_versine(Jet.variable(tau, order))


class _CrankRate(NamedTuple):
    """Rate of the crank about its roller's axis: a factor times that of its rotation."""

    advance: Displacement
    factor: float

    def __call__(self, tau: Number, order: int) -> Jet:
        sine, versine = self.advance(tau, order + 1)
        rate: Jet = turning(1.0 - versine, sine) * self.factor
        return rate


class Transmission(Drive, kw_only=True):
    """A drive in front of the crank; a kind defines ``about``, and more only if it needs more."""

    turned_at_crank: ClassVar[bool] = False

    @abstractmethod
    def about(self, crank_deg: float) -> LocalTransmission:
        """The transmission about a crank angle in degrees, which is 0 at mid-motion."""

    @property
    def crank(self) -> Drive:
        plain, angles = registry.drive("crank"), self.roller_angles_deg
        return plain(n_rpm=self.n_rpm, rollers=self.rollers, roller_angles_deg=angles)

    @property
    def motions(self) -> int:
        return self.rollers

    @property
    def reach_deg(self) -> float:
        """Greatest crank angle from mid-motion at which the crank may move the wheel, degrees."""
        return 180.0

    @property
    def side_crank(self) -> float | None:
        """A of the side-crank whose ratio it has; None for another ratio."""
        return None

    def crank_rate(self, crank_deg: Array) -> Array | float:
        return self.about(parameter(crank_deg)).advance(0.0, 1)[0].c[1]

    def input_deg(self, crank_deg: float) -> float:
        whole = 2.0 * self.reach_deg
        turns = round(crank_deg / whole)
        return 360.0 * turns + float(self.about(crank_deg - whole * turns).input_deg)

    def distance_mm(self, wheel: Gearing, motion: Motion | None, radius_mm: float) -> float:
        if motion is None:
            return wheel.distance_mm(radius_mm)
        motion_deg = 2.0 * self.about(wheel.half_motion_deg(wheel.step)).input_deg
        return radius_mm / self._ratio(wheel, motion, motion_deg - motion.alpha0_deg)

    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        if motion is not None:
            return self._curved(wheel, motion, L)
        return self.straight(wheel, places(wheel, self, L), L)

    def straight(self, wheel: Gearing, rollers: list[RollerPlace], L: float) -> Plan:
        """Plan of straight slots for the places of the rollers on the crank."""
        self._refuse_reach(wheel, rollers[0].reach_deg)
        engagements = tuple(self.follows(wheel, place, L) for place in rollers)
        turn = 360.0 * self.turns
        period = turn / self.rollers if len(rollers) == 1 else turn
        most = rollers_max(2.0 * rollers[0].half_motion_deg)
        return Plan(engagements, period, rollers[0].ratio, most, L)

    def reactions(self, wheel: Gearing, path: Path, mid_deg: float, L: float) -> PushedCrank | None:
        """Reactions on crank and transmission; None if a length is not known.

        ``mid_deg`` is the input angle at which the roller crosses the line of centres.
        """
        return None

    def follows(self, wheel: Gearing, place: RollerPlace, L: float) -> Engagement:
        """The engagement of a straight slot with one of the rollers."""
        here = self.about(place.crank_deg)
        anchors = tuple(
            self.about(place.crank_deg + pose.crank_deg).anchor(pose, here.input_deg)
            for pose in place.poses
        )
        path = AnchoredPath(anchors)
        slot, motion = wheel.follow(path, place, here.advance)
        first = isinstance(place.crank_deg, float) and place.crank_deg == 0.0 and not wheel.steps
        if place.closed and self.direct:
            motion = ClassicMotion(path, place.step.b, *place.closed)
        elif place.closed and self.side_crank is not None and first:
            motion = SideCrankMotion(path, place.step.b, self.side_crank, *place.closed)
        rate = -wheel.SIGN * place.cone
        body = ConstantRate(rate) if self.direct else _CrankRate(here.advance, rate)
        reactions = self.reactions(wheel, path, here.input_deg, L) if wheel.FLAT else None
        return Engagement(
            here.input_deg, path, slot, motion, body, reactions, hub=place.hub, built=place.built
        )

    def _curved(self, wheel: Gearing, motion: Motion, L: float) -> Plan:
        """Plan of curved slots, solved for from a law and the crank's circle."""
        from geneva_cli.motion import path_and_motion as solved

        half = wheel.half_motion_deg(wheel.step)
        self._refuse_reach(wheel, half)
        natural = 2.0 * self.about(half).input_deg
        motion_deg = natural - motion.alpha0_deg
        solved.refuse_alpha0(motion.alpha0_deg, natural)
        refuse_jam(self.rollers, motion_deg, wheel.SIGN < 0.0)
        ratio = self._ratio(wheel, motion, motion_deg)
        text = 'ratio = "matched": at mid-motion the wheel turns back, or too fast for any R/L '
        text += "below 1; set a number, or change alpha0_deg or the law"
        refuse_text(ratio != ratio, ("motion", "ratio"), text)
        here = self.about(0.0)
        pose = middle(wheel.SIGN, ratio, wheel.rest(ratio))
        path = solved.MiddlePath(here.anchor(pose, here.input_deg))
        end_deg, b = 0.5 * motion_deg, wheel.step.b
        turned = solved.LawMotion(-end_deg, end_deg, b, motion.law)
        reactions = self.reactions(wheel, path, 0.0, L) if wheel.FLAT else None
        body = ConstantRate(-wheel.SIGN) if self.direct else _CrankRate(here.advance, -wheel.SIGN)
        engagement = Engagement(0.0, path, solved.SolvedSlot(path, turned), turned, body, reactions)
        period = 360.0 * self.turns / self.rollers
        return Plan((engagement,), period, ratio, rollers_max(motion_deg), L)

    def _ratio(self, wheel: Gearing, motion: Motion, motion_deg: float) -> float:
        """R/L of a curved slot: the spec's, sin b, or matched to the law at mid-motion, or NaN."""
        if isinstance(motion.ratio, str):
            return self.matched_ratio(wheel, motion.law, motion_deg)
        return wheel.step.sin_cos[0] if motion.ratio is None else motion.ratio

    def matched_ratio(self, wheel: Gearing, law: Law, motion_deg: float) -> float:
        crank = self.about(0.0).advance(0.0, 1)[0].c[1]
        turned = law(0.5, 1).c[1] * 2.0 * wheel.step.b / radians(motion_deg)
        return wheel.matched_ratio(parameter(turned / crank))

    def _refuse_reach(self, wheel: Gearing, farthest_deg: float) -> None:
        """Raise GenevaError if the transmission does not cover the whole motion."""
        text = "z = {z}: the crank must turn {far:.6g} deg to either side, but kind = "
        text += '"{name}" turns it only {most:.6g}: reduce z or first_z'
        values = {"z": wheel.z, "far": farthest_deg, "name": self.NAME, "most": self.reach_deg}
        refuse_text(farthest_deg > self.reach_deg * (1.0 + 1e-12), ("wheel", "z"), text, **values)


class Direct(Transmission, kw_only=True):
    """A drive without a transmission: crank angle and input angle are equal."""

    direct: ClassVar[bool] = True
    turned_at_crank: ClassVar[bool] = True

    @property
    def motions(self) -> int:
        return 1

    def about(self, crank_deg: float) -> LocalTransmission:
        return LocalTransmission(crank_deg, same)
