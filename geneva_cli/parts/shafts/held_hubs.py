"""Hubs with what holds them on their shafts: radial set screws, or a slit with a clamp screw."""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.cross_holes import CrossHole, drilled
from geneva_cli.geometry.plates import Plate
from geneva_cli.parts.shafts.bores import around
from geneva_cli.parts.shafts.clamps import clamp_note, with_clamp
from geneva_cli.parts.shafts.screws import SCREWS, change_for_hub, screw
from geneva_cli.spec.tables import Size


def held_hub(size: Size, part: str, hub: Plate | None, direction: float) -> Plate | None:
    """Return the hub of a part, "wheel" or "crank", with its screw's holes in a direction, radians.

    Raises GenevaError, naming the key, for a screw that the hub does not hold.
    """
    return _with_set_screw(size, part, with_clamp(size, part, hub, direction), direction)


def hub_note(size: Size, part: str) -> str:
    """Return the sheet's note on what holds a hub on its shaft; "" for nothing."""
    return clamp_note(size, part) or _screw_note(size, part)


def _with_set_screw(size: Size, part: str, hub: Plate | None, direction: float) -> Plate | None:
    """Return the hub of a part with the hole of its set screw, if the spec has one.

    The hole is for the thread to be cut, amid the hub's length, and reaches the bore at its flat or
    side in ``direction``, or a quarter of a turn from its keyway. The thread is at least one
    diameter long, and the hub two diameters, so that half a diameter is left on each side. Raises
    GenevaError, naming the key, for a set screw that the hub does not hold.
    """
    key = f"{part}_screw_mm"
    thread: float | None = vars(size)[key]
    if thread is None:
        return hub
    if hub is None or not hub.holes:
        raise GenevaError(
            f"{key}: a set screw needs a hub with a bore; {change_for_hub(size, part)}, or leave "
            f"out {key}",
            ("size", key),
        )
    core = screw(key, thread).core
    inner, outer = max(around(hole) for hole in hub.holes), around(hub.outline)
    wall = outer - inner
    most = min(wall, 0.5 * hub.thickness)
    if thread > most:
        fitting = [one.thread for one in SCREWS if one.thread <= most]
        held = f"up to {fitting[-1]:g}" if fitting else "of no size: the hub must be larger"
        raise GenevaError(
            f"{key} = {thread:g}: the hub is {hub.thickness:.6g} mm long and its wall {wall:.6g} "
            f"mm thick, which holds a set screw {held}",
            ("size", key),
        )
    turn = direction + (0.5 * math.pi if vars(size)[f"{part}_keyway"] else 0.0)
    amid = 0.5 * (inner + outer)
    at = amid * math.cos(turn), amid * math.sin(turn)
    hole = CrossHole(at, turn, 0.5 * (hub.low + hub.high), 0.5 * core)
    try:
        hole.openings(drilled((hub.outline, *hub.holes), [hole]))
    except GenevaError:
        raise GenevaError(
            f"{key} = {thread:g}: its hole of {core:.6g} mm is too wide for the bore, or for its "
            "flat, side or keyway; use a smaller screw or a wider bore",
            ("size", key),
        ) from None
    return hub._replace(cross=(hole,))


def _screw_note(size: Size, part: str) -> str:
    """Return the sheet's note on a set screw; "" without one.

    >>> _screw_note(Size(wheel_screw_mm=4.0, wheel_bore="D"), "wheel")
    'set screw M4 (ISO 4026), radial, onto the flat'
    """
    values = vars(size)
    thread, shape = values[f"{part}_screw_mm"], values[f"{part}_bore"]
    if thread is None:
        return ""
    onto = "the flat" if shape == "D" else "the shaft"
    return f"set screw M{thread:g} (ISO 4026), radial, onto {onto}"
