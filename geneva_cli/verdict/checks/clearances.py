"""Gaps at shafts, hubs, arm and links; what the process can cut."""

from __future__ import annotations

import math
from collections.abc import Callable

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import plate_wall
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.arm import CrankArm, walls
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.links.link_shafts import planes
from geneva_cli.parts.outlines.crank_outline import is_whole
from geneva_cli.parts.parts import EdgedParts
from geneva_cli.parts.shafts.bores import has_shape
from geneva_cli.spec.workshops import workshop
from geneva_cli.verdict.checks.check import Check, at_least, compared, gap, refused


def crank_shaft(name: str, parts: FlatParts) -> Check | None:
    """The gap between the crank's shaft or hub, whichever is thicker, and the wheel's rim."""
    assembly, shaft = parts.outlines.assembly, parts.axle_radius("crank")
    if not shaft:
        return None
    # An internal wheel's horns sweep over the crank's axis, so there is no clearance at all.
    rim = parts.outlines.sizes.rim
    gap_mm = assembly.L - rim - shaft if assembly.sign > 0.0 else -shaft
    return compared(name, gap_mm, "at least", 0.0)


def crank_hub(name: str, parts: FlatParts) -> Check | None:
    """The gap between the crank's shaft or hub and the bottom of the locking disc's relief."""
    outlines, shaft = parts.outlines, parts.axle_radius("crank")
    if not (shaft and outlines.crank and is_whole(outlines.assembly, outlines.sizes)):
        return None
    return compared(name, outlines.relief_depth - shaft, "at least", 0.0)


def wheel_shaft(name: str, parts: FlatParts) -> Check | None:
    """The gap between the wheel's shaft or hub and a roller at the bottom of its slot."""
    hub = parts.axle_radius("wheel")
    if not (hub and parts.outlines.assembly.sign > 0.0):
        return None
    return compared(name, parts.outlines.sizes.slot_end - hub, "at least", 0.0)


def passing_parts(name: str, parts: FlatParts) -> Check | None:
    """The gap between hubs or shafts and parts that turn past them, if the spec sets their sizes.

    Default sizes always pass, except for a first wheel's.
    """
    size = vars(parts.mechanism.spec.size)
    keys = [
        f"{part}_{key}_mm"
        for part in ("wheel", "crank")
        for key in ("hub", "hub_length", "shaft_low", "shaft_high")
    ]
    own = any(size[key] is not None for key in keys)
    if not (parts.mechanism.first_wheel or own):
        return None
    from geneva_cli.verdict.shaft_gap import shaft_gaps  # which few machines need

    return gap(name, lambda: shaft_gaps(parts), parts.outlines.assembly.L)


def passing_gears(name: str, parts: FlatParts) -> Check | None:
    """The gap between shafts and noncircular gears, at their pitch curves' farthest places."""
    if parts.mechanism.spec.gears is None:
        return None
    from geneva_cli.verdict.shaft_gap import gear_gaps

    return gap(name, lambda: gear_gaps(parts), parts.outlines.assembly.L)


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
    wall_min = parts.outlines.sizes.wall_min
    return at_least(name, lambda: min(map(plate_wall, parts.links.plates), default=None), wall_min)


def links_gap(name: str, parts: FlatParts) -> Check | None:
    """The gap in a whole turn between links and hub, shaft and pins through their planes."""
    mechanism = parts.mechanism
    try:
        spacers = parts.spacers if mechanism.spec.drive_before else ()
        near, blocked = planes(parts.outlines, parts.links, spacers)
    except GenevaError as error:
        return Check(name, None, "at least", 0.0, False, str(error))
    if blocked:
        at_deg = mechanism.shown_deg(blocked.input_deg)
        why = (
            f"{blocked.passing} meets the {blocked.link}: it needs an eccentric in a hollow input "
            "shaft, or another path to its bearings"
        )
        return Check(name, blocked.gap, "at least", 0.0, False, why, at_deg)
    if near:
        return compared(name, near.gap, "at least", 0.0, mechanism.shown_deg(near.input_deg))
    return None


def thickest_plate(name: str, parts: FlatParts) -> Check | None:
    """The thickest plate of wheel, disc and arm, where the process has a limit."""
    sizes = parts.outlines.sizes
    thick = max(sizes.wheel_thickness, sizes.lock_thickness, sizes.arm_thickness)
    return plate_thickness(name, parts.mechanism, thick)


def slot_width(name: str, parts: FlatParts) -> Check | None:
    """The slots' width, where the process cuts none that is narrow for its plate."""
    sizes = parts.outlines.sizes
    return cut_width(name, parts.mechanism, 2.0 * sizes.half_width, sizes.wheel_thickness)


def plate_thickness(name: str, mechanism: Mechanism, thick: float) -> Check | None:
    """A thickness, where the process has a limit."""
    most = workshop(mechanism.spec.size.process).plate_mm
    return None if most == math.inf else compared(name, thick, "at most", most)


def cut_width(name: str, mechanism: Mechanism, wide: float, thick: float) -> Check | None:
    """A width, where the process cuts none that is narrow for its plate."""
    least = workshop(mechanism.spec.size.process).hole
    return compared(name, wide, "at least", least * thick) if least else None


def plates_built(name: str, parts: EdgedParts) -> Check | None:
    """The check that fails if a plate of a machine cannot be built; else None."""
    return built(name, lambda: parts.required)


def built(name: str, build: Callable[[], object]) -> Check | None:
    """The check that fails if something cannot be built; else None."""
    try:
        build()
    except GenevaError as error:
        return refused(name, error)
    return None
