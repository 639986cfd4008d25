"""Bodies off the axis of a wheel on a carrier, in the dwells: the moment that the lock holds.

The carrier turns at w, and the wheel's axis is L from its own. The body m stands e from the wheel's
axis, at x from the direction of the carrier's axis, positive as the wheel turns. Its centrifugal
force has the moment m e L w² sin x about the wheel's axis, which turns the wheel on. In a dwell
nothing but the lock holds the wheel against it. The formulas for the motion are in ``instant``.
"""

from __future__ import annotations

import numpy as np

from geneva_cli.loads.carried import carried_kg
from geneva_cli.loads.load_case import unbalance_Nm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.jet import Array


def held_unbalance_Nm(mechanism: Mechanism) -> Array:
    """Return the greatest moment of the bodies in a dwell, N m, (m, 1); 0 without any."""
    moment: Array = np.max([np.abs(across) for _, across in _in_dwells(mechanism)], axis=0)
    return moment


def centrifugal_N(mechanism: Mechanism) -> Array:
    """Return the greatest centrifugal force of all bodies on a wheel in a dwell, N, (m, 1)."""
    spec, L = mechanism.spec, mechanism.center_distance_mm / 1000.0
    whole = carried_kg(spec) * omega(spec.drive.n_rpm) ** 2 * L
    each = [np.hypot(whole - towards / L, across / L) for towards, across in _in_dwells(mechanism)]
    force: Array = np.max(each, axis=0)
    return force


def _in_dwells(mechanism: Mechanism) -> list[tuple[Array, Array]]:
    """Return the unbalance times L w² in each dwell, towards the carrier's axis and across."""
    first, ahead = (np.asarray(x, dtype=float) for x in unbalance_Nm(mechanism))
    out = []
    for one in mechanism.under_load.engagements:
        x = np.atleast_2d((one.mid_angle or 0.0) + one.half_step)
        sine, cosine = np.sin(x), np.cos(x)
        out.append((first * cosine - ahead * sine, first * sine + ahead * cosine))
    return out
