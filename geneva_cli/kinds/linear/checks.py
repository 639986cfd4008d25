"""The checks of a rack's horns and guide."""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.spec.default_sizes import value_or
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.verdict.checks.check import Check, compared


def rack_horn(name: str, mechanism: Mechanism) -> Check | None:
    """The wall between slot and recess of a rack; None for a wheel, and without a lock."""
    if mechanism.output.turns:
        return None
    from geneva_cli.kinds.linear.rack import rack_sizes

    try:
        sizes = rack_sizes(mechanism)
    except GenevaError:
        return None  # the check of the parts reports the error
    if not sizes.lock:
        return None
    least = wall_min(mechanism.spec.size, mechanism.center_distance_mm)
    return compared(name, sizes.horn, "at least", least)


def guide_locks(name: str, mechanism: Mechanism) -> Check | None:
    """The friction from which a rack's guide locks, above that of the guide."""
    load = mechanism.spec.load
    friction = value_or(load.guide_friction, load.friction)
    if mechanism.output.turns or not friction:
        return None
    from geneva_cli.verdict.strength import strength

    value = strength(mechanism)["guide.locks_at_friction"]
    return compared(name, value, "at least", friction) if value else None
