"""Set screws through hubs, onto the shaft.

Their radial holes are in the sheet and the list of parts. Plates have no holes across their axis,
so solids and meshes lack them.
"""

from __future__ import annotations

from geneva_cli.curves.plates import Plate
from geneva_cli.errors import GenevaError
from geneva_cli.layout.bores import around
from geneva_cli.spec.tables import Size


def require_thread(size: Size, part: str, hub: Plate | None) -> None:
    """Raise GenevaError, naming the key, for a set screw that the hub of a part does not hold.

    The thread is at least one diameter long, and the hub two diameters, so that half a diameter is
    left on each side.
    """
    screw: float | None = vars(size)[f"{part}_screw_mm"]
    if screw is None:
        return
    if hub is None or not hub.holes:
        raise GenevaError(
            f"{part}_screw_mm: a set screw needs a hub with a bore; set {part}_hub_mm and "
            f"{part}_bore_mm, or remove it",
            ("size", f"{part}_screw_mm"),
        )
    wall = around(hub.outline) - max(around(hole) for hole in hub.holes)
    most = min(wall, 0.5 * hub.thickness)
    if screw > most:
        raise GenevaError(
            f"{part}_screw_mm = {screw:g}: the hub is {hub.thickness:.6g} mm long and its wall "
            f"{wall:.6g} mm thick, which holds a set screw up to {most:.6g}",
            ("size", f"{part}_screw_mm"),
        )


def screw_note(size: Size, part: str) -> str:
    """Return the sheet's note on a set screw; "" without one.

    >>> screw_note(Size(wheel_screw_mm=4.0, wheel_bore="D"), "wheel")
    'set screw M4 (ISO 4026), radial, onto the flat'
    """
    values = vars(size)
    screw, shape = values[f"{part}_screw_mm"], values[f"{part}_bore"]
    if screw is None:
        return ""
    onto = "the flat" if shape == "D" else "the shaft"
    return f"set screw M{screw:g} (ISO 4026), radial, onto {onto}"
