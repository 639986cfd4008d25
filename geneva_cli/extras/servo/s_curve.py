"""The law ``s-curve``: the seven segments of a servo, with a jerk constant in each."""

from __future__ import annotations

from functools import partial
from typing import Annotated, ClassVar, NamedTuple

from geneva_cli.kept import cached_property
from geneva_cli.motion.laws.law import Law
from geneva_cli.numerics.jet import Jet, Number, piecewise
from geneva_cli.spec.rules import Range


class _Phase(NamedTuple):
    """A segment: its beginning, and what holds there."""

    begin: float
    s: float
    v: float
    a: float
    jerk: float

    def at(self, u: Number, order: int) -> Jet:
        x = Jet.variable(u - self.begin, order)
        speed = self.v + x * (0.5 * self.a + x * (self.jerk / 6.0))
        return self.s + x * speed

    def after(self, begin: float, jerk: float) -> _Phase:
        x = begin - self.begin
        a = self.a + self.jerk * x
        v = self.v + x * (self.a + 0.5 * self.jerk * x)
        s = self.s + x * (self.v + x * (0.5 * self.a + x * self.jerk / 6.0))
        return _Phase(begin, s, v, a, jerk)


class SCurve(Law):
    """Constant velocity in the middle, and acceleration that rises and falls along lines.

    The greatest velocity is 2/(1 + cruise), the greatest acceleration 4/((1 - cruise²)(1 - ramp)).
    Without ramps it is the trapezoid of velocity, whose mean square of acceleration is least at a
    cruise of 1/3.

    >>> SCurve(cruise=0.5, ramp=0.5)(0.5, 1).derivatives()[1]  # 4/3
    1.33333...
    """

    NAME: ClassVar[str] = "s-curve"
    ABOUT: ClassVar[str] = "seven segments of a servo: constant jerk in each"
    cruise: Annotated[float, Range(0.0, 0.999), "s-curve: time fraction of constant velocity"] = (
        1.0 / 3.0
    )
    ramp: Annotated[
        float,
        Range(0.0, 0.5),
        "s-curve: fraction of the acceleration in which it rises, and of its fall",
    ] = 0.25

    def may_vary(self, table: str, key: str) -> bool:
        """False for the fractions, which decide the pieces and so must be numbers."""
        return table != "motion" or key not in self.as_dict()

    @cached_property
    def _phases(self) -> list[_Phase]:
        rise = 0.5 * (1.0 - self.cruise)
        ramp = self.ramp * rise
        most = 2.0 / (1.0 + self.cruise) / (rise - ramp)
        if ramp:
            phases = [_Phase(0.0, 0.0, 0.0, 0.0, most / ramp)]
            if ramp < rise - ramp:
                phases.append(phases[-1].after(ramp, 0.0))
            phases.append(phases[-1].after(rise - ramp, -most / ramp))
        else:
            phases = [_Phase(0.0, 0.0, 0.0, most, 0.0)]
        if self.cruise:
            phases.append(phases[-1].after(rise, 0.0)._replace(a=0.0))
        return phases

    @property
    def breaks(self) -> tuple[float, ...]:
        """Values of u at which the segments meet."""
        inner = [phase.begin for phase in self._phases[1:]]
        middle = [] if self.cruise else [0.5]
        return (*inner, *middle, *(1.0 - u for u in reversed(inner)))

    def first(self, u: Number, order: int) -> Jet:
        """First half of s, in which the wheel gains speed."""
        phases = self._phases
        if len(phases) == 1:
            return phases[0].at(u, order)
        cuts = tuple(phase.begin for phase in phases[1:])
        return piecewise(u, cuts, [partial(phase.at, order=order) for phase in phases])
