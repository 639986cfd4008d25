"""A design as a machine: its stations over a full cycle, built from a spec."""

from __future__ import annotations

import math
from functools import partial
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine import drives, kinds
from geneva_cli.machine.engagement import (
    Anchor,
    LawDriven,
    LawMotion,
    SlotDriven,
    SphereDriven,
    Station,
)
from geneva_cli.machine.laws.chosen import law_of
from geneva_cli.machine.laws.standard import Law
from geneva_cli.machine.rollers import Place, places, refuse_layout
from geneva_cli.machine.size_rules import refuse_sizes
from geneva_cli.machine.wheels import classic
from geneva_cli.machine.wheels import poses as gearing
from geneva_cli.machine.wheels.classic import SIGN, half_motion_deg, refuse_jam, rollers_max
from geneva_cli.machine.wheels.offset_slot import OffsetDriven, skew
from geneva_cli.machine.wheels.side_crank_peaks import acceleration_peak
from geneva_cli.numerics.jet import Coefficient, Jet, atan2
from geneva_cli.spec.tables import Spec

ROUNDING_DEG = 1e-9
MOTION_MIN = 1e-10  # degrees: a shorter motion, or dwell, is rounding


class Mechanism(NamedTuple):
    """A Geneva mechanism.

    ``stations`` holds one station for each kind of motion in a period; rollers that all move
    alike share one, and the period is then one index.
    """

    spec: Spec
    stations: tuple[Station, ...]
    period_deg: float  # input angle after which the stations come round again
    ratio: float  # l = R/L
    rollers_max: int  # most evenly spaced rollers that do not jam
    given: Spec | None = None  # the spec before a linkage gave it its centre distance

    @property
    def asked(self) -> Spec:
        """The spec as it was given, from which ``build`` makes this machine again."""
        return self.given or self.spec

    @property
    def law(self) -> Law | None:
        """The motion law, where the motion is given."""
        station = self.stations[0]
        return station.law if isinstance(station, LawMotion) else None

    def shown_deg(self, input_deg: float) -> float:
        """An input angle as it is shown: between -180 and 180 from the machine's mid-motion.

        Over a period of several turns it is counted from the first engagement's entry.
        """
        whole = 360.0 * kinds.turns(self.spec)
        if whole == 360.0:
            return math.remainder(input_deg, whole)
        entry = self.stations[0].mid_deg + self.stations[0].entry_deg
        # What rounding put before the entry is at it.
        periods = math.floor((input_deg - entry + ROUNDING_DEG) / whole)
        return max(input_deg - periods * whole, entry)

    def index_deg(self, i: int) -> float:
        """The wheel's step at a station."""
        steps = self.spec.wheel.steps_deg
        return steps[i] if steps else 360.0 / self.spec.wheel.z

    def dwell_deg(self, i: int) -> float:
        """Input angle from station i's exit to the next entry."""
        here = self.stations[i]
        after = self.stations[(i + 1) % len(self.stations)]
        turns = self.period_deg if i + 1 == len(self.stations) else 0.0
        dwell = turns + (after.mid_deg + after.entry_deg) - (here.mid_deg + here.exit_deg)
        # Rollers may follow each other without a pause; what is left then is rounding.
        return dwell if abs(dwell) > 1e-9 else 0.0


def build(spec: Spec) -> Mechanism:
    """The mechanism of a spec.

    Raises GenevaError, naming the key, where the values do not make a machine together.
    """
    refuse_layout(spec)
    mechanism = _built(spec)
    refuse_sizes(mechanism.spec, mechanism.ratio)
    return mechanism


def _built(spec: Spec) -> Mechanism:
    if kinds.own_path(spec.drive.kind):
        plan: drives.Plan = kinds.module(spec.drive.kind).plan(spec)
        motion = plan.station.motion_deg
        refuse_jam(spec.drive.rollers, motion, spec.wheel.gearing)
        period = 360.0 / spec.drive.rollers
        solved = spec._replace(size=plan.size)
        return Mechanism(
            solved, (plan.station,), period, plan.ratio, rollers_max(motion), given=spec
        )
    return _straight(spec) if spec.motion.law is None else _curved(spec)


def _front(spec: Spec) -> drives.Turn:
    turn: drives.Turn = kinds.module(spec.drive.kind).front(spec)
    return turn


def _straight(spec: Spec) -> Mechanism:
    """Straight slots, a roller on the crank's circle: the slots give the motion."""
    _refuse_motion_keys(spec)
    front, found = _front(spec), places(spec)
    kinds.refuse_reach(spec, found[0].reach_deg)
    stations = tuple(_slot_driven(spec, front, place) for place in found)
    alike = len(found) == 1
    turn = 360.0 * kinds.turns(spec)
    period = turn / spec.drive.rollers if alike else turn
    natural = 2.0 * found[0].half_motion_deg
    return Mechanism(spec, stations, period, found[0].ratio, rollers_max(natural))


def _slot_driven(spec: Spec, front: drives.Turn, place: Place) -> SlotDriven:
    gear, step = spec.wheel.gearing, place.step
    mid = front(place.crank_deg).input_deg
    if gear == "spherical":
        ball = gearing.sphere(step, spec.wheel.axes_deg)
        poses = gearing.spherical(step, ball)
        anchors = tuple(_anchor(pose, front, place.crank_deg) for pose in poses)
        here = front(place.crank_deg)
        top = ball.cos_S * ball.cos_th + ball.sin_S * ball.sin_th  # cos(S - th)

        def height(tau: Coefficient, order: int) -> Jet:
            return top - here.advance(tau, order)[1] * (ball.sin_S * ball.sin_th)

        def cone(tau: Coefficient, order: int) -> Jet:
            sine, versine = here.advance(tau, order + 1)
            return atan2(sine, 1.0 - versine).derivative() * -ball.cos_th

        ball_driven = SphereDriven(mid, step.b, anchors, height)
        ball_driven.body = cone
        return ball_driven
    if place.offset:
        slot = skew(step, place.offset)
        anchors = tuple(_anchor(pose, front, place.crank_deg) for pose in slot.poses)
        return OffsetDriven(mid, step.b, anchors, slot)
    poses = gearing.radial(gear, step)
    anchors = tuple(_anchor(pose, front, place.crank_deg) for pose in poses)
    plain = spec.drive.kind == "crank"
    kernel = (SIGN[gear], step.sin_cos[0], classic.gap("external", *step)) if plain else None
    station = SlotDriven(mid, step.b, anchors, kernel)
    A = getattr(spec.kind, "A", None)
    if A is not None and step == (1, spec.wheel.z) and place.crank_deg == 0.0:
        station.known_peak = partial(acceleration_peak, spec.wheel.z, gear, A)
    return station


def _anchor(pose: gearing.Pose, front: drives.Turn, crank_deg: float) -> Anchor:
    """The pose of a roller that stands ``crank_deg`` behind the first, as the input sees it."""
    here = front(crank_deg + pose.crank_deg)
    from_mid = here.input_deg - front(crank_deg).input_deg

    def displacement(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
        return pose.displacement(*here.advance(tau, order))

    return Anchor(from_mid, pose.wheel, pose.along, displacement)


def _curved(spec: Spec) -> Mechanism:
    """A law and a roller on the crank's circle: the slots are solved for."""
    wheel, drive = spec.wheel, spec.drive
    step = gearing.Step(1, wheel.z)
    front, law = _front(spec), law_of(spec)
    kinds.refuse_reach(spec, half_motion_deg(wheel.gearing, *step))
    natural = 2.0 * front(half_motion_deg(wheel.gearing, *step)).input_deg
    motion = natural - spec.motion.alpha0_deg
    _refuse_alpha0(spec, natural)
    refuse_jam(drive.rollers, motion, wheel.gearing)
    ratio = _ratio(spec, law, motion, step, front)
    pose = gearing.middle(wheel.gearing, ratio, 1.0 - SIGN[wheel.gearing] * ratio)
    station = LawDriven(0.0, motion, step.b, law, _anchor(pose, front, 0.0))
    period = 360.0 * kinds.turns(spec) / drive.rollers
    return Mechanism(spec, (station,), period, ratio, rollers_max(motion))


def _ratio(
    spec: Spec, law: Law, motion_deg: float, step: gearing.Step, front: drives.Turn
) -> float:
    """R/L of a curved slot: given, sin b, or matched to the law's velocity at mid-motion."""
    given = spec.motion.ratio
    if given is None:
        return step.sin_cos[0]
    if given != "matched":
        return float(given)
    matched = matched_ratio(spec, law, motion_deg, step.b, front)
    if matched is None:
        raise GenevaError(
            "no R/L between 0 and 1 matches this motion: at mid-motion the wheel would have to "
            "turn too fast (inside, more than half as fast as the crank) or back; give ratio as a "
            "number, or change alpha0_deg or the law",
            ("motion", "ratio"),
        )
    return matched


def matched_ratio(
    spec: Spec, law: Law, motion_deg: float, half_step: float, front: drives.Turn
) -> float | None:
    """R/L at which the pin crosses the line of centres as fast as the wheel's slot does.

    psi1(0) = l/(1-l) f1(0) outside, l/(1+l) f1(0) inside, with f1 the front drive's ratio; at
    any other R/L the pressure angle at mid-motion is 90 degrees. None where no R/L below 1 does.
    """
    rate: float = front(0.0).advance(0.0, 1)[0].c[1]
    wheel: float = law(0.5, 1).c[1] * 2.0 * half_step / math.radians(motion_deg)
    v = wheel / rate
    if spec.wheel.gearing == "internal":
        return v / (1.0 - v) if 0.0 < v < 0.5 else None
    return v / (1.0 + v) if v > 0.0 else None


def matched_ratio_of(mechanism: Mechanism) -> float | None:
    """The matched R/L of a curved slot, whatever its own."""
    station = mechanism.stations[0]
    assert isinstance(station, LawDriven)
    front = _front(mechanism.spec)
    return matched_ratio(mechanism.spec, station.law, station.motion_deg, station.half_step, front)


def _refuse_alpha0(spec: Spec, natural_deg: float) -> None:
    low, high = natural_deg - 360.0, natural_deg
    alpha0 = spec.motion.alpha0_deg
    if not low + MOTION_MIN < alpha0 < high - MOTION_MIN:
        raise GenevaError(
            f"alpha0_deg = {alpha0:.12g} leaves no motion angle between 0 and 360 degrees; "
            f"it must be above {low:.12g} and below {high:.12g}",
            ("motion", "alpha0_deg"),
        )


def _refuse_motion_keys(spec: Spec) -> None:
    """Without a law the straight slots give the motion, and nothing of it is free."""
    default = type(spec.motion)()
    for name, value in spec.motion._asdict().items():
        if value != getattr(default, name):
            key = name.rstrip("_")
            raise GenevaError(
                f'{key} needs a law (law = "cycloidal", say): straight slots leave it no freedom',
                ("motion", key),
            )
