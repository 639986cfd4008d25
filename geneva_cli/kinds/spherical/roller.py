"""The roller that suits a machine on a sphere, for a search of machines."""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.spherical.sizes import ball
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.spec.defaults import wall_min
from geneva_cli.study.synth.suiting import LOCK, SIZES, USUAL, with_roller


def ball_roller(mechanism: Mechanism) -> tuple[float, str]:
    """Return the largest usual roller that suits, NaN for the spec's; or the obstacle to parts."""
    L, spec = mechanism.center_distance_mm, mechanism.spec
    least, why = wall_min(spec.size, L), ""
    given = spec.size.roller_radius_mm
    for r in (0.01 * percent * L for percent in USUAL) if given is None else (given,):
        try:
            shells = ball(mechanism._replace(spec=with_roller(spec, r)))
        except GenevaError as error:
            why = LOCK if error.key == ("size", "lock_radius_mm") else SIZES
            continue
        why = LOCK if shells.lock and shells.horn * L < least else ""
        if not why:
            return math.nan if given or r == 0.01 * USUAL[0] * L else r, ""
    return math.nan, why
