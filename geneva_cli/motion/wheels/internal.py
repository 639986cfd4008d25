"""Internal wheels."""

from typing import ClassVar

from geneva_cli.motion.wheels.gearing import Gearing, RollerPlace


class Internal(Gearing):
    """The crank turns inside the wheel: more motion than dwell, and no peak inside the motion.

    ``z`` is the number of slots, 3 or more.

    >>> Design(Internal(6)).timing.motion_deg
    240.0
    """

    NAME: ClassVar[str] = "internal"
    SIGN: ClassVar[float] = -1.0

    def as_built(self, ratio: float, rim: float, L: float) -> RollerPlace:
        from geneva_cli.motion.wheels.as_built import place

        return place(self.SIGN, self.step, ratio, 0.0, rim)
