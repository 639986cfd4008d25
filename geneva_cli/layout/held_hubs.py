"""Hubs with what holds them on their shafts: a set screw, or a slit with a clamp screw."""

from __future__ import annotations

from geneva_cli.curves.plates import Plate
from geneva_cli.layout.clamps import clamp_note, with_clamp
from geneva_cli.layout.set_screws import screw_note, with_set_screw
from geneva_cli.spec.tables import Size


def held_hub(size: Size, part: str, hub: Plate | None, direction: float) -> Plate | None:
    """Return the hub of a part, "wheel" or "crank", with its screw's holes in a direction, radians.

    Raises GenevaError, naming the key, for a screw that the hub does not hold.
    """
    return with_set_screw(size, part, with_clamp(size, part, hub, direction), direction)


def hub_note(size: Size, part: str) -> str:
    """Return the sheet's note on what holds a hub on its shaft; "" for nothing."""
    return clamp_note(size, part) or screw_note(size, part)
