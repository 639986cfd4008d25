"""A crank directly on the input shaft."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar

from geneva_cli.kinematics.engagement import Displacement
from geneva_cli.machine.drives.transmission import LocalTransmission, Transmission, same


class Crank(Transmission, kw_only=True):
    """The plain crank: crank angle and input angle are equal.

    ``n_rpm`` is its constant speed. ``rollers`` is the number of rollers, evenly spaced unless
    ``roller_angles_deg`` places them.

    >>> Design(External(6), Crank(n_rpm=30, rollers=2)).timing.cycle_s  # a roller's passage
    1.0
    """

    NAME: ClassVar[str] = "crank"
    WORDS: ClassVar[str] = "a crank"
    ALIKE: ClassVar[bool] = True

    @property
    def direct(self) -> bool:
        """Always True: the classic closed forms hold."""
        return True

    def exact_advance(
        self, half: tuple[float, float], exact: Callable[[float], float]
    ) -> Displacement:
        """Rotation of the crank, which is the input's."""
        return same

    def about(self, crank_deg: float) -> LocalTransmission:
        """Transmission about a crank angle in degrees, which is the input angle."""
        return LocalTransmission(crank_deg, same)
