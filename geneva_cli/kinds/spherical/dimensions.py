"""The dimensions of a spherical machine: radii of its shells, and angles to make them by."""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.geometry.sphere_arcs import RoundHole
from geneva_cli.kinds.spherical.arm import dial_holes
from geneva_cli.kinds.spherical.drawings import crank_cone, wheel_cone
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Dimension
from geneva_cli.parts.projection import Missing, or_missing
from geneva_cli.table import Table, rows_table


def dimensions(parts: SphereParts) -> Iterator[Dimension | Missing]:
    """Yield the dimensions of the parts; for those that cannot be built, the reason."""
    return or_missing("dimensions of the shells", lambda: _dimensions(parts))


def _dimensions(parts: SphereParts) -> Iterator[Dimension | Missing]:
    ball, size = parts.ball, parts.mechanism.spec.size
    inner, outer = ball.span_mm
    yield from _lengths({"shells' inner radius": inner, "shells' outer radius": outer})
    yield from _angles(
        {
            "roller's cone, half angle": ball.roller,
            "slot, between its walls": 2.0 * ball.half_width,
            "slot's last round, from the wheel's axis": ball.bottom,
            "rim, from the wheel's axis": ball.rim,
            "slotted ring's inner edge, from its axis": ball.inner,
        }
    )
    yield from _axle("wheel", ball.bore_mm, ball.hub_mm)
    yield from or_missing("dial's bolts", lambda: _bolts("dial's bolt", dial_holes(size, ball)))
    if ball.lock:
        edges = {"lock": ball.lock, "recess": ball.recess}
        yield from _angles({f"{name}, from the crank's axis": at for name, at in edges.items()})
        yield Dimension("locking sectors' inner radius", ball.lock_span_mm[0], "mm")
    for k, region in enumerate(parts.shells.crank, 1):
        rim, _, low, _ = region.boundary
        start = math.atan2(rim.start[1], rim.start[0]) % math.tau
        named = {"inner edge": math.pi - low.angle, "begins": start, "width": rim.sweep}
        yield from _angles({f"locking sector {k}: {name}": at for name, at in named.items()})
    yield from or_missing("arm's dimensions", lambda: _arm(parts))
    for whose, cone in (("wheel", wheel_cone(ball)), ("crank", crank_cone(ball))):
        flat = f"{whose} laid flat"
        yield from _angles({f"{flat}: cone touches the sphere at": cone.polar})
        yield Dimension(f"{flat}: from there to its apex", abs(cone.apex_mm), "mm")
        yield Dimension(f"{flat}: sector", cone.sector_deg, "deg")


def _arm(parts: SphereParts) -> Iterator[Dimension]:
    arm, ball = parts.arm, parts.ball
    if arm is None:
        return
    inner, outer = ball.arm_span_mm
    yield from _lengths({"arm's inner radius": inner, "arm's outer radius": outer})
    yield from _axle("arm", arm.bore.radius, arm.hub)
    yield from _angles({"arm's cap, from the crank's axis": arm.cap})
    yield from _angles({"arm's eyes, half angle": arm.eye})
    hole = arm.pins[0].radius
    yield from _lengths({"pins": 2.0 * ball.pin_mm, "pins' holes in the arm": 2.0 * hole})
    yield from _bolts("lock's bolt", arm.bolts)


def _axle(part: str, bore: float, hub: float) -> Iterator[Dimension]:
    if bore:
        yield Dimension(f"{part}'s bore", 2.0 * bore, "mm")
    if hub > bore:
        yield Dimension(f"{part}'s hub", 2.0 * hub, "mm")


def _bolts(name: str, holes: tuple[RoundHole, ...]) -> Iterator[Dimension]:
    for k, bolt in enumerate(holes, 1):
        x, y, z = bolt.axis
        yield Dimension(f"{name} {k}: hole", 2.0 * bolt.radius, "mm")
        named = {"from the axis": math.acos(z), "azimuth": math.atan2(y, x)}
        yield from _angles({f"{name} {k}: {what}": at for what, at in named.items()})


def _lengths(named: dict[str, float]) -> Iterator[Dimension]:
    return (Dimension(name, value, "mm") for name, value in named.items())


def _angles(named: dict[str, float]) -> Iterator[Dimension]:
    return (Dimension(name, math.degrees(value), "deg") for name, value in named.items())


def meridians_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return the slots of a spherical wheel, one row for each: meridians of its sphere.

    Azimuths are about the wheel's axis, polar angles from it. Points are on the sphere.
    """
    engagement, spec = mechanism.engagements[0], mechanism.spec
    mouth, bottom = (engagement.slot(x, 0)[0].c[0] for x in (engagement.entry_deg, 0.0))
    L = mechanism.center_distance_mm
    names = ["slot", "azimuth_deg", "mouth_polar_deg", "bottom_polar_deg"]
    names += [f"{end}_{axis}_mm" for end in ("mouth", "bottom") for axis in "xyz"]
    rows = []
    for k in range(spec.wheel.z):
        azimuth = 2.0 * math.pi * k / spec.wheel.z
        row = [k + 1, math.degrees(azimuth), math.degrees(mouth), math.degrees(bottom)]
        for polar in (mouth, bottom):
            across = L * math.sin(polar)
            row += [across * math.cos(azimuth), across * math.sin(azimuth), L * math.cos(polar)]
        rows.append(row)
    return rows_table(names, rows)
