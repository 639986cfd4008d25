"""A machine whose input shaft another drive turns, by theta = g(phi): gears or a side-crank.

Path, slot and motion are p(g(phi)), M(g(phi)) and psi(g(phi)), derived by the chain rule. A
law holds by theta: whatever turns the shaft, wheel and crank stay the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, NamedTuple, cast

from geneva_cli.drives.driven_shaft import DrivenShaft, ShaftPath, Timing, angle_of
from geneva_cli.motion import engagement as base
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.engagement import Vector
from geneva_cli.numerics.arrays import Array, Batchable, array
from geneva_cli.numerics.jet import Jet, Number, composed
from geneva_cli.numerics.roots import boundary

if TYPE_CHECKING:
    from geneva_cli.drives.transmission import Transmission
    from geneva_cli.motion.machine_spec import Spec
    from geneva_cli.numerics.jet_functions import Displacement, Path, Reactions


def retimed(plan: Plan, spec: Spec, in_front: Drive) -> Plan:
    """The plan of a spec's drive behind the drive in front of it."""
    before = cast("Transmission", in_front)  # ``compatible`` requires one
    turn, sign = 360.0 * spec.drive.turns, spec.wheel.SIGN
    periods = round(array(turn / plan.period_deg).flat[0])  # in a turn: as many in all of a batch
    each = []
    for k in range(periods):
        for own in plan.engagements:
            timing, push = Timing(before, own, k * plan.period_deg), None
            if spec.drive.turned_at_crank:
                path, mid_deg = ShaftPath(sign, timing), timing.within_deg
                push = before.reactions(spec.wheel, path, mid_deg, plan.center_distance_mm)
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
        at, turned = self.timing.at(input_deg, order)
        x, y = self.own(at, order)
        return composed(x, turned), composed(y, turned)


class _Motion(base.WheelMotion):
    """The wheel's angle by the machine's input angle."""

    BREAKS_TO: ClassVar[float] = 2e-14  # roundings of angles of the own shaft, which may be slower

    def __init__(self, own: base.WheelMotion, timing: Timing) -> None:
        super().__init__(timing.at_deg[0], timing.at_deg[-1], own.half_step)
        self.own, self.timing = own, timing
        if own.entry is not None:
            displacement = _Displacement(own.entry.displacement, timing.advances[0])
            self.entry = own.entry._replace(input_deg=self.entry_deg, displacement=displacement)

    @property
    def symmetric(self) -> bool:
        return self.own.symmetric and super().symmetric

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

    def rate(self, input_deg: Number, order: int = 2) -> Jet:
        at, turned = self.timing.at(input_deg, order + 1)
        return _of_rate(self.own.rate(at, order), turned)


class _Slot(_Path, base.Slot):
    """A slot whose pin runs along it by the machine's input angle."""

    own: base.Slot

    def __init__(self, own: base.Slot, timing: Timing) -> None:
        super().__init__(own, timing)
        self.curved, self.relieved, self.offset = own.curved, own.relieved, own.offset
        self.walls_flat = own.walls_flat
        if own.height is not None:
            turn = _Displacement(own.height.turn, timing.advances[1])
            self.height = own.height._replace(turn=turn)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        return tuple(self.timing.input_deg(at) for at in self.own.seams_deg)

    def axis(self, input_deg: Number, order: int = 0) -> base.SlotAxis | None:
        at, turned = self.timing.at(input_deg, order + 1)
        axis = self.own.axis(at, order)
        if axis is None:
            return None
        return composed(axis[0], turned.lower), _of_rate(axis[1], turned)

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
        super().__init__(
            timing.mid_deg,
            _Path(own.path, timing),
            _Slot(own.slot, timing),
            _Motion(own.motion, timing),
            reactions=reactions,
            crank_sense=own.crank_sense,
            groove=own.groove,
            hub=own.hub,
            pair=tuple(pair),
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
        first, last = (array(self.timing.at_deg[k]) + 0.0 * own_deg for k in (0, -1))
        return boundary(lambda x: array(self.timing.at(x, 0)[0]) <= own_deg, first, last)

    @property
    def own(self) -> base.Engagement:
        return self._own
