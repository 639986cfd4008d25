"""A machine whose input shaft another drive turns: gears or a side-crank in front.

The drive of the spec has engagements by the angle theta of its own input shaft. The drive before it
turns that shaft by theta = g(phi), where phi is the machine's input. So path, slot and motion are
p(g(phi)), M(g(phi)) and psi(g(phi)), and their derivatives follow by the chain rule: the wheel's
speed is psi'(theta) g', its acceleration psi''(theta) g'² + psi'(theta) g''. A law holds by theta,
for which slot or groove are cut: whatever turns the shaft, wheel and crank stay the same.

The angle g is written about entry, mid-motion and exit, so that it is exact at each of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, NamedTuple, cast

from geneva_cli.drives.pushed import DrivenShaft, ShaftPath
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.engagement import (
    Anchor,
    Displacement,
    Engagement,
    Path,
    Reactions,
    Slot,
    SlotAxis,
    Vector,
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


def _engagement(own: Engagement, timing: Timing, spec: Spec, L: float) -> Engagement:
    """Return an engagement behind the drive before, with the reactions of the shaft between."""
    push = None
    if spec.drive.turned_at_crank:
        path = ShaftPath(spec.wheel.SIGN, timing)
        push = timing.before.reactions(spec.wheel, path, timing.within_deg, L)
    if own.reactions:
        return _Engagement(own, timing, DrivenShaft(own, timing, push, spec.wheel.SIGN))
    return _Engagement(own, timing, push)  # a crank that carries its rollers


class Timing(Batchable):
    """Angle of a drive's own input shaft over one engagement, by the machine's input angle.

    ``late_deg`` is the own angle by which the engagement follows the one that it repeats.
    """

    def __init__(self, before: Transmission, own: Engagement, late_deg: float) -> None:
        mid = own.mid_deg + late_deg
        turns = library(mid).floor(mid / 360.0 + 0.5)
        self.before, self.shaft_deg = before, mid
        self.rest_deg = mid - 360.0 * turns  # ``about`` covers one turn of the shaft
        self.ends_deg = (own.entry_deg, 0.0, own.exit_deg)  # of the own shaft
        local = [before.about(self.rest_deg + end) for end in self.ends_deg]
        self.within_deg = local[1].input_deg  # input angle of mid-motion in that turn
        self.mid_deg = 360.0 * before.turns * turns + self.within_deg
        self.even = local[1].even
        self.at_deg = tuple(one.input_deg - self.within_deg for one in local)
        self.advances = tuple(one.advance for one in local)
        # input angles at which the formula about another place takes over, or the gears' own
        self.cuts = cuts(self.at_deg)
        self.changes_deg = tuple(
            at + cut / DEGREE
            for at, one in zip(self.at_deg, local, strict=True)
            for cut in one.cuts
        )

    def of(self, other: Engagement, ahead_deg: float) -> Timing:
        """The timing of another engagement, whose mid-motion is earlier by an own angle."""
        return Timing(self.before, other, self.shaft_deg - ahead_deg - other.mid_deg)

    def input_deg(self, own_deg: float) -> float:
        """Machine's input angle at an angle of the driven shaft, both from mid-motion, degrees."""
        return self.before.about(self.rest_deg + own_deg).input_deg - self.within_deg

    def inputs_deg(self, own_deg: Array) -> Array:
        """Machine's input angles at angles of the driven shaft within the motion, degrees.

        They are bisected, as the gears of a ratio file are known about one angle at a time.
        """
        first, last = (array(self.at_deg[k]) + 0.0 * own_deg for k in (0, -1))
        return boundary(lambda x: array(self.at(x, 0)[0]) <= own_deg, first, last)

    def __call__(self, input_deg: Number, order: int) -> Jet:
        """Angle of the driven shaft in radians from mid-motion, at input angles in degrees."""
        return self.at(input_deg, order)[1]

    def at(self, input_deg: Number, order: int) -> tuple[Number, Jet]:
        """Angle of the driven shaft in degrees, and in radians with its derivatives."""
        pieces = [partial(self._about, i, order) for i in range(3)]
        own = piecewise(input_deg, self.cuts, pieces)
        return own.c[0], Jet((radians(own.c[0]), *own.c[1:]))

    def _about(self, i: int, order: int, input_deg: Number) -> Jet:
        """Angle of the driven shaft in degrees, with its derivatives in radians."""
        turn, advance = radians(input_deg - self.at_deg[i]), self.advances[i]
        turned = _angle(advance, turn, order)
        # the shaft never turns back, so the ends of an enclosure of angles decide
        angle = narrowed(
            turned.c[0],
            lambda x: _angle(advance, radians(x - self.at_deg[i]), 0).c[0],
            input_deg,
        )
        return Jet((self.ends_deg[i] + library(angle).degrees(angle), *turned.c[1:]))

    def vector(self, own: Callable[[Number, int], Vector], x: Number, order: int) -> Vector:
        """A vector of the own drive by the machine's input angle."""
        at, turned = self.at(x, order)
        a, b = own(at, order)
        return composed(a, turned), composed(b, turned)


class _Displacement(NamedTuple):
    """A displacement by the input's rotation, through the driven shaft's."""

    displacement: Displacement
    advance: Displacement

    def __call__(self, tau: Number, order: int) -> Vector:
        turned = _angle(self.advance, tau, order)
        along, across = self.displacement(turned.c[0], order)
        return composed(along, turned), composed(across, turned)


class _Path(Batchable):
    """A pin's path by the machine's input angle."""

    def __init__(self, own: Path, timing: Timing) -> None:
        self.own, self.timing = own, timing

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        return self.timing.vector(self.own, input_deg, order)


class _Motion(WheelMotion):
    """The wheel's angle by the machine's input angle."""

    BREAKS_TO: ClassVar[float] = 2e-14  # roundings of angles of the own shaft, which may be slower

    def __init__(self, own: WheelMotion, timing: Timing) -> None:
        super().__init__(timing.at_deg[0], timing.at_deg[-1], own.half_step)
        self.own, self.timing = own, timing

    @property
    def symmetric(self) -> bool:
        return self.timing.even and self.own.symmetric and super().symmetric

    @property
    def entry(self) -> Anchor | None:
        own = self.own.entry
        if own is None:
            return None
        displacement = _Displacement(own.displacement, self.timing.advances[0])
        return Anchor(self.entry_deg, own.wheel, own.along, displacement)

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        return self._from_own(self.own.breaks_deg)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        own = self._from_own(self.own.seams_deg)
        places = {*own, *self.timing.cuts, *self.timing.changes_deg}
        inside = sorted(at for at in places if self.entry_deg < at < self.exit_deg)
        return (self.entry_deg, *inside, self.exit_deg)

    def _from_own(self, own_deg: Sequence[float]) -> tuple[float, ...]:
        inner = (self.timing.input_deg(at) for at in own_deg[1:-1])
        return (self.entry_deg, *inner, self.exit_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        at, turned = self.timing.at(input_deg, order)
        return composed(self.own(at, order), turned)

    def rate(self, input_deg: Number, order: int = 2) -> Jet:
        at, turned = self.timing.at(input_deg, order + 1)
        return _of_rate(self.own.rate(at, order), turned)


class _Slot(Slot):
    """A slot whose pin runs along it by the machine's input angle."""

    def __init__(self, own: Slot, timing: Timing) -> None:
        self.own, self.timing = own, timing
        self.curved, self.mirrored = own.curved, own.mirrored
        self.relieved, self.offset = own.relieved, own.offset
        if own.height is not None:
            turn = _Displacement(own.height.turn, timing.advances[1])
            self.height = own.height._replace(turn=turn)

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        return self.timing.vector(self.own, input_deg, order)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        return tuple(self.timing.input_deg(at) for at in self.own.seams_deg)

    def axis(self, input_deg: Number, order: int = 0) -> SlotAxis | None:
        at, turned = self.timing.at(input_deg, order + 1)
        axis = self.own.axis(at, order)
        if axis is None:
            return None
        return SlotAxis(composed(axis.lever, turned.lower), _of_rate(axis.along, turned))

    def upright(self, input_deg: Number, order: int = 0) -> Jet | float:
        at, turned = self.timing.at(input_deg, order)
        upright = self.own.upright(at, order)
        return composed(upright, turned) if isinstance(upright, Jet) else upright

    def play(self, clearance: Number) -> Number:
        return self.own.play(clearance)

    def touches(self, input_deg: Number) -> Number:
        return self.own.touches(self.timing.at(input_deg, 0)[0])


class _Engagement(Engagement):
    """An engagement of a drive's own, behind another drive."""

    def __init__(self, own: Engagement, timing: Timing, reactions: Reactions | None = None) -> None:
        super().__init__(
            timing.mid_deg,
            _Path(own.path, timing),
            _Slot(own.slot, timing),
            _Motion(own.motion, timing),
            reactions=reactions,
            crank_sense=own.crank_sense,
            groove=own.groove,
            hub=own.hub,
        )
        self._own, self.timing = own, timing

    def carrier(self, input_deg: Number, order: int = 0) -> Jet:
        at, turned = self.timing.at(input_deg, order + 1)
        return _of_rate(self._own.carrier(at, order), turned)

    def shaft_rate(self, input_deg: Number, order: int = 0) -> Jet:
        return self.timing(input_deg, order + 1).derivative()

    def own_deg(self, input_deg: Array) -> Array:
        return array(self.timing.at(input_deg, 0)[0])

    def inputs_deg(self, own_deg: Array) -> Array:
        return self.timing.inputs_deg(own_deg)

    @property
    def passages(self) -> tuple[tuple[Engagement, float], ...]:
        """Each is in its own phase of the drive before, as far ahead in angles of the input."""
        return tuple(self._passage(*one) for one in self._own.passages)

    def _passage(self, own: Engagement, ahead_deg: float) -> tuple[Engagement, float]:
        if own is self._own:
            return self, 0.0
        timing = self.timing.of(own, ahead_deg)
        return _Engagement(own, timing), self.mid_deg - timing.mid_deg

    @property
    def overtaking(self) -> float:
        return self._own.overtaking

    @property
    def own(self) -> Engagement:
        return self._own


def _angle(advance: Displacement, tau: Number, order: int) -> Jet:
    """Angle by which the driven shaft advances in ``tau`` input radians, radians."""
    sine, versine = advance(tau, order)
    return atan2(sine, 1.0 - versine)


def _of_rate(rate: Jet, turned: Jet) -> Jet:
    """A rate per radian of the driven shaft, as one per radian of the input."""
    return composed(rate, turned.lower) * turned.derivative()
