"""A machine whose input shaft another drive turns, by theta = g(phi): gears or a side-crank.

Path, slot and motion are p(g(phi)), M(g(phi)) and psi(g(phi)), derived by the chain rule: a law
holds by theta. A load on the roller gives the shaft between both drives the power F . p' + C w per
radian of input. The push of the drive before follows from that and its own lever.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple, cast

from geneva_cli.motion import engagement as base
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.path_and_slot import NEAR_END
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import Array, Batchable, array, choose, library, narrowed
from geneva_cli.numerics.jet import Jet, Number, Vector, atan2, composed, cross, piecewise
from geneva_cli.numerics.roots import boundary

if TYPE_CHECKING:
    from geneva_cli.drives.pushed import PushedCrank
    from geneva_cli.drives.transmission import Transmission
    from geneva_cli.motion.machine_spec import Spec
    from geneva_cli.numerics.jet import Displacement, Held, Loads, Path, Reactions


def retimed(plan: Plan, spec: Spec, in_front: Drive) -> Plan:
    """The plan of a spec's drive behind the drive in front of it."""
    before = cast("Transmission", in_front)  # ``compatible`` requires one
    turn, sign = 360.0 * spec.drive.turns, spec.wheel.SIGN
    periods = round(array(turn / plan.period_deg).flat[0])  # in a turn: as many in all of a batch
    each = []
    for k in range(periods):
        for own in plan.engagements:
            timing, push = Timing(before, own, k * plan.period_deg), None
            if spec.drive.direct or not spec.drive.crank:  # it turns about the crank's axis
                turned, mid_deg = timing.advances[1], timing.within_deg
                push = before.reactions(spec.wheel, turned, mid_deg, plan.center_distance_mm)
            # a crank that carries its rollers is pushed itself, without a shaft between
            held = DrivenShaft(own, timing, push, sign) if own.reactions else push
            each.append(Engagement(own, timing, held))
    return plan._replace(engagements=tuple(each), period_deg=turn * before.turns)


def _of_rate(rate: Jet, turned: Jet) -> Jet:
    """A rate per radian of the driven shaft, as one per radian of the input."""
    return composed(rate, turned.lower) * turned.derivative()


class _Displacement(NamedTuple):
    """A displacement by the input's rotation, through the driven shaft's."""

    displacement: Displacement
    advance: Displacement

    def __call__(self, tau: Number, order: int) -> Vector:
        turned = angle_of(self.advance, tau, order)
        along, across = self.displacement(turned.c[0], order)
        return composed(along, turned), composed(across, turned)


class _Path(Batchable):
    """A pin's path by the machine's input angle; or a slot's pitch curve."""

    def __init__(self, own: Path, timing: Timing) -> None:
        self.own, self.timing = own, timing

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        return self.through(self.own, input_deg, order)

    def through(self, own: Path, input_deg: Number, order: int) -> Vector:
        """Two functions of the driven shaft's angle, by the machine's input angle."""
        at, turned = self.timing.at(input_deg, order)
        x, y = own(at, order)
        return composed(x, turned), composed(y, turned)


class _Motion(base.WheelMotion):
    """The wheel's angle by the machine's input angle."""

    breaks_to = 2e-14  # roundings of angles of the own shaft, which may be slower

    def __init__(self, own: base.WheelMotion, timing: Timing) -> None:
        super().__init__(timing.at_deg[0], timing.at_deg[-1], own.half_step)
        self.own, self.timing, self.mirrored = own, timing, own.symmetric
        if own.entry is not None:
            displacement = _Displacement(own.entry.displacement, timing.advances[0])
            self.entry = own.entry._replace(input_deg=self.entry_deg, displacement=displacement)

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        inner = (self.timing.input_deg(at) for at in self.own.breaks_deg[1:-1])
        return (self.entry_deg, *inner, self.exit_deg)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        own = [self.timing.input_deg(at) for at in self.own.seams_deg[1:-1]]
        places = {*own, *self.timing.cuts}
        inside = sorted(at for at in places if self.entry_deg < at < self.exit_deg)
        return (self.entry_deg, *inside, self.exit_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        at, turned = self.timing.at(input_deg, order)
        return composed(self.own(at, order), turned)


class _Slot(_Path, base.Slot):
    """A slot whose pin runs along it by the machine's input angle."""

    own: base.Slot

    def __init__(self, own: base.Slot, timing: Timing) -> None:
        super().__init__(own, timing)
        self.curved, self.walls_flat, self.offset = own.curved, own.walls_flat, own.offset
        self.seams_deg = tuple(map(timing.input_deg, own.seams_deg))
        if own.height is not None:
            turn = _Displacement(own.height.turn, timing.advances[1])
            self.height = own.height._replace(turn=turn)

    def axis(self, input_deg: Number, order: int = 0) -> Vector:
        return self.through(self.own.axis, input_deg, order)

    def upright(self, input_deg: Number, order: int = 0) -> Jet | float:
        at, turned = self.timing.at(input_deg, order)
        upright = self.own.upright(at, order)
        return composed(upright, turned) if isinstance(upright, Jet) else upright

    def play(self, clearance: Number) -> Number:
        return self.own.play(clearance)

    def touches(self, input_deg: Number) -> Number:
        return self.own.touches(self.timing.at(input_deg, 0)[0])


class Engagement(base.Engagement):
    """An engagement of a drive's own, behind another drive."""

    def __init__(
        self, own: base.Engagement, timing: Timing, reactions: Reactions | None = None
    ) -> None:
        pair: list[tuple[base.Engagement, float]] = []
        for passage, ahead_deg in own.pair:  # in its own phase of the drive before
            late_deg = timing.shaft_deg - ahead_deg - passage.mid_deg
            early = Timing(timing.before, passage, late_deg)
            # as far ahead in angles of the input
            pair.append((Engagement(passage, early), timing.mid_deg - early.mid_deg))
        path, slot = _Path(own.path, timing), _Slot(own.slot, timing)
        held = None, reactions, own.crank_sense, own.groove, own.hub, own.built, tuple(pair)
        super().__init__(timing.mid_deg, path, slot, _Motion(own.motion, timing), *held)
        self._own, self.timing = own, timing

    def carrier(self, input_deg: Number, order: int = 0) -> Jet:
        at, turned = self.timing.at(input_deg, order + 1)
        return _of_rate(self._own.carrier(at, order), turned)

    def shaft(self, input_deg: Number, order: int = 0) -> Jet:
        return self.timing.at(input_deg, order)[1]

    def own_deg(self, input_deg: Array) -> Array:
        return array(self.timing.at(input_deg, 0)[0])

    def inputs_deg(self, own_deg: Array) -> Array:
        first, last = (array(self.timing.at_deg[k]) + 0.0 * own_deg for k in (0, -1))
        return boundary(lambda x: array(self.timing.at(x, 0)[0]) <= own_deg, first, last)

    @property
    def own(self) -> base.Engagement:
        return self._own


def angle_of(advance: Displacement, tau: Number, order: int) -> Jet:
    """Angle by which the driven shaft advances in ``tau`` input radians, radians."""
    sine, versine = advance(tau, order)
    return atan2(sine, 1.0 - versine)


class Timing(Batchable):
    """Angle of a drive's own input shaft over one engagement, by the machine's input angle.

    ``late_deg`` is the own angle by which the engagement follows the one that it repeats. The angle
    is written about entry, mid-motion and exit, so that it is exact at each of them.
    """

    def __init__(self, before: Transmission, own: base.Engagement, late_deg: float) -> None:
        mid = own.mid_deg + late_deg
        turns = library(mid).floor(mid / 360.0 + 0.5)
        self.before, self.shaft_deg = before, mid
        self.rest_deg = mid - 360.0 * turns  # ``about`` covers one turn of the shaft
        self.ends_deg = (own.entry_deg, 0.0, own.exit_deg)  # of the own shaft
        local = [before.about(self.rest_deg + end) for end in self.ends_deg]
        self.within_deg = local[1][0]  # input angle of mid-motion in that turn
        self.mid_deg = 360.0 * before.turns * turns + self.within_deg
        self.at_deg = tuple(at_deg - self.within_deg for at_deg, _ in local)
        self.advances = tuple(advance for _, advance in local)
        # input angles at which the formula about another place takes over
        self.cuts = [NEAR_END * self.at_deg[0], NEAR_END * self.at_deg[-1]]

    def input_deg(self, own_deg: float) -> float:
        """Machine's input angle at an angle of the driven shaft, both from mid-motion, degrees."""
        return self.before.about(self.rest_deg + own_deg)[0] - self.within_deg

    def at(self, input_deg: Number, order: int) -> tuple[Number, Jet]:
        """Angle of the driven shaft in degrees, and in radians with its derivatives."""
        pieces = [partial(self._about, i, order) for i in range(3)]
        own = piecewise(input_deg, self.cuts, pieces)
        return own.c[0], Jet((radians(own.c[0]), *own.c[1:]))

    def _about(self, i: int, order: int, input_deg: Number) -> Jet:
        """Angle of the driven shaft in degrees, with its derivatives in radians."""

        def turned(x: Number, order: int) -> Jet:
            return angle_of(self.advances[i], radians(x - self.at_deg[i]), order)

        own = turned(input_deg, order)
        # the shaft never turns back, so the ends of an enclosure of angles decide
        angle = narrowed(own.c[0], lambda x: turned(x, 0).c[0], input_deg)
        return Jet((self.ends_deg[i] + library(angle).degrees(angle), *own.c[1:]))


class DrivenShaft(Batchable):
    """Reactions on the shaft between two drives, and on the second one's guide, to loads.

    ``push`` is None for a couple, or for a shaft whose bearings are not computed.
    """

    def __init__(
        self, own: base.Engagement, timing: Timing, push: PushedCrank | None, sign: float
    ) -> None:
        self.own, self.timing, self.push = own, timing, push
        sense = own.crank_sense
        self.mirror = choose(sense == 0.0, 1.0, sense)
        self.clockwise = choose(sense == 0.0, sign, sense)  # -1 for one that turns the other way

    def __call__(self, turn: Jet, path: Vector, loads: Loads) -> Held:
        """Reactions of the shaft's bearings, and of the guide, to each load."""
        assert self.own.reactions is not None  # ``retimed`` passes engagements with reactions only
        own_deg, angle = self.timing.at(turn.c[0] / DEGREE, turn.order + 1)
        held = self.own.reactions(angle.lower, path, loads)
        if self.push is None:
            return held
        (x, y), (u, v) = self.push.line(turn)
        y, v = y * self.mirror, v * self.mirror
        lever = cross((x, y), (u, v)) * angle.derivative() * self.clockwise
        velocity = path[0].derivative(), path[1].derivative()
        spin = _of_rate(self.own.carrier(own_deg, turn.order), angle)
        out = []
        for (force, moment), (shaft, guide) in zip(loads, held, strict=True):
            power = force[0] * velocity[0] + force[1] * velocity[1] + moment * spin
            size = power / lever
            out.append(((shaft[0] + u * size, shaft[1] + v * size), guide))
        return out
