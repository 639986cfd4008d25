"""Limits of the fits (ISO 286) that the drawings use, and clearances of parts that slide.

H7 is for holes, g6 and h6 for shafts. A pin is h6: parts on it are P7 if pressed, F7 if they turn.
"""

from __future__ import annotations

# ISO 286-1:2010, micrometres for sizes up to a number of mm: grades IT6 and IT7 by its table 1, the
# fundamental deviations g, f and p by its tables 4 and 5; up to 500 mm also IT11, and c for the
# range's larger sizes. g, f and c are below the nominal size, p above it.
# fmt: off
ISO_286 = [
    (3, 6, 10, 2, 6, 6, 60, 60), (6, 8, 12, 4, 10, 12, 75, 70), (10, 9, 15, 5, 13, 15, 90, 80),
    (18, 11, 18, 6, 16, 18, 110, 95), (30, 13, 21, 7, 20, 22, 130, 110),
    (50, 16, 25, 9, 25, 26, 160, 130), (80, 19, 30, 10, 30, 32, 190, 150),
    (120, 22, 35, 12, 36, 37, 220, 180), (180, 25, 40, 14, 43, 43, 250, 230),
    (250, 29, 46, 15, 50, 50, 290, 280), (315, 32, 52, 17, 56, 56, 320, 330),
    (400, 36, 57, 18, 62, 62, 360, 400), (500, 40, 63, 20, 68, 68, 400, 480),
    (630, 44, 70, 22, 76, 78), (800, 50, 80, 24, 80, 88), (1000, 56, 90, 26, 86, 100),
    (1250, 66, 105, 28, 98, 120), (1600, 78, 125, 30, 110, 140), (2000, 92, 150, 32, 120, 170),
    (2500, 110, 175, 34, 130, 195), (3150, 135, 210, 38, 145, 240),
]
# fmt: on


def _range_of(nominal_mm: float) -> tuple[int, ...]:
    """Return the standard's numbers for a size; empty beyond its 3150 mm."""
    for row in ISO_286:
        if 0.0 < nominal_mm <= row[0]:
            return row[1:]
    return ()


def limits(nominal_mm: float, fit: str) -> tuple[int, int] | None:
    """Return upper and lower deviation in micrometres; None beyond the standard's 3150 mm.

    >>> limits(20.0, "H7"), limits(20.0, "g6"), limits(20.0, "h6")
    ((21, 0), (-7, -20), (0, -13))
    """
    row = _range_of(nominal_mm)
    if not row:
        return None
    it6, it7, g, f, p = row[:5]
    # up to 500 mm a hole P7 has as much interference as a shaft p6 (ISO 286-1, 4.3.2.5)
    top = -p + (it7 - it6 if 3.0 < nominal_mm <= 500.0 else 0)
    return {
        "H7": (it7, 0),
        "F7": (f + it7, f),
        "P7": (top, top - it7),
        "g6": (-g, -g - it6),
        "h6": (0, -it6),
    }[fit]


def loosest_mm(nominal_mm: float) -> float | None:
    """Return the greatest clearance of H11/c11, ISO 286's loosest preferred fit, mm of diameter.

    The hole is wider by IT11, the shaft narrower by c and IT11. None beyond 500 mm.

    >>> loosest_mm(24.0)
    0.37
    """
    row = _range_of(nominal_mm)
    return (2 * row[5] + row[6]) / 1000.0 if len(row) > 5 else None


def closest_mm(nominal_mm: float) -> float | None:
    """Return the mean clearance of H7/h6, mm of the diameter: half of both grades.

    >>> closest_mm(24.0)
    0.017
    """
    row = _range_of(nominal_mm)
    return (row[0] + row[1]) / 2000.0 if row else None
