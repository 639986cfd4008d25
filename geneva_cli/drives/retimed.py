"""A machine whose input shaft another drive turns: gears or a side-crank in front.

The drive of the spec has engagements by the angle theta of its own input shaft. The drive before it
turns that shaft by theta = g(phi), where phi is the machine's input. So path, slot and motion are
p(g(phi)), M(g(phi)) and psi(g(phi)), and their derivatives follow by the chain rule: the wheel's
speed is psi'(theta) g', its acceleration psi''(theta) g'² + psi'(theta) g''. A law holds by theta,
for which slot or groove are cut: whatever turns the shaft, wheel and crank stay the same.

The angle g is written about entry, mid-motion and exit, so that it is exact at each of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, NamedTuple, cast

from geneva_cli.drives.driven_shaft import DrivenShaft, ShaftPath
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.engagement import (
    Anchor,
    Displacement,
    Engagement,
    Level,
    Path,
    Reactions,
    Slot,
    SlotAxis,
    WheelMotion,
)
from geneva_cli.motion.path_and_slot import cuts
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import Array, Batchable, array, library, narrowed
from geneva_cli.numerics.jet import Jet, Number, atan2, composed, piecewise
from geneva_cli.numerics.roots import boundary

if TYPE_CHECKING:
    from geneva_cli.drives.transmission import Transmission
    from geneva_cli.motion.machine_spec import Spec


def retimed(plan: Plan, spec: Spec, in_front: Drive) -> Plan:
    """Return the plan of a spec's drive behind the drive in front of it."""
    before = cast("Transmission", in_front)  # ``compatible`` requires one
    turn = 360.0 * spec.drive.turns
    periods = round(array(turn / plan.period_deg).flat[0])  # in a turn: as many in all of a batch
    each = tuple(
        _engagement(own, Timing(before, own, k * plan.period_deg), spec, plan.center_distance_mm)
        for k in range(periods)
        for own in plan.engagements
    )
    return plan._replace(engagements=each, period_deg=turn * before.turns)


def _engagement(own: Engagement, timing: Timing, spec: Spec, L: float) -> RetimedEngagement:
    """Return an engagement behind the drive before, with the reactions of the shaft between."""
    push = None
    if spec.drive.turned_at_crank:
        path = ShaftPath(spec.wheel.SIGN, timing)
        push = timing.before.reactions(spec.wheel, path, timing.within_deg, L)
    reactions: Reactions | None = push  # of a crank that carries its rollers
    if own.reactions:
        reactions = DrivenShaft(own, timing, push, spec.wheel.SIGN)
    return RetimedEngagement(own, timing, reactions)


class Rotation(NamedTuple):
    """Rotation of the driven shaft about one of its angles."""

    input_deg: float  # machine's input, from mid-motion
    own_deg: float  # driven shaft, from mid-motion
    advance: Displacement

    def at(self, input_deg: Number, order: int) -> Jet:
        """Angle of the driven shaft, degrees, at input angles in degrees.

        Its derivatives are by the input angle, both in radians.
        """
        turned = self._turned(input_deg, order)
        # the shaft never turns back, so the ends of an enclosure of angles decide
        angle = narrowed(turned.c[0], lambda x: self._turned(x, 0).c[0], input_deg)
        return Jet((self.own_deg + library(angle).degrees(angle), *turned.c[1:]))

    def _turned(self, input_deg: Number, order: int) -> Jet:
        return _angle(self.advance, radians(input_deg - self.input_deg), order)


class Timing(Batchable):
    """Angle of a drive's own input shaft over one engagement, by the machine's input angle.

    ``late_deg`` is the own angle by which the engagement follows the one that it repeats.
    """

    def __init__(self, before: Transmission, own: Engagement, late_deg: float) -> None:
        mid = own.mid_deg + late_deg
        turns = library(mid).floor(mid / 360.0 + 0.5)
        self.before, self.shaft_deg = before, mid
        self.rest_deg = mid - 360.0 * turns  # ``about`` covers one turn of the shaft
        ends = (own.entry_deg, 0.0, own.exit_deg)
        local = [before.about(self.rest_deg + end) for end in ends]
        self.within_deg = local[1].input_deg  # input angle of mid-motion in that turn
        self.mid_deg = 360.0 * before.turns * turns + self.within_deg
        self.even = local[1].even
        self.each = tuple(
            Rotation(one.input_deg - self.within_deg, end, one.advance)
            for one, end in zip(local, ends, strict=True)
        )
        self.changes_deg = tuple(
            one.input_deg - self.within_deg + cut / DEGREE for one in local for cut in one.cuts
        )

    def of(self, other: Engagement, ahead_deg: float) -> Timing:
        """The timing of another engagement, whose mid-motion is earlier by an own angle."""
        return Timing(self.before, other, self.shaft_deg - ahead_deg - other.mid_deg)

    @property
    def cuts(self) -> list[float]:
        """Input angles at which the formula about another place takes over, degrees."""
        return cuts([one.input_deg for one in self.each])

    def input_deg(self, own_deg: float) -> float:
        """Machine's input angle at an angle of the driven shaft, both from mid-motion, degrees."""
        return self.before.about(self.rest_deg + own_deg).input_deg - self.within_deg

    def inputs_deg(self, own_deg: Array) -> Array:
        """Machine's input angles at angles of the driven shaft within the motion, degrees.

        They are bisected, as the gears of a ratio file are known about one angle at a time.
        """
        first, last = (array(self.each[k].input_deg) + 0.0 * own_deg for k in (0, -1))
        return boundary(lambda x: array(self.at(x, 0)[0]) <= own_deg, first, last)

    def __call__(self, input_deg: Number, order: int) -> Jet:
        """Angle of the driven shaft in radians from mid-motion, at input angles in degrees."""
        return self.at(input_deg, order)[1]

    def at(self, input_deg: Number, order: int) -> tuple[Number, Jet]:
        """Angle of the driven shaft in degrees, and in radians with its derivatives."""
        pieces = [partial(one.at, order=order) for one in self.each]
        own = piecewise(input_deg, self.cuts, pieces)
        return own.c[0], Jet((radians(own.c[0]), *own.c[1:]))


class ComposedDisplacement(NamedTuple):
    """A pin's displacement by the input's rotation, through the driven shaft's."""

    displacement: Displacement
    advance: Displacement

    def __call__(self, tau: Number, order: int) -> tuple[Jet, Jet]:
        """Displacement along the anchor's ray and across it, ``tau`` input radians later."""
        turned = _angle(self.advance, tau, order)
        along, across = self.displacement(turned.c[0], order)
        return composed(along, turned), composed(across, turned)


class RetimedPath(Batchable):
    """A pin's path by the machine's input angle."""

    def __init__(self, own: Path, timing: Timing) -> None:
        self.own, self.timing = own, timing

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Pin (x, y) in the fixed frame."""
        at, turned = self.timing.at(input_deg, order)
        x, y = self.own(at, order)
        return composed(x, turned), composed(y, turned)


class RetimedMotion(WheelMotion):
    """The wheel's angle by the machine's input angle."""

    BREAKS_TO: ClassVar[float] = 2e-14  # roundings of angles of the own shaft, which may be slower

    def __init__(self, own: WheelMotion, timing: Timing) -> None:
        first, _, last = (one.input_deg for one in timing.each)
        super().__init__(first, last, own.half_step)
        self.own, self.timing = own, timing

    @property
    def symmetric(self) -> bool:
        """True if both the own motion and the drive before are symmetric about mid-motion."""
        return self.timing.even and self.own.symmetric and super().symmetric

    @property
    def entry(self) -> Anchor | None:
        """Pin at entry, by the machine's input angle."""
        own, first = self.own.entry, self.timing.each[0]
        if own is None:
            return None
        displacement = ComposedDisplacement(own.displacement, first.advance)
        return Anchor(self.entry_deg, own.wheel, own.along, displacement)

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        """Ends, middle and possible jumps of the drive's own motion, as input angles, degrees."""
        return self._from_own(self.own.breaks_deg)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        """Input angles, degrees, where the formula of the own motion or of the gears changes."""
        own = self._from_own(self.own.seams_deg)
        places = {*own, *self.timing.cuts, *self.timing.changes_deg}
        inside = sorted(at for at in places if self.entry_deg < at < self.exit_deg)
        return (self.entry_deg, *inside, self.exit_deg)

    def _from_own(self, own_deg: Sequence[float]) -> tuple[float, ...]:
        inner = (self.timing.input_deg(at) for at in own_deg[1:-1])
        return (self.entry_deg, *inner, self.exit_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        """Wheel angle with its derivatives by the machine's input angle in radians."""
        at, turned = self.timing.at(input_deg, order)
        return composed(self.own(at, order), turned)

    def rate(self, input_deg: Number, order: int = 2) -> Jet:
        """Wheel speed over the machine's input speed: psi'(theta) g'."""
        at, turned = self.timing.at(input_deg, order + 1)
        return _of_rate(self.own.rate(at, order), turned)


class RetimedSlot(Slot):
    """A slot whose pin runs along it by the machine's input angle."""

    def __init__(self, own: Slot, timing: Timing) -> None:
        self.own, self.timing = own, timing
        self.curved, self.mirrored = own.curved, own.mirrored
        self.relieved, self.offset = own.relieved, own.offset
        self.height = None if own.height is None else RetimedLevel(own.height, timing)

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Pin (x, y) in the wheel's frame."""
        at, turned = self.timing.at(input_deg, order)
        x, y = self.own(at, order)
        return composed(x, turned), composed(y, turned)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        """Input angles, degrees, at which the formula of the drive's own slot changes."""
        return tuple(self.timing.input_deg(at) for at in self.own.seams_deg)

    def axis(self, input_deg: Number, order: int = 0) -> SlotAxis | None:
        """The slot's lever, and the pin's speed along it by the machine's input angle."""
        at, turned = self.timing.at(input_deg, order + 1)
        axis = self.own.axis(at, order)
        if axis is None:
            return None
        return SlotAxis(composed(axis.lever, turned.lower), _of_rate(axis.along, turned))

    def upright(self, input_deg: Number, order: int = 0) -> Jet | float:
        """Cosine of the angle between the roller's axis and the wheel's."""
        at, turned = self.timing.at(input_deg, order)
        upright = self.own.upright(at, order)
        return composed(upright, turned) if isinstance(upright, Jet) else upright

    def play(self, clearance: Number) -> Number:
        """Free angle of the wheel, radians, for a clearance per side over the lever."""
        return self.own.play(clearance)

    def touches(self, input_deg: Number) -> Number:
        """1 where the roller drives the wheel, 0 where something else does."""
        return self.own.touches(self.timing.at(input_deg, 0)[0])


class RetimedLevel(NamedTuple):
    """A pin's position along a spherical wheel's axis, by the machine's input angle."""

    own: Level
    timing: Timing

    @property
    def hub(self) -> float:
        """Position of the centre of the pin's circle."""
        return self.own.hub

    def __call__(self, tau: Number, order: int) -> Jet:
        """Position ``tau`` input radians after mid-motion."""
        turned = self.timing(library(tau).degrees(tau), order)
        return composed(self.own(turned.c[0], order), turned)


class RetimedRate(NamedTuple):
    """Angular velocity of the body that carries the roller, by the machine's input."""

    own: Engagement
    timing: Timing

    def __call__(self, tau: Number, order: int) -> Jet:
        """Rate in radians per input radian, positive with the wheel, ``tau`` after mid-motion."""
        at, turned = self.timing.at(library(tau).degrees(tau), order + 1)
        return _of_rate(self.own.carrier(at, order), turned)


class RetimedEngagement(Engagement):
    """An engagement of a drive's own, behind another drive."""

    def __init__(self, own: Engagement, timing: Timing, reactions: Reactions | None = None) -> None:
        super().__init__(
            timing.mid_deg,
            RetimedPath(own.path, timing),
            RetimedSlot(own.slot, timing),
            RetimedMotion(own.motion, timing),
            body=RetimedRate(own, timing),
            reactions=reactions,
            crank_sense=own.crank_sense,
            groove=own.groove,
            hub=own.hub,
        )
        self._own, self.timing = own, timing

    def shaft_rate(self, input_deg: Number, order: int = 0) -> Jet:
        """Rate of the shaft that the drive before turns, in radians per input radian."""
        return self.timing(input_deg, order + 1).derivative()

    def own_deg(self, input_deg: Array) -> Array:
        """Angle of the drive's own input shaft at input angles from mid-motion, degrees."""
        return array(self.timing.at(input_deg, 0)[0])

    def inputs_deg(self, own_deg: Array) -> Array:
        """Input angles from mid-motion at angles of the drive's own input shaft, degrees."""
        return self.timing.inputs_deg(own_deg)

    @property
    def passages(self) -> tuple[tuple[Engagement, float], ...]:
        """Passage of each roller through a whole slot, each in its own phase of the drive before.

        Its lead is the input angle by which its mid-motion is earlier.
        """
        return tuple(self._passage(*one) for one in self._own.passages)

    def _passage(self, own: Engagement, ahead_deg: float) -> tuple[Engagement, float]:
        if own is self._own:
            return self, 0.0
        timing = self.timing.of(own, ahead_deg)
        return RetimedEngagement(own, timing), self.mid_deg - timing.mid_deg

    @property
    def overtaking(self) -> float:
        """Angle by which a roller would lead its slot while something else drives, radians."""
        return self._own.overtaking

    @property
    def own(self) -> Engagement:
        """The engagement by the angle of the drive's own input shaft."""
        return self._own


def _angle(advance: Displacement, tau: Number, order: int) -> Jet:
    """Angle by which the driven shaft advances in ``tau`` input radians, radians."""
    sine, versine = advance(tau, order)
    return atan2(sine, 1.0 - versine)


def _of_rate(rate: Jet, turned: Jet) -> Jet:
    """A rate per radian of the driven shaft, as one per radian of the input."""
    return composed(rate, turned.lower) * turned.derivative()
