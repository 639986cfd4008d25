"""Crank arm and links: their walls, and their clearance to parts that pass through their planes."""

from __future__ import annotations

from collections.abc import Callable

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.stacks import plate_wall
from geneva_cli.parts.arm import CrankArm, walls
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.links.link_shafts import planes
from geneva_cli.parts.shafts.bores import has_shape
from geneva_cli.verdict.checks.check import Check, at_least, compared


def arm_wall(name: str, parts: FlatParts) -> Check | None:
    """The least wall around the arm's holes, and around bolts and bore of the locking disc."""
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
    size = parts.mechanism.spec.size
    keys = ("arm_bore_mm", "arm_hub_mm", "arm_eye_mm", "press_fit_mm", "lock_bolts")
    if not (has_shape(size, "crank") or any(vars(size)[key] for key in keys)):
        return None
    return at_least(name, lambda: measure(parts.arm) if parts.arm else None, limit)


def links_wall(name: str, parts: FlatParts) -> Check | None:
    """The least wall around the links' holes, if the spec sets one of their keys."""
    size = vars(parts.mechanism.spec.size)
    keys = ("link_pin_mm", "link_bore_mm", "link_width_mm", "press_fit_mm", "pin_mm")
    if not any(size[key] for key in keys):
        return None
    return at_least(
        name,
        lambda: min(map(plate_wall, parts.links.plates), default=None),
        parts.outlines.sizes.wall_min,
    )


def links_gap(name: str, parts: FlatParts) -> Check | None:
    """The gap in a whole turn between links and hub, shaft and pins through their planes."""
    try:
        spacers = parts.spacers if parts.mechanism.spec.drive_before else ()
        clearance = planes(parts.outlines, parts.links, spacers)
    except GenevaError as error:
        return Check(name, None, "at least", 0.0, False, str(error))
    mechanism = parts.mechanism
    if clearance.blocked is not None:
        one = clearance.blocked
        return Check(
            name,
            one.gap,
            "at least",
            0.0,
            False,
            f"{one.passing} meets the {one.link}: it needs an eccentric in a hollow input shaft, "
            "or another path to its bearings",
            mechanism.shown_deg(one.input_deg),
        )
    if clearance.nearest is None:
        return None
    return compared(
        name,
        clearance.nearest.gap,
        "at least",
        0.0,
        mechanism.shown_deg(clearance.nearest.input_deg),
    )
