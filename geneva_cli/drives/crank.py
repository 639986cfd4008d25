"""A crank directly on the input shaft, or several equal ones geared to it about one wheel.

Whole steps apart they move the wheel alike, in turn: as by one crank with that many rollers.
"""

import math
from typing import Annotated, ClassVar, Self

from geneva_cli.drives.transmission import Transmission
from geneva_cli.motion.drive import Plan
from geneva_cli.spec.rules import Z_MAX, Range


class Crank(Transmission, kw_only=True):
    """The plain crank: crank angle and input angle are equal.

    ``n_rpm`` is its constant speed. ``rollers`` is the number of rollers, evenly spaced unless
    ``roller_angles_deg`` places them. With ``crank_steps`` each roller has a crank of its own.

    >>> Design(External(6), Crank(n_rpm=30, rollers=2)).timing.cycle_s  # a roller's passage
    1.0
    >>> Design(External(6), Crank(rollers=2, crank_steps=(0, 3))).mechanism.crank_places[1].at[0]
    -100.0
    """

    NAME: ClassVar[str] = "crank"
    WORDS: ClassVar[str] = "a crank"
    direct: ClassVar[bool] = True
    ANY_RATIO: ClassVar[bool] = True
    crank_steps: Annotated[
        tuple[float, ...] | None,
        Range(0.0, Z_MAX, "[)"),
        "places of cranks with one roller each about the wheel, in steps from the first",
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.crank_steps:
            vars(self)["cranks"] = self.crank_steps

    def backwards(self, plan: Plan) -> Self:
        out = super().backwards(plan)
        if not self.crank_steps:
            return out
        z = float(round(math.pi / plan.engagements[0].half_step))
        return out.replace(crank_steps=(0.0, *(z - step for step in self.crank_steps[:0:-1])))
