"""The base of the drives that move the roller along a path of its own."""

from __future__ import annotations

from typing import ClassVar

from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.wheels.classic import refuse_jam, rollers_max


class PinPath(Drive, kw_only=True):
    """A drive that moves the roller along a path of its own, with straight radial slots."""

    ONE_ARM: ClassVar[bool] = False

    def planned(
        self, engagement: Engagement, ratio: float, center_distance_mm: float, inside: bool = False
    ) -> Plan:
        """The plan with one engagement for each roller."""
        motion = engagement.motion_deg
        refuse_jam(self.rollers, motion, inside)
        period = 360.0 / self.rollers
        return Plan((engagement,), period, ratio, rollers_max(motion), center_distance_mm)
