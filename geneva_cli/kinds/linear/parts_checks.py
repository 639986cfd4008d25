"""The checks of a rack's parts at rest: shafts that pass it, and what the process cuts."""

from __future__ import annotations

from geneva_cli.kinds.linear.parts import RackParts
from geneva_cli.kinds.linear.shaft_gap import rack_gear_gap, rack_shaft_gap
from geneva_cli.parts.sizes.plain_sizes import drawn_thicknesses
from geneva_cli.verdict.checks.check import Check, gap
from geneva_cli.verdict.checks.process import built, cut_width, plate_thickness


def passing_shafts(name: str, parts: RackParts) -> Check | None:
    """The least gap between shafts and a rack, of a crank's shaft that ends above the arm."""
    if not parts.mechanism.spec.has_parts:
        return None  # without a frame there are no shafts
    return gap(name, lambda: rack_shaft_gap(parts), parts.mechanism.center_distance_mm)


def passing_gears(name: str, parts: RackParts) -> Check | None:
    """The least gap of gears before a rack's crank to its guide and to shafts."""
    return gap(name, lambda: rack_gear_gap(parts), parts.mechanism.center_distance_mm)


def thickest_plate(name: str, parts: RackParts) -> Check | None:
    """The thickest plate of a rack's machine, where the process has a limit.

    Bar, rail and wall of the guide are bars, which may be cut from stock.
    """
    thick = drawn_thicknesses(parts.mechanism.spec.size, parts.sizes.arm)
    return plate_thickness(name, parts.mechanism, max(thick.wheel, thick.lock, thick.arm))


def slot_width(name: str, parts: RackParts) -> Check | None:
    """The width of a rack's slots, where the process cuts none that is narrow for its plate."""
    thick = drawn_thicknesses(parts.mechanism.spec.size, parts.sizes.arm).wheel
    return cut_width(name, parts.mechanism, 2.0 * parts.sizes.half_width, thick)


def plates_built(name: str, parts: RackParts) -> Check | None:
    """The check that fails if a plate of a machine cannot be built; else None."""
    return built(name, parts.require)
