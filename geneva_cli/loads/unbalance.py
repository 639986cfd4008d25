"""Bodies off the axis of a wheel on a carrier, in the dwells: the moment that the lock holds.

The carrier turns at w, and the wheel's axis is L from its own. The body m stands e from the wheel's
axis, at x from the direction of the carrier's axis, positive as the wheel turns. Its centrifugal
force has the moment m e L w² sin x about the wheel's axis, which turns the wheel on. In a dwell
nothing but the lock holds the wheel against it. The formulas for the motion are in ``forces``.
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
    _, across = _in_dwells(mechanism)
    out: Array = np.max(np.abs(across), axis=0)
    return out


def centrifugal_N(mechanism: Mechanism) -> Array:
    """Return the greatest centrifugal force of all bodies on a wheel in a dwell, N, (m, 1)."""
    spec, L = mechanism.spec, mechanism.center_distance_mm / 1000.0
    towards, across = _in_dwells(mechanism)
    out = carried_kg(spec) * omega(spec.drive.n_rpm) ** 2 * L - towards / L
    force: Array = np.max(np.hypot(out, across / L), axis=0)
    return force


def _in_dwells(mechanism: Mechanism) -> tuple[Array, Array]:
    """Return the unbalance times L w² in each dwell, towards the carrier's axis and across."""
    first, ahead = (np.asarray(x, dtype=float) for x in unbalance_Nm(mechanism))
    each = []
    for one in mechanism.under_load.engagements:
        x = np.atleast_2d((one.mid_angle or 0.0) + one.half_step)
        sine, cosine = np.sin(x), np.cos(x)
        each.append((first * cosine - ahead * sine, first * sine + ahead * cosine))
    towards, across = zip(*each, strict=True)
    return np.stack(np.broadcast_arrays(*towards)), np.stack(np.broadcast_arrays(*across))
