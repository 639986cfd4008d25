"""Drives with a transmission between input shaft and crank: the roller runs on a circle.

And the places of rollers on the crank.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, ClassVar, TypeAlias, cast

from geneva_cli.errors import GenevaError, refuse_text
from geneva_cli.motion import registry
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.engagement import Anchor, Engagement
from geneva_cli.motion.path_and_slot import AnchoredPath, StraightSlotMotion
from geneva_cli.motion.wheels.classic import HalfStep, PinTravel, middle, refuse_jam, rollers_max
from geneva_cli.motion.wheels.gearing import Gearing, RollerPlace
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import larger, parameter
from geneva_cli.numerics.jet import Displacement, rotation

if TYPE_CHECKING:
    from geneva_cli.drives.pushed import PushedCrank
    from geneva_cli.motion.laws.law import Motion


ANGLES_KEY = ("drive", "roller_angles_deg")


# A transmission written about one crank angle, so that nothing cancels near it: the input angle
# there; and sin d and 1 - cos d of the crank's rotation d since then, by the input's rotation.
LocalTransmission: TypeAlias = "tuple[float, Displacement]"


class Transmission(Drive, kw_only=True):
    """A drive in front of the crank; a kind defines ``about``, and more only if it needs more."""

    ONE_ARM: ClassVar[bool] = True
    # True if its crank may be as built, of another R/L than its slots need
    ANY_RATIO: ClassVar[bool] = False
    # greatest crank angle from mid-motion at which the crank may move the wheel, degrees
    reach_deg: ClassVar[float] = 180.0
    side_crank: ClassVar[float | None] = None  # A of the side-crank whose ratio it has

    def about(self, crank_deg: float) -> LocalTransmission:
        """The transmission about a crank angle in degrees, which is 0 at mid-motion."""
        return crank_deg, rotation  # without one the crank turns as the input does

    @property
    def crank(self) -> Drive:
        plain, angles = registry.drive("crank"), self.roller_angles_deg
        return plain(n_rpm=self.n_rpm, rollers=self.rollers, roller_angles_deg=angles)

    def input_deg(self, crank_deg: float) -> float:
        whole = 360.0 / self.turns  # angle of the crank in which the transmission repeats
        turns = round(crank_deg / whole)
        return 360.0 * turns + float(self.about(crank_deg - whole * turns)[0])

    def distance_mm(self, wheel: Gearing, motion: Motion | None, radius_mm: float) -> float:
        if motion is None:
            return wheel.distance_mm(radius_mm)
        natural_deg = 2.0 * self.about(wheel.half_motion_deg(wheel.step))[0]
        return radius_mm / self._ratio(wheel, motion, natural_deg - motion.alpha0_deg)

    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        if motion is not None:
            return self._curved(wheel, motion, L)
        return self.straight(wheel, places(wheel, self, L), L)

    def as_built(self, wheel: Gearing, place: RollerPlace, L: float) -> Plan | None:
        return self.straight(wheel, places(wheel, self, L, place), L) if self.ANY_RATIO else None

    def straight(self, wheel: Gearing, rollers: list[RollerPlace], L: float) -> Plan:
        """Plan of straight slots for the places of the rollers on the crank."""
        if not self.direct:
            entry, _, exit_ = rollers[0].poses
            self._refuse_reach(wheel, larger(-entry.crank_deg, exit_.crank_deg))
        engagements, side_crank = [], self.side_crank
        for place in rollers:
            (middle_deg, turned), anchors = self.about(place.crank_deg), []
            for pose in place.poses:
                at_deg, advance = self.about(place.crank_deg + pose.crank_deg)
                travel = PinTravel(pose, advance)
                anchors.append(Anchor(at_deg - middle_deg, pose.wheel, pose.along, travel))
            path = AnchoredPath(tuple(anchors))
            if place.deepest is None:
                slot, motion = wheel.follow(path, place, turned)
            else:
                from geneva_cli.motion.wheels.offset_slot import OffsetSlot, OffsetSlotMotion

                slot, motion = OffsetSlot(path, place), OffsetSlotMotion(path, place)
            first = place.crank_deg == 0.0
            if place.closed and self.direct:
                motion = StraightSlotMotion(path, place.step.b, closed=place.closed)
            elif place.closed and first and side_crank is not None and not wheel.steps:
                from geneva_cli.motion.wheels.side_crank_arrays import SideCrankMotion

                motion = SideCrankMotion(path, place.step.b, side_crank, place.closed)
            body, hub, built = -wheel.SIGN * place.cone, place.hub, place.built
            own = Engagement(middle_deg, path, slot, motion, body, hub=hub, built=built)
            if not self.direct:
                self._behind(wheel, own, turned, L)
            engagements.append(own)
        turn = 360.0 * self.turns
        period = turn / self.rollers if len(rollers) == 1 else turn
        most = rollers_max(2.0 * rollers[0].half_motion_deg)
        return Plan(tuple(engagements), period, rollers[0].ratio, most, L)

    def reactions(
        self, wheel: Gearing, advance: Displacement, mid_deg: float, L: float
    ) -> PushedCrank | None:
        """Reactions on crank and transmission; None if a length is not known.

        ``advance`` is the crank's rotation since the roller was on the line of centres, at
        ``mid_deg`` of the input.
        """
        return None

    def _curved(self, wheel: Gearing, motion: Motion, L: float) -> Plan:
        """Plan of curved slots, solved for from a law and the crank's circle."""
        from geneva_cli.motion import given_motion as solved

        half = wheel.half_motion_deg(wheel.step)
        self._refuse_reach(wheel, half)
        motion_deg = solved.shortened(motion.alpha0_deg, 2.0 * self.about(half)[0])
        ratio = self._ratio(wheel, motion, motion_deg)
        text = 'ratio = "matched": at mid-motion the wheel turns back, or too fast for any R/L '
        text += "below 1; set a number, or change alpha0_deg or the law"
        refuse_text(ratio != ratio, ("motion", "ratio"), text)
        at_deg, advance = self.about(0.0)
        pose = middle(wheel.SIGN, ratio, 1.0 - wheel.SIGN * ratio)
        travel = PinTravel(pose, advance)
        path = Anchor(0.0 * at_deg, pose.wheel, pose.along, travel)
        turned = solved.LawMotion(-0.5 * motion_deg, 0.5 * motion_deg, wheel.step.b, motion.law)
        slot = solved.SolvedSlot(path, turned)
        engagement = Engagement(0.0, path, slot, turned, -wheel.SIGN)
        if not self.direct:
            self._behind(wheel, engagement, advance, L)
        return self.planned(engagement, ratio, L)

    def _ratio(self, wheel: Gearing, motion: Motion, motion_deg: float) -> float:
        """R/L of a curved slot: the spec's, sin b, or matched to the law at mid-motion, or NaN."""
        if isinstance(motion.ratio, str):
            crank = self.about(0.0)[1](0.0, 1)[0].c[1]
            turned = motion.law(0.5, 1).c[1] * 2.0 * wheel.step.b / radians(motion_deg)
            return wheel.matched_ratio(parameter(turned / crank))
        return wheel.step.sin_cos[0] if motion.ratio is None else motion.ratio

    def _behind(self, wheel: Gearing, own: Engagement, advance: Displacement, L: float) -> None:
        """Complete an engagement whose crank is behind the transmission: its rate and reactions."""
        from geneva_cli.drives.pushed import CrankRate

        own.body = CrankRate(advance, cast(float, own.body))
        own.reactions = self.reactions(wheel, advance, own.mid_deg, L) if wheel.FLAT else None

    def _refuse_reach(self, wheel: Gearing, farthest_deg: float) -> None:
        """Raise GenevaError if the transmission does not cover the whole motion."""
        text = "z = {z}: the crank must turn {far:.6g} deg to either side, but kind = "
        text += '"{name}" turns it only {most:.6g}: reduce z or first_z'
        values = {"z": wheel.z, "far": farthest_deg, "name": self.NAME, "most": self.reach_deg}
        refuse_text(farthest_deg > self.reach_deg * (1.0 + 1e-12), ("wheel", "z"), text, **values)


def places(
    wheel: Gearing, drive: Drive, L: float, passing: RollerPlace | None = None
) -> list[RollerPlace]:
    """Rollers of a machine with straight slots, in the order in which they move the wheel.

    With unequal steps they are on different arms, else all pass the slots as ``passing`` does.
    Rollers that move the wheel alike are returned as one. Raises GenevaError if rollers would jam.
    """
    angles, m = drive.roller_angles_deg, drive.rollers
    if passing is None and wheel.steps:  # R_i = L sin b_i
        rollers = [wheel.place(HalfStep.of_deg(0.5 * step), L) for step in wheel.steps]
        _refuse_no_dwell(rollers, ("wheel", "steps_deg"))
        if angles:
            return _at_angles(angles, rollers)
        # placed so that the dwells between their motions are equal
        total = math.fsum(2.0 * one.half_motion_deg for one in rollers)
        dwell, at, out = (360.0 - total) / len(rollers), 0.0, rollers[:1]
        for before, one in pairwise(rollers):
            at += before.half_motion_deg + dwell + one.half_motion_deg
            out.append(one._replace(crank_deg=at))
        return out
    one = wheel.place(wheel.step, L) if passing is None else passing
    if angles:
        return _at_angles(angles, [one] * len(angles))
    refuse_jam(m, 2.0 * one.half_motion_deg)
    out = [one]  # behind a transmission the crank's angle decides how each moves the wheel
    for j in range(1, 1 if drive.direct else m):
        out.append(one._replace(crank_deg=360.0 * j / m))
    return out


def _at_angles(angles: tuple[float, ...], rollers: list[RollerPlace]) -> list[RollerPlace]:
    """Rollers at the angles of the spec, each gap wide enough for half of both adjacent motions."""
    if list(angles) != sorted(set(angles)) or angles[0] != 0.0 or angles[-1] >= 360.0:
        raise GenevaError("roller_angles_deg must rise from 0 to below 360", ANGLES_KEY)
    text = "the rollers at {a:g} and {b:g} deg jam: half of both motions takes {motions:.6g} deg, "
    text += "and they are {apart:.6g} deg apart"
    following = (*angles[1:], 360.0), (*rollers[1:], rollers[0])
    for a, one, b, after in zip(angles, rollers, *following, strict=True):
        motions = one.half_motion_deg + after.half_motion_deg
        values = {"a": a, "b": b % 360.0, "motions": motions, "apart": b - a}
        refuse_text(b - a < motions, ANGLES_KEY, text, **values)
    _refuse_no_dwell(rollers, ANGLES_KEY)
    return [one._replace(crank_deg=a) for a, one in zip(angles, rollers, strict=True)]


def _refuse_no_dwell(rollers: list[RollerPlace], key: tuple[str, str]) -> None:
    """Raise GenevaError if the motions of all rollers take a whole turn."""
    total = sum(2.0 * one.half_motion_deg for one in rollers)
    text = "the {count} motions together take {total:.6g} deg of a turn and leave no dwell: use "
    text += "fewer rollers, or a shorter pattern of steps"
    refuse_text(total >= 360.0, key, text, count=len(rollers), total=total)
