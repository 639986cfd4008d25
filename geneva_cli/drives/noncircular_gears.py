"""Noncircular gears in front of the crank, with the ratio i = crank speed / input speed of a
side-crank.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from geneva_cli.drives import whitworth
from geneva_cli.drives.pushed import Mesh, PushedCrank
from geneva_cli.drives.transmission import LocalTransmission, Transmission
from geneva_cli.motion.drive import Gears, Plan
from geneva_cli.motion.pivots import Dimension, Layout, Pivot, ShaftPlace
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.rules import POSITIVE, Range
from geneva_cli.spec.schema import Example

if TYPE_CHECKING:
    from geneva_cli.numerics.jet_functions import Path


class NoncircularGears(Transmission, kw_only=True):
    """Gears with the ratio of a side-crank, whose ``A`` they have.

    >>> round(Design(External(6), NoncircularGears(A=0.6)).peaks.velocity.max, 12)
    0.625
    """

    NAME: ClassVar[str] = "noncircular-gears"
    WORDS: ClassVar[str] = "a crank behind noncircular gears"
    IN_FRONT: ClassVar[str] = "noncircular gears"
    EXAMPLE: ClassVar[Example] = Example(
        "noncircular gears in front, with the ratio of a side-crank",
        {"wheel": {"z": 6}, "drive": {"A": 0.6}},
    )
    A: Annotated[float, Range(-1.0, 1.0, "()"), "ratio of a side-crank with this A"]
    gear_distance_mm: Annotated[float, POSITIVE, "distance between the two gears' axes, C"] = 100.0

    def __post_init__(self) -> None:
        super().__post_init__()
        whitworth.refuse_rounding(self.A)

    @property
    def gears(self) -> Gears:
        return Gears(self.gear_distance_mm, self.about(0.0)[1])

    def input_shaft(self, plan: Plan, sign: float, sense: float) -> ShaftPlace:
        return ShaftPlace(plan.center_distance_mm + self.gear_distance_mm, -sense)

    def layout(self, plan: Plan, sign: float) -> Layout:
        return (
            Pivot("driver gear axis", plan.center_distance_mm + self.gear_distance_mm, 0.0),
            Dimension("gears' axes", self.gear_distance_mm, "mm"),
            Dimension("gears' ratio as of side-crank A", self.A),
        )

    def reactions(self, wheel: Gearing, path: Path, mid_deg: float, L: float) -> PushedCrank | None:
        return Mesh(path, self.gear_distance_mm / L)

    def about(self, crank_deg: float) -> LocalTransmission:
        return whitworth.about(self.A, crank_deg)

    @property
    def side_crank(self) -> float:
        return self.A
