"""Distance of the loads' poles from mid-motion, which is the width of their spread samples."""

from __future__ import annotations

import numpy as np

from geneva_cli.analysis.contact import contact
from geneva_cli.analysis.forces import LoadCase
from geneva_cli.kinematics.engagement import Engagement
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.jet import Array


def spread_deg(engagement: Engagement, case: LoadCase) -> Array:
    """Approximate distance from mid-motion of the nearest pole of velocity and forces, degrees.

    It follows from their behaviour near mid-motion: a velocity as v / (1 + x²/w²), a wall's lever
    as l sqrt(1 + x²/w²). Where friction holds a lever that vanishes there, w is the distance from
    mid-motion at which it no longer does.
    """
    # not at mid-motion itself, where a curved slot may have no slopes
    x = 0.01 * array(engagement.exit_deg)
    _, _, lever, offset, *_ = at = contact(engagement, x, 2, reactions=False, spins=False)
    velocity = at.velocity
    with np.errstate(all="ignore"):
        # arrays, as the quotient of a jet's floats by 0 is an error
        squares = [array(velocity.c[0]) / velocity.c[2], 0.5 * array(lever.c[0]) / lever.c[2]]
        w = np.sqrt(np.fmin(*map(np.abs, squares))) / DEGREE
        if case.rubs:
            grip = np.abs(lever.c[0]) + case.friction * np.abs(offset.c[0])
            w = np.fmin(w, array(grip) / np.abs(lever.c[1]) / DEGREE)
    # ten half motions: samples of a function without poles are not spread
    return np.fmin(np.where(w > 0.0, w, np.inf), 10.0 * engagement.exit_deg)
