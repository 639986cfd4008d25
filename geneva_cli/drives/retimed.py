"""A machine whose input shaft another drive turns: gears or a side-crank in front.

The drive of the spec has engagements by the angle theta of its own input shaft. The drive before it
turns that shaft by theta = g(phi), where phi is the machine's input. So path, slot and motion are
p(g(phi)), M(g(phi)) and psi(g(phi)), and their derivatives follow by the chain rule: the wheel's
speed is psi'(theta) g', its acceleration psi''(theta) g'² + psi'(theta) g''. A law holds by theta,
for which slot or groove are cut: whatever turns the shaft, wheel and crank stay the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, NamedTuple, cast

from geneva_cli.drives.driven_shaft import DrivenShaft, ShaftPath, Timing, angle_of
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
from geneva_cli.numerics.arrays import Array, Batchable, array
from geneva_cli.numerics.jet import Jet, Number, composed

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


class _Displacement(NamedTuple):
    """A displacement by the input's rotation, through the driven shaft's."""

    displacement: Displacement
    advance: Displacement

    def __call__(self, tau: Number, order: int) -> Vector:
        turned = angle_of(self.advance, tau, order)
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
    def own(self) -> Engagement:
        return self._own


def _of_rate(rate: Jet, turned: Jet) -> Jet:
    """A rate per radian of the driven shaft, as one per radian of the input."""
    return composed(rate, turned.lower) * turned.derivative()
