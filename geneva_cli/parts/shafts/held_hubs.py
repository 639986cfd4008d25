"""Hubs with what holds them on their shafts: a slit with a clamp screw, or radial set screws.

A clamp's screw and head are in a notch within the hub's circle, whose face is as far from the slit
as the thread is wide. The other jaw has the thread. Friction holds the shaft.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import turned
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.round_holes import CrossHole, drilled
from geneva_cli.geometry.shapes import ORIGIN, Circle, Contour, Line, about, closed
from geneva_cli.parts.shafts.bores import around
from geneva_cli.parts.shafts.screws import SCREWS, Screw, screw
from geneva_cli.spec.tables import Size
from geneva_cli.spec.written import length


class Clamp(NamedTuple):
    """A screw in a slit hub with a round bore; radii in mm."""

    screw: Screw
    bore: float
    hub: float

    @property
    def slit(self) -> float:
        """Width of the slit: a quarter of the thread, as wide as a saw."""
        return 0.25 * self.screw.thread

    @property
    def face(self) -> float:
        """Distance of the notch's face, under the screw's head, from the slit's middle."""
        return 0.5 * self.slit + self.screw.thread

    @property
    def axis(self) -> float:
        """Distance of the screw's axis from the shaft's; the head ends in the hub's circle."""
        top = self.face + self.screw.thread  # a head is as high as its thread is wide (ISO 4762)
        return math.sqrt(max(self.hub**2 - top * top, 0.0)) - 0.5 * self.screw.head

    @property
    def shoulder(self) -> float:
        """Distance of the notch's shoulder from the shaft's axis, along the slit."""
        return self.axis - 0.5 * self.screw.head

    @property
    def wall(self) -> float:
        """Least wall: from the bore to the screw's hole and the notch's corner, or around both."""
        return min(
            self.axis - 0.5 * self.screw.through - self.bore,
            math.hypot(max(self.shoulder, 0.0), self.face) - self.bore,
        )

    @property
    def is_narrow(self) -> bool:
        """True if the slit is narrower than the bore."""
        return self.slit < 2.0 * self.bore

    @property
    def fits(self) -> bool:
        """True if the slit is narrow, half of the thread a wall, and its whole width screwed in."""
        far = self.axis + 0.5 * self.screw.core
        screwed_in = math.sqrt(max(self.hub**2 - far * far, 0.0)) - 0.5 * self.slit
        walled = self.wall >= 0.5 * self.screw.thread
        return self.is_narrow and walled and screwed_in >= self.screw.thread

    @property
    def force_N(self) -> float:
        """Tension of the tightened screw: 0.7 of the yield strength of class 8.8 (ISO 898-1)."""
        return 0.7 * 640.0 * self.screw.stressed_mm2

    @property
    def torque_Nm(self) -> float:
        """Torque that friction holds, of steel on steel without oil: 0.12.

        Each half of the hub turns about its middle opposite the slit, at a distance p from the
        axis. Screw and shaft keep it in balance: F (axis + p) = N p. The shaft rubs at both halves.
        """
        p = 0.5 * (self.bore + self.hub)
        normal = self.force_N * (self.axis + p) / p
        return 2.0 * 0.12 * normal * self.bore * 1e-3

    @property
    def outline(self) -> Contour:
        """The hub's contour with its bore, slit along x and the notch above it."""
        h, f, at = 0.5 * self.slit, self.face, self.shoulder
        inner, outer = (math.sqrt(r * r - h * h) for r in (self.bore, self.hub))
        edge, top = (math.sqrt(self.hub**2 - v * v) for v in (f, at))
        first, notch = (math.asin(v / self.hub) for v in (h, f))
        start = math.atan2(top, at)
        narrow = math.asin(h / self.bore)
        around = about(ORIGIN, self.hub, start, math.pi - start)
        back = about(ORIGIN, self.bore, -narrow, narrow - math.pi)
        return closed(
            "HUB",
            [
                Line((inner, h), (outer, h)),
                about(ORIGIN, self.hub, first, notch - first),
                Line((edge, f), (at, f)),
                Line((at, f), (at, top)),
                around,
                about(ORIGIN, self.hub, math.pi, math.pi - first),
                Line((outer, -h), (inner, -h)),
                back,
                about(ORIGIN, self.bore, -math.pi, narrow - math.pi),
            ],
        )


def clamp_of(size: Size, part: str, bore: float, hub: float) -> Clamp | None:
    """Return the clamp of a part, "wheel" or "crank", with radii of bore and hub; None for none."""
    thread: float | None = vars(size)[f"{part}_clamp_mm"]
    return None if thread is None else Clamp(screw(f"{part}_clamp_mm", thread), bore, hub)


def held_hub(size: Size, part: str, hub: Plate | None, direction: float) -> Plate | None:
    """Return the hub of a part, "wheel" or "crank", with its screw's holes in a direction, radians.

    Raises GenevaError, naming the key, for a screw that the hub does not hold, and for a shaft that
    is held in two ways.
    """
    values = vars(size)
    key, other = f"{part}_clamp_mm", f"{part}_screw_mm"
    if values[key] is None:
        return hub if values[other] is None else _with_set_screw(size, part, hub, direction)
    bore = hub.holes[0] if hub and hub.holes else None
    if hub is None or not isinstance(bore, Circle) or not isinstance(hub.outline, Circle):
        shape = f"{part}_keyway" if values[f"{part}_keyway"] else f"{part}_bore"
        change = f"remove {shape}" if bore else _change_for_hub(size, part)
        raise GenevaError(
            f"{key}: a clamp needs a hub with a round bore; {change}, or leave out {key}",
            ("size", key),
        )
    if values[other] is not None:
        raise GenevaError(
            f"{other}: the clamp holds the shaft; remove one of {key} and {other}", ("size", other)
        )
    clamp = Clamp(screw(key, values[key]), bore.radius, hub.outline.radius)
    if not clamp.fits or hub.thickness < clamp.screw.head:
        fitting = [
            s.thread for s in SCREWS if clamp._replace(screw=s).fits and hub.thickness >= s.head
        ]
        small = "hub" if clamp._replace(screw=SCREWS[0]).is_narrow else "bore"
        most = f"up to {fitting[-1]:g}" if fitting else f"of no size: the {small} must be larger"
        raise GenevaError(
            f"{key} = {values[key]:g}: the hub, {2.0 * hub.outline.radius:.6g} mm in diameter and "
            f"{hub.thickness:.6g} mm long, holds a clamp screw {most}",
            ("size", key),
        )
    middle, across = 0.5 * (hub.low + hub.high), direction + 0.5 * math.pi
    c, s = math.cos(direction), math.sin(direction)
    holes = []
    for y, diameter in ((clamp.screw.thread, clamp.screw.through), (-clamp.slit, clamp.screw.core)):
        at = c * clamp.axis - s * y, s * clamp.axis + c * y
        holes.append(CrossHole(at, across, middle, 0.5 * diameter))
    return hub._replace(outline=turned(clamp.outline, direction), holes=(), cross=tuple(holes))


def _with_set_screw(size: Size, part: str, hub: Plate | None, direction: float) -> Plate:
    """Return the hub of a part with the hole of its set screw."""
    key = f"{part}_screw_mm"
    thread: float = vars(size)[key]
    if hub is None or not hub.holes:
        raise GenevaError(
            f"{key}: a set screw needs a hub with a bore; {_change_for_hub(size, part)}, or leave "
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


def _change_for_hub(size: Size, part: str) -> str:
    """Return the change of the spec that gives a part, "wheel" or "crank", a hub with a bore."""
    values = vars(size)
    hub, bore, length = (f"{part}_{name}_mm" for name in ("hub", "bore", "hub_length"))
    missing = [hub] if values[hub] is None and values[length] is None else []
    missing += [] if values[bore] else [bore]
    if missing:
        return f"set {' and '.join(missing)}"
    if values[hub] is not None and values[hub] <= values[bore]:
        return f"set {hub} above {bore}"
    return f"set a greater {length}"  # the hub does not reach past what it stands on


def hub_note(size: Size, part: str) -> str:
    """Return the sheet's note on what holds a hub on its shaft; "" for nothing.

    >>> hub_note(Size(wheel_clamp_mm=5.0), "wheel")
    'slit 1.25, clamp screw M5-8.8 (ISO 4762); fixed opposite the slit only'
    >>> hub_note(Size(wheel_screw_mm=4.0, wheel_bore="D"), "wheel")
    'set screw M4 (ISO 4026), radial, onto the flat'
    """
    values = vars(size)
    thread: float | None = values[f"{part}_screw_mm"]
    if clamp := clamp_of(size, part, 0.0, 0.0):
        return (
            f"slit {length(clamp.slit)}, clamp screw M{clamp.screw.thread:g}-8.8 (ISO 4762); "
            "fixed opposite the slit only"
        )
    if thread is None:
        return ""
    onto = "the flat" if values[f"{part}_bore"] == "D" else "the shaft"
    return f"set screw M{thread:g} (ISO 4026), radial, onto {onto}"
