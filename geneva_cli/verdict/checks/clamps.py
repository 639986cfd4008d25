"""The torques that slit hubs hold by friction, against those of the load."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.layout.clamps import clamp_of
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check, compared

if TYPE_CHECKING:
    from geneva_cli.parts.sphere.sphere_parts import SphereParts


def held_torque(name: str, parts: FlatParts | SphereParts) -> Check | None:
    """The torque that a clamp holds; None without a clamp or without a load."""
    spec = parts.mechanism.spec
    part = name.partition("_")[0]
    clamp = clamp_of(spec.size, part, *parts.hub_radii(part))
    if clamp is None or not spec.is_loaded:
        return None
    from geneva_cli.loads.strength.part_loads import single_loads  # without a load none is needed

    torque = getattr(single_loads(parts.mechanism), f"{part}_Nm")
    return compared(name, clamp.torque_Nm, "at least", spec.shaft.torsion_factor * torque)
