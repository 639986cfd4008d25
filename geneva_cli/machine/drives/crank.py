"""The input shaft carries the crank itself."""

from __future__ import annotations

from typing import ClassVar

from geneva_cli.machine.drives.transmission import About, Transmission, same


class Crank(Transmission, kw_only=True):
    """The plain crank: crank angle and input angle are one.

    ``n_rpm`` is its constant speed, ``rollers`` how many it carries, evenly unless
    ``roller_angles_deg`` places them.

    >>> Design(External(6), Crank(n_rpm=30, rollers=2)).timing.cycle_s  # a roller's passage
    1.0
    """

    NAME: ClassVar[str] = "crank"
    WORDS: ClassVar[str] = "a crank"
    ALIKE: ClassVar[bool] = True

    @property
    def direct(self) -> bool:
        """The classic closed forms hold."""
        return True

    def about(self, crank_deg: float) -> About:
        """The crank's angle, which is the input's."""
        return About(crank_deg, same)
