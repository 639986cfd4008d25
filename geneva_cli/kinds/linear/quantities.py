"""Quantities of the guides of racks."""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.linear.guide import guide_force, locks_at_friction
from geneva_cli.kinds.linear.motion import guided
from geneva_cli.kinds.linear.rack import rack_sizes
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.verdict.quantities.batch_designs import Columns, Designs


def guide(of: Designs) -> Columns:
    """Return the guides of racks; none for a wheel, and for a rack that has no guide."""
    if not guided(of.spec):
        return {}
    names = "length_mm", "locks_at_friction", "force_N", "at_deg"
    rows = [_guide(one) for one in of.each]
    return dict(zip(names, np.array(rows).T, strict=True))


def _guide(machine: Mechanism) -> tuple[float, float, float, float]:
    """Return length, friction that locks, force and its angle; infinite for what a design lacks."""
    try:
        sizes = rack_sizes(machine)
    except GenevaError:  # the check of the horn reports the error
        return (math.inf,) * 4
    force = guide_force(machine) if machine.spec.is_loaded else (math.inf, math.inf)
    return 2.0 * sizes.guide.half, locks_at_friction(machine), *force
