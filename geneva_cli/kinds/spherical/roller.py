"""The roller that suits a machine on a sphere, for a search of machines."""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.spherical.sizes import ball
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.study.synth.fast_parts import (
    LOCK,
    SIZES,
    largest,
    radii_from,
    radius_mm,
    with_roller,
)


def ball_roller(mechanism: Mechanism) -> tuple[float | None, str]:
    """Return the radius of the roller that suits a machine, and the obstacle to its parts."""
    L, spec = mechanism.center_distance_mm, mechanism.spec
    size = spec.size
    least = wall_min(size, L) / L

    def obstacle(percent: float) -> str:
        try:
            shells = ball(mechanism._replace(spec=with_roller(spec, 0.01 * percent * L)))
        except GenevaError as error:
            return LOCK if error.key == ("size", "lock_radius_mm") else SIZES
        return (
            LOCK if shells.lock and shells.arm - shells.half_width - shells.recess < least else ""
        )

    if size.roller_radius_mm is not None:
        return None, obstacle(100.0 * size.roller_radius_mm / L)
    percent, why = largest(radii_from(0.0), obstacle)
    return radius_mm(percent, L), why
