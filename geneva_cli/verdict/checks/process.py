"""Limits of the process that ``[size] process`` names, for plates that it cuts."""

from __future__ import annotations

from geneva_cli.outlines.outlines import Outlines
from geneva_cli.spec.workshops import workshop
from geneva_cli.verdict.checks.check import Check, compared


def thickest_plate(name: str, outlines: Outlines) -> Check | None:
    """The thickest plate of wheel, disc and arm, where the process has a limit."""
    most, sizes = workshop(outlines.assembly.full.spec.size.process).plate_mm, outlines.sizes
    if most == float("inf"):
        return None
    thick = max(sizes.wheel_thickness, sizes.lock_thickness, sizes.arm_thickness)
    return compared(name, thick, "at most", most)


def slot_width(name: str, outlines: Outlines) -> Check | None:
    """The slots' width, where the process cuts none that is narrow for its plate."""
    least, sizes = workshop(outlines.assembly.full.spec.size.process).hole, outlines.sizes
    if not least:
        return None
    return compared(name, 2.0 * sizes.half_width, "at least", least * sizes.wheel_thickness)
