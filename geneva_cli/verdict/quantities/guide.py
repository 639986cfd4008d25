"""The guide of a rack: its length, the force at its ends, and the friction at which it locks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.verdict.quantities.designs import Columns, Designs


def guide(of: Designs) -> Columns:
    """The guides of racks; none for a wheel, and for a rack that has no guide."""
    if not of.spec.guided:
        return {}
    names = "length_mm", "locks_at_friction", "force_N", "at_deg"
    rows = [_guide(one) for one in of.each]
    return dict(zip(names, np.array(rows).T, strict=True))


def _guide(machine: Mechanism) -> tuple[float, float, float, float]:
    """Length, friction that locks, force and its angle; infinite for what a design lacks."""
    from geneva_cli.loads.strength.guide import guide_force, locks_at_friction
    from geneva_cli.outlines.rack import rack_sizes

    try:
        sizes = rack_sizes(machine)
    except GenevaError:  # the check of the horn reports the error
        return (math.inf,) * 4
    force = guide_force(machine) if machine.spec.is_loaded else (math.inf, math.inf)
    return 2.0 * sizes.guide.half, locks_at_friction(machine), *force
