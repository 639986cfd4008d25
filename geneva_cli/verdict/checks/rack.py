"""Checks of a rack and its locking sector."""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.layout.plain_sizes import wall_min
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared, refused


def rack_horn(name: str, mechanism: Mechanism) -> Check | None:
    """The wall between slot and recess of a rack; None for a wheel, and without a lock."""
    if mechanism.output.turns:
        return None
    from geneva_cli.outlines.rack import rack_sizes

    try:
        sizes = rack_sizes(mechanism)
    except GenevaError as error:
        return refused(name, error)
    if not sizes.lock:
        return None
    least = wall_min(mechanism.spec.size, mechanism.center_distance_mm)
    return compared(name, sizes.horn, "at least", least)


def rack_gap(name: str, mechanism: Mechanism) -> Check | None:
    """The smallest gap between rack and crank in a turn, mm, negative where they overlap."""
    if mechanism.output.turns:
        return None
    from geneva_cli.outlines.rack import rack_sizes, smallest_gap

    try:
        gap = smallest_gap(rack_sizes(mechanism))
    except GenevaError:
        return None  # the check of the horn reports the error
    touch = 2e-6 * mechanism.center_distance_mm  # parts that overlap by less count as touching
    value = 0.0 if abs(gap.mm) <= touch else gap.mm
    at_deg = mechanism.shown_deg(mechanism.spec.input_deg(gap.crank_deg))
    return compared(name, value, "at least", 0.0, at_deg, touch)
