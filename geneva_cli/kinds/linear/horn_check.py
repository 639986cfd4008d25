"""The check of a rack's horns, which needs no parts: every machine's list of checks names it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from geneva_cli.motion.mechanism import Mechanism
    from geneva_cli.verdict.checks.check import Check


def rack_horn(name: str, mechanism: Mechanism) -> Check | None:
    """The wall between slot and recess of a rack; None for a wheel, and without a lock."""
    if mechanism.output.turns:
        return None
    from geneva_cli.kinds.linear.rack import rack_sizes
    from geneva_cli.spec.least_wall import wall_min
    from geneva_cli.verdict.checks.check import compared

    try:
        sizes = rack_sizes(mechanism)
    except GenevaError:
        return None  # the check of the parts reports the error
    least = wall_min(mechanism.spec.size, mechanism.center_distance_mm)
    return compared(name, sizes.horn, "at least", least) if sizes.lock else None
