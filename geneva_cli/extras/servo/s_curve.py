"""The law ``s-curve``: the seven segments of a servo, with a jerk constant in each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from geneva_cli.kept import cached_property
from geneva_cli.motion.laws.law import Law
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.spec.rules import Range

if TYPE_CHECKING:
    from geneva_cli.numerics.spline import PiecewisePolynomial


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
    SHARED: ClassVar[tuple[str, ...]] = ("cruise", "ramp")  # they decide the pieces
    cruise: Annotated[float, Range(0.0, 0.999), "s-curve: time fraction of constant velocity"] = (
        1.0 / 3.0
    )
    ramp: Annotated[
        float,
        Range(0.0, 0.5),
        "s-curve: fraction of the acceleration in which it rises, and of its fall",
    ] = 0.25

    @cached_property
    def _segments(self) -> PiecewisePolynomial:
        """The first half of s, in which the wheel gains speed."""
        # a list of the laws needs no polynomials
        import numpy as np

        from geneva_cli.numerics.jet import taylor
        from geneva_cli.numerics.spline import PiecewisePolynomial

        rise = 0.5 * (1.0 - self.cruise)
        ramp = self.ramp * rise
        most = 2.0 / (1.0 + self.cruise) / (rise - ramp)  # of the acceleration
        jerk = most / ramp if ramp else 0.0
        state, rows, starts = [0.0, 0.0, 0.0 if ramp else 0.5 * most], [], []
        ends = ramp, rise - ramp, rise, 0.5
        for start, end, own in zip((0.0, *ends), ends, (jerk, 0.0, -jerk, 0.0), strict=False):
            if start < end:
                rows.append([*state, own / 6.0])
                starts.append(start)
                state = taylor(end - start, rows[-1], 2)
        if self.cruise:
            rows[-1][2] = 0.0  # without the acceleration that rounding leaves
        return PiecewisePolynomial(np.array(starts[1:]), np.array(starts), np.array(rows))

    @property
    def breaks(self) -> tuple[float, ...]:
        """Values of u at which the segments meet."""
        inner = self._segments.cuts.tolist()
        middle = [] if self.cruise else [0.5]
        return (*inner, *middle, *(1.0 - u for u in reversed(inner)))

    def first(self, u: Number, order: int) -> Jet:
        """First half of s, in which the wheel gains speed."""
        return Jet(self._segments(u, order))
