"""Side-crank drive: Whitworth's crank and rotating coulisse, which carries the Geneva crank.

A and f follow Polyudov and Kandyak, "Kinematics of the Maltese cross mechanism with a side-crank".
"""

from __future__ import annotations

from typing import Annotated, ClassVar

from geneva_cli.drives.pushed import CirclingPush, PushedCrank
from geneva_cli.drives.whitworth import Whitworth
from geneva_cli.motion.drive import Plan
from geneva_cli.motion.pivots import Dimension, Joint, Layout, Link, Pivot, ShaftPlace
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import library, value_or
from geneva_cli.numerics.jet import Array, Displacement
from geneva_cli.spec.rules import POSITIVE, Range


class SideCrank(Whitworth, kw_only=True):
    """A crank and a rotating coulisse: A > 0 slows the index down, A < 0 makes it faster.

    ``A`` is the distance of the two axes over the input crank's length, between -1 and 1. Raises
    GenevaError outside this range.

    >>> Design(External(6), SideCrank(A=0.6)).peaks.velocity.max  # 1 / (1 + A) of the plain crank's
    0.625
    """

    NAME: ClassVar[str] = "side-crank"
    WORDS: ClassVar[str] = "a side-crank"
    IN_FRONT: ClassVar[str] = "a side-crank"
    ANY_RATIO: ClassVar[bool] = True
    length_key: ClassVar[str] = "input_crank_mm"
    A: Annotated[float, Range(-1.0, 1.0, "()"), "side-crank: base offset / crank; > 0 is slower"]
    input_crank_mm: Annotated[
        float | None, POSITIVE, "input crank length r, for its forces (parts use R by default)"
    ] = None

    def input_shaft(self, plan: Plan, sign: float, sense: float) -> ShaftPlace:
        return ShaftPlace(self._axis_mm(plan, sign), sense)

    def _axis_mm(self, plan: Plan, sign: float) -> float:
        """Place of the input crank's axis, mm from the wheel's."""
        return plan.center_distance_mm - sign * self.A * self._crank_mm(plan)

    def layout(self, plan: Plan, sign: float) -> Layout:
        r = self._crank_mm(plan)
        return (
            Pivot("input crank axis", self._axis_mm(plan, sign), 0.0),
            Dimension("input crank r", r, "mm"),
            Dimension("base offset a", self.A * r, "mm"),
        )

    def links(self, plan: Plan, sign: float, input_deg: Array) -> tuple[Link, ...]:
        L, r = plan.center_distance_mm, self._crank_mm(plan)
        turn, still = radians(input_deg), 0.0 * input_deg
        m = library(turn)
        axis = still + self._axis_mm(plan, sign), still
        pin = axis[0] - sign * r * m.cos(turn), r * m.sin(turn)
        own = still + L, still
        return (
            Link("input crank", (axis, pin), (Joint.SHAFT, Joint.PIN), 3),
            Link("coulisse", (own, pin), (Joint.SHAFT, Joint.SLIDE), 2),
        )

    def _crank_mm(self, plan: Plan) -> float:
        return value_or(self.input_crank_mm, plan.ratio * plan.center_distance_mm)

    def reactions(
        self, wheel: Gearing, advance: Displacement, mid_deg: float, L: float
    ) -> PushedCrank | None:
        if self.input_crank_mm is None:
            return None
        r = self.input_crank_mm / L
        return CirclingPush(self.A, 1.0, -wheel.SIGN * r, r, radians(mid_deg))
