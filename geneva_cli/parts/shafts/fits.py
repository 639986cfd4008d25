"""Limits of the fits (ISO 286) that the drawings use, and clearances of parts that slide.

H7 is for holes, g6 and h6 for shafts in them. A pin is h6: parts pressed on it are P7, parts that
turn on it are F7 (shaft-basis fits, ISO 286-1).
"""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.spec.workshops import workshop
from geneva_cli.spec.written import signed


class SizeRange(NamedTuple):
    """A range of nominal sizes, mm, with its grades and deviations in micrometres."""

    up_to: float
    it6: int
    it7: int
    g: int  # of the upper limit of a shaft g, below the nominal size
    f: int  # of the upper limit of a shaft f, below it; of the lower limit of a hole F, above
    p: int  # of the lower limit of a shaft p, above the nominal size
    it11: int | None = None
    c: int | None = None  # of a shaft c, below it, for the range's larger sizes; None above 500 mm


# ISO 286-1:2010: grades IT6, IT7 and IT11 by its table 1, the fundamental deviations g, f, p and c
# by its tables 4 and 5.
# fmt: off
ISO_286 = [SizeRange(*row) for row in (
    (3, 6, 10, 2, 6, 6, 60, 60), (6, 8, 12, 4, 10, 12, 75, 70), (10, 9, 15, 5, 13, 15, 90, 80),
    (18, 11, 18, 6, 16, 18, 110, 95), (30, 13, 21, 7, 20, 22, 130, 110),
    (50, 16, 25, 9, 25, 26, 160, 130), (80, 19, 30, 10, 30, 32, 190, 150),
    (120, 22, 35, 12, 36, 37, 220, 180), (180, 25, 40, 14, 43, 43, 250, 230),
    (250, 29, 46, 15, 50, 50, 290, 280), (315, 32, 52, 17, 56, 56, 320, 330),
    (400, 36, 57, 18, 62, 62, 360, 400), (500, 40, 63, 20, 68, 68, 400, 480),
    (630, 44, 70, 22, 76, 78), (800, 50, 80, 24, 80, 88), (1000, 56, 90, 26, 86, 100),
    (1250, 66, 105, 28, 98, 120), (1600, 78, 125, 30, 110, 140), (2000, 92, 150, 32, 120, 170),
    (2500, 110, 175, 34, 130, 195), (3150, 135, 210, 38, 145, 240),
)]
# fmt: on


def limits(nominal_mm: float, fit: str) -> tuple[int, int] | None:
    """Return upper and lower deviation in micrometres; None beyond the standard's 3150 mm.

    >>> limits(20.0, "H7"), limits(20.0, "g6"), limits(20.0, "h6")
    ((21, 0), (-7, -20), (0, -13))
    """
    row = _range_of(nominal_mm)
    if row is None:
        return None
    # up to 500 mm a hole P7 has as much interference as a shaft p6 (ISO 286-1, 4.3.2.5)
    top = -row.p + (row.it7 - row.it6 if 3.0 < nominal_mm <= 500.0 else 0)
    return {
        "H7": (row.it7, 0),
        "F7": (row.f + row.it7, row.f),
        "P7": (top, top - row.it7),
        "g6": (-row.g, -row.g - row.it6),
        "h6": (0, -row.it6),
    }[fit]


def loosest_mm(nominal_mm: float) -> float | None:
    """Return the greatest clearance of H11/c11, mm of the diameter; None beyond 500 mm.

    It is ISO 286's loosest preferred fit. Both limits add up: the hole is wider by IT11, the shaft
    narrower by c and IT11.

    >>> loosest_mm(24.0)
    0.37
    """
    row = _range_of(nominal_mm)
    if row is None or row.it11 is None or row.c is None:
        return None
    return (2 * row.it11 + row.c) / 1000.0


def closest_mm(nominal_mm: float) -> float | None:
    """Return the least clearance of H7/h6, on average, with which all parts go together, mm.

    It is of the diameter: half of both grades, for the widest shaft in the narrowest hole. None
    beyond the standard's 3150 mm.

    >>> closest_mm(24.0)
    0.017
    """
    row = _range_of(nominal_mm)
    return None if row is None else (row.it6 + row.it7) / 2000.0


def _range_of(nominal_mm: float) -> SizeRange | None:
    return next((row for row in ISO_286 if 0.0 < nominal_mm <= row.up_to), None)


def toleranced(nominal_mm: float, shown: str, fit: str) -> str:
    """Return a size with its fit and the limits in mm.

    >>> toleranced(20.0, "Ø 20", "g6")
    'Ø 20 g6 (-0.007/-0.02)'
    """
    deviations = limits(nominal_mm, fit)
    if deviations is None:
        return shown
    upper, lower = (signed(1e-3 * one) for one in deviations)
    return f"{shown} {fit} ({upper}/{lower})"


class Fits(NamedTuple):
    """Fits of a part as the workshop of its process makes it.

    ``thickness_mm`` is that of the plate it is cut from; None for a part that is turned.

    >>> Fits("laser", 18.0).text(24.8, "24.8", "H7"), Fits("print", 18.0).text(24.5, "24.5", "H7")
    ('24.8 ±0.4', '24.5')
    """

    process: str | None = None
    thickness_mm: float | None = None

    def text(self, nominal_mm: float, shown: str, fit: str) -> str:
        """Return a size with its fit, with the deviation of a cut, or alone if none is kept."""
        shop = workshop(self.process)
        if self.thickness_mm is not None and shop.cut_mm:
            return f"{shown} ±{shop.cut_mm(self.thickness_mm, nominal_mm):g}"
        return toleranced(nominal_mm, shown, fit) if shop.fits else shown

    @property
    def is_iso(self) -> bool:
        """True if the part has fits of ISO 286."""
        shop = workshop(self.process)
        return shop.fits and (self.thickness_mm is None or shop.cut_mm is None)

    @property
    def turned(self) -> Fits:
        """The fits of a turned part of the same machine."""
        return self._replace(thickness_mm=None)
