"""A crank directly on the input shaft."""

from __future__ import annotations

from typing import ClassVar

from geneva_cli.machine.drives.transmission import Direct


class Crank(Direct, kw_only=True):
    """The plain crank: crank angle and input angle are equal.

    ``n_rpm`` is its constant speed. ``rollers`` is the number of rollers, evenly spaced unless
    ``roller_angles_deg`` places them.

    >>> Design(External(6), Crank(n_rpm=30, rollers=2)).timing.cycle_s  # a roller's passage
    1.0
    """

    NAME: ClassVar[str] = "crank"
    WORDS: ClassVar[str] = "a crank"
    FIRST: ClassVar[str] = "its crank is on the shaft: set that kind in [drive] instead"
