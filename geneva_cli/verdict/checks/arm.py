"""Checks of a crank arm whose keys the spec sets: its walls, and its gap to the wheel's hub."""

from __future__ import annotations

from collections.abc import Callable

from geneva_cli.parts.arm import CrankArm, walls
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check, at_least


def arm_wall(name: str, parts: FlatParts) -> Check | None:
    """The least wall around the arm's holes, and around bolts and keyway in the locking disc."""
    outlines = parts.outlines
    return _arm_check(name, parts, lambda arm: walls(arm, outlines), outlines.sizes.wall_min)


def arm_to_hub(name: str, parts: FlatParts) -> Check | None:
    """The gap between the arm's end, as it passes below the wheel, and the wheel's shaft or hub."""
    inside = parts.outlines.assembly.sign < 0.0  # an internal wheel is open in the middle
    return None if inside else _arm_check(name, parts, lambda arm: arm.hub_gap, 0.0)


def _arm_check(
    name: str, parts: FlatParts, measure: Callable[[CrankArm], float], limit: float
) -> Check | None:
    """The check, if the spec sets a key of the arm: its default dimensions always pass."""
    size = vars(parts.mechanism.spec.size)
    keys = (
        "arm_bore_mm",
        "arm_hub_mm",
        "arm_eye_mm",
        "press_fit_mm",
        "crank_keyway",
        "lock_bolts",
    )
    if not any(size[key] for key in keys):
        return None
    return at_least(name, lambda: measure(parts.arm) if parts.arm else None, limit)
