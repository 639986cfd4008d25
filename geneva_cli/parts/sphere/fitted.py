"""The sizes and locking sectors of a spherical machine, and the largest roller that fits."""

from __future__ import annotations

import math

from geneva_cli.curves.sphere import Region
from geneva_cli.errors import GenevaError
from geneva_cli.layout.ball import Ball
from geneva_cli.layout.sphere_sizes import PartDoesNotFit, ball
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.roots import boundary
from geneva_cli.numerics.rounding import to_digits
from geneva_cli.parts.sphere.crank import sectors


def fitted(mechanism: Mechanism, advice: bool = True) -> tuple[Ball, list[Region]]:
    """Return the sizes of a spherical machine, and its locking sectors.

    Raises GenevaError, naming the key, where they leave no wheel or no lock. With ``advice`` the
    message names the largest roller that fits, if there is one.
    """
    try:
        return _sizes_and_sectors(mechanism, mechanism.roller_radius_mm)
    except PartDoesNotFit as error:
        if not advice:
            raise
        # 10 halvings give the two digits that are shown
        most = boundary(lambda r: _fits(mechanism, r), 0.0, mechanism.roller_radius_mm, 10)
        if not most:
            raise
        text = f"{error}; a roller of {to_digits(most, 2, math.floor):g} mm fits"
        raise GenevaError(text, error.key) from None


def _fits(mechanism: Mechanism, roller_mm: float) -> bool:
    try:
        _sizes_and_sectors(mechanism, roller_mm)
    except GenevaError:
        return False
    return True


def _sizes_and_sectors(mechanism: Mechanism, roller_mm: float) -> tuple[Ball, list[Region]]:
    sizes = ball(mechanism, roller_mm)
    return sizes, sectors(sizes)
