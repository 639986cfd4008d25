"""ISO 286: limits of the fits that the drawings name, H7 for holes, g6 and h6 for shafts."""

from __future__ import annotations

from typing import NamedTuple


class Range(NamedTuple):
    """Nominal sizes up to one, in mm, and what belongs to them, in micrometres."""

    up_to: float
    it6: int
    it7: int
    g: int  # how far the upper limit of a shaft g is below the nominal size


# ISO 286-1:2010: grades IT6 and IT7 by its table 1, the fundamental deviation g by its table 4.
ISO_286 = [
    Range(*row)
    for row in (
        (3, 6, 10, 2),
        (6, 8, 12, 4),
        (10, 9, 15, 5),
        (18, 11, 18, 6),
        (30, 13, 21, 7),
        (50, 16, 25, 9),
        (80, 19, 30, 10),
        (120, 22, 35, 12),
        (180, 25, 40, 14),
        (250, 29, 46, 15),
        (315, 32, 52, 17),
        (400, 36, 57, 18),
        (500, 40, 63, 20),
        (630, 44, 70, 22),
        (800, 50, 80, 24),
        (1000, 56, 90, 26),
        (1250, 66, 105, 28),
        (1600, 78, 125, 30),
        (2000, 92, 150, 32),
        (2500, 110, 175, 34),
        (3150, 135, 210, 38),
    )
]


def limits(nominal_mm: float, fit: str) -> tuple[int, int] | None:
    """Upper and lower deviation in micrometres; None beyond the standard's 3150 mm.

    >>> limits(20.0, "H7"), limits(20.0, "g6"), limits(20.0, "h6")
    ((21, 0), (-7, -20), (0, -13))
    """
    row = next((row for row in ISO_286 if 0.0 < nominal_mm <= row.up_to), None)
    if row is None:
        return None
    return {"H7": (row.it7, 0), "g6": (-row.g, -row.g - row.it6), "h6": (0, -row.it6)}[fit]


def toleranced(nominal_mm: float, shown: str, fit: str) -> str:
    """A size with its fit and the limits in mm.

    >>> toleranced(20.0, "Ø 20", "g6")
    'Ø 20 g6 (-0.007/-0.02)'
    """
    found = limits(nominal_mm, fit)
    if found is None:
        return shown
    upper, lower = (f"{1e-3 * deviation:+g}" if deviation else "0" for deviation in found)
    return f"{shown} {fit} ({upper}/{lower})"
