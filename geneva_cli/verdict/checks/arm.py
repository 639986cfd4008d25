"""Checks of the crank arm if its keys are given: its walls, and its gap to the wheel's hub."""

from __future__ import annotations

from collections.abc import Callable

from geneva_cli.parts.arm import CrankArm, crank_arm, has_arm, walls
from geneva_cli.parts.outlines import Outlines
from geneva_cli.verdict.checks.check import Check, at_least

KEYS = (
    "arm_bore_mm",
    "arm_hub_mm",
    "arm_eye_mm",
    "press_fit_mm",
    "crank_keyway",
    "lock_bolts",
)


def arm_wall(name: str, found: Outlines) -> Check | None:
    """The least wall around the arm's holes, and around bolts and keyway in the locking disc."""
    return _asked(name, found, lambda made: walls(made, found), found.sizes.wall_min)


def arm_to_hub(name: str, found: Outlines) -> Check | None:
    """The gap between the arm's end, as it passes below the wheel, and the wheel's shaft or hub."""
    inside = found.assembly.sign < 0.0  # an internal wheel is open in the middle
    return None if inside else _asked(name, found, lambda made: made.hub_gap, 0.0)


def _asked(
    name: str, found: Outlines, value: Callable[[CrankArm], float], limit: float
) -> Check | None:
    """The check if a key of the arm is given: its default dimensions always pass."""
    size = found.assembly.mechanism.spec.size
    if not (any(vars(size)[key] for key in KEYS) and has_arm(found)):
        return None
    return at_least(name, lambda: value(crank_arm(found)), limit)
