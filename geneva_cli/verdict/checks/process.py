"""Limits of the process that ``[size] process`` names, for plates that it cuts."""

from __future__ import annotations

from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.spec.workshops import workshop
from geneva_cli.verdict.checks.check import Check, compared


def thickest_plate(name: str, parts: FlatParts) -> Check | None:
    """The thickest plate of wheel, disc and arm, where the process has a limit."""
    most, sizes = workshop(parts.mechanism.spec.size.process).plate_mm, parts.outlines.sizes
    if most == float("inf"):
        return None
    thick = max(sizes.wheel_thickness, sizes.lock_thickness, sizes.arm_thickness)
    return compared(name, thick, "at most", most)


def slot_width(name: str, parts: FlatParts) -> Check | None:
    """The slots' width, where the process cuts none that is narrow for its plate."""
    least, sizes = workshop(parts.mechanism.spec.size.process).hole, parts.outlines.sizes
    if not least:
        return None
    return compared(name, 2.0 * sizes.half_width, "at least", least * sizes.wheel_thickness)
