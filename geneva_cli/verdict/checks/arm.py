"""Checks of a crank arm whose keys the spec sets: its walls, and its gap to the wheel's hub."""

from __future__ import annotations

from collections.abc import Callable

from geneva_cli.layout.bores import has_shape
from geneva_cli.outlines.outlines import Outlines
from geneva_cli.parts.arm import CrankArm, crank_arm, has_arm, walls
from geneva_cli.verdict.checks.check import Check, at_least


def arm_wall(name: str, outlines: Outlines) -> Check | None:
    """The least wall around the arm's holes, and around bolts and bore of the locking disc."""
    return _arm_check(name, outlines, lambda arm: walls(arm, outlines), outlines.sizes.wall_min)


def arm_to_hub(name: str, outlines: Outlines) -> Check | None:
    """The gap between the arm's end, as it passes below the wheel, and the wheel's shaft or hub."""
    inside = outlines.assembly.sign < 0.0  # an internal wheel is open in the middle
    return None if inside else _arm_check(name, outlines, lambda arm: arm.hub_gap, 0.0)


def _arm_check(
    name: str, outlines: Outlines, value: Callable[[CrankArm], float], limit: float
) -> Check | None:
    """The check, if the spec sets a key of the arm: its default dimensions always pass."""
    size = outlines.assembly.mechanism.spec.size
    keys = (
        "arm_bore_mm",
        "arm_hub_mm",
        "arm_eye_mm",
        "press_fit_mm",
        "lock_bolts",
    )
    own = has_shape(size, "crank") or any(vars(size)[key] for key in keys)
    if not (own and has_arm(outlines)):
        return None
    return at_least(name, lambda: value(crank_arm(outlines)), limit)
