"""A spherical machine's sizes and locking sectors together, and the roller that leaves room."""

from __future__ import annotations

import math

from geneva_cli.curves.sphere import Region
from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.roots import boundary
from geneva_cli.parts.sphere.crank import sectors
from geneva_cli.parts.sphere.sizes import Ball, NoRoom, ball

LOOKS = 10  # halvings between a roller that leaves room and one that does not


def fitted(mechanism: Mechanism, advice: bool = True) -> tuple[Ball, list[Region]]:
    """The sizes of a machine on a sphere, and its locking sectors.

    Raises GenevaError, naming the key, where they leave no wheel or no lock; with ``advice`` also
    the largest roller that does, where there is one.
    """
    try:
        return _made(mechanism, mechanism.roller_radius_mm)
    except NoRoom as error:
        if not advice:
            raise
        most = boundary(lambda r: _fits(mechanism, r), 0.0, mechanism.roller_radius_mm, LOOKS)
        if not most:
            raise
        unit = 10.0 ** (math.floor(math.log10(most)) - 1)
        text = f"{error}; a roller of {math.floor(most / unit) * unit:.4g} mm leaves room"
        raise GenevaError(text, error.key) from None


def _fits(mechanism: Mechanism, roller_mm: float) -> bool:
    try:
        _made(mechanism, roller_mm)
    except GenevaError:
        return False
    return True


def _made(mechanism: Mechanism, roller_mm: float) -> tuple[Ball, list[Region]]:
    found = ball(mechanism, roller_mm)
    return found, sectors(found)
