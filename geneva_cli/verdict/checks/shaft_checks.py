"""Gaps at shafts and hubs, and the torques that slit hubs hold by friction."""

from __future__ import annotations

from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.outlines.crank_outline import is_whole
from geneva_cli.parts.shafts.held_hubs import clamp_of
from geneva_cli.verdict.checks.check import Check, compared, gap


def crank_shaft(name: str, parts: FlatParts) -> Check | None:
    """The gap between the crank's shaft or hub, whichever is thicker, and the wheel's rim."""
    assembly, size = parts.outlines.assembly, parts.outlines.sizes
    shaft = parts.axle_radius("crank")
    if not shaft:
        return None
    # An internal wheel's horns sweep over the crank's axis, so there is no clearance at all.
    gap_mm = assembly.L - size.rim - shaft if assembly.sign > 0.0 else -shaft
    return compared(name, gap_mm, "at least", 0.0)


def crank_hub(name: str, parts: FlatParts) -> Check | None:
    """The gap between the crank's shaft or hub and the bottom of the locking disc's relief."""
    outlines = parts.outlines
    shaft = parts.axle_radius("crank")
    if not (shaft and outlines.crank and is_whole(outlines.assembly, outlines.sizes)):
        return None
    return compared(name, outlines.relief_depth - shaft, "at least", 0.0)


def wheel_shaft(name: str, parts: FlatParts) -> Check | None:
    """The gap between the wheel's shaft or hub and a roller at the bottom of its slot."""
    size = parts.outlines.sizes
    hub = parts.axle_radius("wheel")
    if not (hub and parts.outlines.assembly.sign > 0.0):
        return None
    return compared(name, size.slot_end - hub, "at least", 0.0)


def passing_parts(name: str, parts: FlatParts) -> Check | None:
    """The gap between hubs or shafts and parts that turn past them, if the spec sets their sizes.

    Default sizes always pass, except for a first wheel's.
    """
    spec = parts.mechanism.spec
    sizes = vars(spec.size)
    keys = (
        "wheel_hub_mm",
        "wheel_hub_length_mm",
        "wheel_shaft_low_mm",
        "wheel_shaft_high_mm",
        "crank_hub_mm",
        "crank_hub_length_mm",
        "crank_shaft_low_mm",
        "crank_shaft_high_mm",
    )
    own = sizes["shafts"] == "turned" or any(sizes[key] is not None for key in keys)
    if not (parts.mechanism.first_wheel or own):
        return None
    from geneva_cli.verdict.shaft_gap import shaft_gap  # which few machines need

    return gap(name, lambda: shaft_gap(parts), parts.outlines.assembly.L)


def passing_gears(name: str, parts: FlatParts) -> Check | None:
    """The gap between shafts and noncircular gears, at their pitch curves' farthest places."""
    if parts.mechanism.spec.gears is None:
        return None
    from geneva_cli.verdict.shaft_gap import gear_gap

    return gap(name, lambda: gear_gap(parts), parts.outlines.assembly.L)


def held_torque(name: str, parts: FlatParts) -> Check | None:
    """The torque that a clamp holds; None without a load, or a clamp that the hub has space for."""
    spec = parts.mechanism.spec
    part = name.partition("_")[0]
    clamp = clamp_of(spec.size, part, *parts.hub_radii(part))
    if clamp is None or not clamp.fits or not spec.is_loaded:
        return None
    from geneva_cli.loads.strength.part_loads import single_loads  # without a load none is needed

    torque = getattr(single_loads(parts.mechanism), f"{part}_Nm")
    return compared(name, clamp.torque_Nm, "at least", spec.shaft.torsion_factor * torque)
