"""Deviations of thermal cuts, ISO 9013:2017, tolerance class 1, which lasers keep."""

from __future__ import annotations

from collections.abc import Sequence

# Limit deviations in micrometres, plus and minus, of nominal sizes from 0, 3, 10, 35, 125, 315,
# 1000 and 2000 mm on, by the greatest thickness of the plate, mm (table for class 1). Where the
# standard has none, for a small size in a thick plate, that of the next larger size stands.
# Two shops print it: modulusmetal.com/iso-9013-thermal-cutting-dimensional-tolerances and
# lip-technik.de/Blech-und-Laserschneiden/Toleranzen. Up to 10 mm of plate, the only rows that were
# compared, they differ for sizes of 3 to 10 mm in 3.15 mm: 0.15 and 0.1. The larger stands here.
ISO_9013 = {
    1.0: (75, 100, 100, 200, 200, 300, 400, 650),
    3.15: (100, 150, 200, 250, 250, 350, 400, 650),
    6.3: (200, 200, 250, 250, 300, 400, 450, 700),
    10.0: (250, 250, 300, 300, 350, 450, 550, 750),
    15.0: (300, 300, 350, 400, 450, 550, 650, 850),
    20.0: (400, 400, 400, 450, 550, 750, 850, 1200),
    25.0: (450, 450, 500, 600, 700, 900, 1100, 1600),
    32.0: (700, 700, 700, 700, 800, 1000, 1600, 2250),
    50.0: (700, 700, 700, 700, 800, 1000, 1600, 2500),
    100.0: (1300, 1300, 1300, 1300, 1400, 1700, 2200, 3100),
}


def deviation_mm(thickness_mm: float, nominal_mm: float) -> float:
    """Return the limit deviation of a size that is cut out of a plate, mm; also of arrays.

    Plates above the table's 100 mm, and sizes above its 4000 mm, have those of its end.

    >>> deviation_mm(3.0, 12.0), deviation_mm(18.0, 24.0)
    (0.2, 0.4)
    """
    sizes = [nominal_mm >= least for least in (3.0, 10.0, 35.0, 125.0, 315.0, 1000.0, 2000.0)]
    rows = [_step(row, sizes) for row in ISO_9013.values()]
    # micrometres are whole numbers, whose sums are exact
    return _step(rows, [thickness_mm > most for most in [*ISO_9013][:-1]]) / 1000.0


def _step(values: Sequence[float], passed: Sequence[bool]) -> float:
    """Return the value after the last step that is passed, of one value or of arrays."""
    steps = zip(values, values[1:], passed, strict=False)
    return values[0] + sum((after - before) * step for before, after, step in steps)
