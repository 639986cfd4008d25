"""Parallel keys, by a standard's table of the shaft's diameter."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.errors import GenevaError


class ParallelKey(NamedTuple):
    """A parallel key for a range of shaft diameters, all in mm."""

    above: float
    up_to: float
    width: float  # b
    height: float  # h
    in_shaft: float  # t1, the keyway's depth below the shaft's circle
    in_hub: float  # t2, the keyway's height above the shaft's circle


# DIN 6885-1 (ISO/R 773 has the same): parallel keys, deep pattern.
DIN_6885_1 = [
    ParallelKey(*row)
    for row in (
        (6, 8, 2, 2, 1.2, 1.0),
        (8, 10, 3, 3, 1.8, 1.4),
        (10, 12, 4, 4, 2.5, 1.8),
        (12, 17, 5, 5, 3.0, 2.3),
        (17, 22, 6, 6, 3.5, 2.8),
        (22, 30, 8, 7, 4.0, 3.3),
        (30, 38, 10, 8, 5.0, 3.3),
        (38, 44, 12, 8, 5.0, 3.3),
        (44, 50, 14, 9, 5.5, 3.8),
        (50, 58, 16, 10, 6.0, 4.3),
        (58, 65, 18, 11, 7.0, 4.4),
        (65, 75, 20, 12, 7.5, 4.9),
        (75, 85, 22, 14, 9.0, 5.4),
        (85, 95, 25, 14, 9.0, 5.4),
        (95, 110, 28, 16, 10.0, 6.4),
        (110, 130, 32, 18, 11.0, 7.4),
        (130, 150, 36, 20, 12.0, 8.4),
        (150, 170, 40, 22, 13.0, 9.4),
        (170, 200, 45, 25, 15.0, 10.4),
        (200, 230, 50, 28, 17.0, 11.4),
    )
]
TABLES = {"DIN 6885-1": DIN_6885_1}


def key(standard: str | None, radius: float, part: str = "crank") -> ParallelKey | None:
    """Return the key of a part's bore by a standard's name; None for no standard.

    Raises GenevaError for a bore that the table does not have.

    >>> key("DIN 6885-1", 10.0).width
    6
    """
    if standard is None:
        return None
    table, diameter = TABLES[standard], 2.0 * radius
    for row in table:
        if row.above < diameter <= row.up_to:
            return row
    bore_key = {"crank": "crank_bore_mm or arm_bore_mm", "wheel": "wheel_bore_mm"}[part]
    raise GenevaError(
        f'{part}_keyway = "{standard}": its table lacks the {part}\'s bore of {diameter:g} mm; '
        f"set {bore_key} above {table[0].above:g} and up to {table[-1].up_to:g}, or remove it",
        ("size", f"{part}_keyway"),
    )
