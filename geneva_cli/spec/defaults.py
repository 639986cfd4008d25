"""What a spec's values default to: the least wall, a standard's keys, and the materials of parts.

Wheel, arm and locking disc are plates of the process's material, ``[material.wheel]``. Rollers,
pins and shafts are rods, ``[material.roller]``: steel, whatever cuts or prints the plates.
"""

from __future__ import annotations

import math
from itertools import starmap
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.numerics.arrays import N, choose, larger, smaller, value_or
from geneva_cli.spec.workshops import WORKSHOPS, Stock

if TYPE_CHECKING:
    from geneva_cli.motion.machine_spec import Spec
    from geneva_cli.spec.tables import Material, Size


def wall_min(size: Size, L: float) -> float:
    """Return the least wall that ``check`` lets pass, mm; (m, 1) for m designs."""
    return value_or(size.wall_min_mm, larger(L / 200.0, WORKSHOPS[size.process].wall_mm))


def eye_about(hole: N, wall: N, most: float = math.inf) -> N:
    """Return the radius of the arm around a hole, up to ``most`` if that leaves the least wall."""
    # twice the hole, where there is space
    return larger(smaller(2.0 * hole, 0.0 * hole + most), hole + wall)


class ParallelKey(NamedTuple):
    """A parallel key for a range of shaft diameters, all in mm."""

    above: float
    up_to: float
    width: float  # b
    height: float  # h
    in_shaft: float  # t1, the keyway's depth below the shaft's circle
    in_hub: float  # t2, the keyway's height above the shaft's circle


# DIN 6885-1 (ISO/R 773 has the same): parallel keys, deep pattern.
# fmt: off
DIN_6885_1 = [*starmap(ParallelKey, (
    (6, 8, 2, 2, 1.2, 1.0), (8, 10, 3, 3, 1.8, 1.4), (10, 12, 4, 4, 2.5, 1.8),
    (12, 17, 5, 5, 3.0, 2.3), (17, 22, 6, 6, 3.5, 2.8), (22, 30, 8, 7, 4.0, 3.3),
    (30, 38, 10, 8, 5.0, 3.3), (38, 44, 12, 8, 5.0, 3.3), (44, 50, 14, 9, 5.5, 3.8),
    (50, 58, 16, 10, 6.0, 4.3), (58, 65, 18, 11, 7.0, 4.4), (65, 75, 20, 12, 7.5, 4.9),
    (75, 85, 22, 14, 9.0, 5.4), (85, 95, 25, 14, 9.0, 5.4), (95, 110, 28, 16, 10.0, 6.4),
    (110, 130, 32, 18, 11.0, 7.4), (130, 150, 36, 20, 12.0, 8.4), (150, 170, 40, 22, 13.0, 9.4),
    (170, 200, 45, 25, 15.0, 10.4), (200, 230, 50, 28, 17.0, 11.4),
))]
# fmt: on


def key(standard: str | None, radius: float, part: str = "crank") -> ParallelKey | None:
    """Return the key of a part's bore by a standard's name; None for no standard.

    Raises GenevaError for a bore that the table does not have.

    >>> key("DIN 6885-1", 10.0).width
    6
    """
    if standard is None:
        return None
    diameter = 2.0 * radius
    for row in DIN_6885_1:
        if row.above < diameter <= row.up_to:
            return row
    least, most = DIN_6885_1[0].above, DIN_6885_1[-1].up_to
    bore_key = {"crank": "crank_bore_mm or arm_bore_mm", "wheel": "wheel_bore_mm"}[part]
    raise GenevaError(
        f'{part}_keyway = "{standard}": its table lacks the {part}\'s bore of {diameter:g} mm; '
        f"set {bore_key} above {least:g} and up to {most:g}, or remove it",
        ("size", f"{part}_keyway"),
    )


def wheel_material(spec: Spec) -> Stock:
    """Return the material of the wheel, and of all other plates."""
    return _material(spec.material_wheel, WORKSHOPS[spec.size.process].stock)


def roller_material(spec: Spec) -> Stock:
    """Return the material of rollers, pins and shafts, by default steel."""
    return _material(spec.material_roller, Stock())


def _material(own: Material, usual: Stock) -> Stock:
    """Return the values of the spec, and else those of the usual material.

    A part of another stiffness is of another material, which has no default of its strength.
    """
    is_known = own.youngs_modulus_GPa is own.poisson_ratio is own.density_kgm3 is None
    modulus = value_or(own.youngs_modulus_GPa, usual.youngs_modulus_GPa)
    is_usual = modulus == usual.youngs_modulus_GPa
    return Stock(
        own.grade or (usual.grade if is_known else ""),
        modulus,
        value_or(own.poisson_ratio, usual.poisson_ratio),
        value_or(own.density_kgm3, usual.density_kgm3),
        value_or(own.stress_max_MPa, choose(is_usual, usual.allowed_MPa, math.inf)),
    )
