"""The dimensions of a spherical machine: radii of its shells, and angles to make them by."""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.geometry.sphere_arcs import RoundHole
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
    ball = parts.ball
    yield from _lengths("shells'", ball.span_mm)
    yield _angle("roller's cone, half angle", ball.roller)
    yield _angle("slot, between its walls", 2.0 * ball.half_width)
    yield _angle("slot's last round, from the wheel's axis", ball.bottom)
    yield _angle("rim, from the wheel's axis", ball.rim)
    yield _angle("slotted ring's inner edge, from its axis", ball.inner)
    yield from _axle("wheel", ball.bore_mm, ball.hub_mm)
    if ball.lock:
        yield _angle("lock, from the crank's axis", ball.lock)
        yield _angle("recess, from the crank's axis", ball.recess)
        yield Dimension("locking sectors' inner radius", ball.lock_span_mm[0], "mm")
    for k, region in enumerate(parts.shells.crank, 1):
        rim, _, low, _ = region.boundary
        yield _angle(f"locking sector {k}: inner edge", math.pi - low.angle)
        start = math.atan2(rim.start[1], rim.start[0]) % math.tau
        yield _angle(f"locking sector {k}: begins", start)
        yield _angle(f"locking sector {k}: width", rim.sweep)
    yield from or_missing("arm's dimensions", lambda: _arm(parts))
    for whose, cone in (("wheel", wheel_cone(ball)), ("crank", crank_cone(ball))):
        flat = f"{whose} laid flat"
        yield _angle(f"{flat}: cone touches the sphere at", cone.polar)
        yield Dimension(f"{flat}: from there to its apex", abs(cone.apex_mm), "mm")
        yield Dimension(f"{flat}: sector", cone.sector_deg, "deg")


def _arm(parts: SphereParts) -> Iterator[Dimension]:
    arm, ball = parts.arm, parts.ball
    if arm is None:
        return
    yield from _lengths("arm's", ball.arm_span_mm)
    yield from _axle("arm", arm.bore.radius, arm.hub)
    yield _angle("arm's cap, from the crank's axis", arm.cap)
    yield _angle("arm's eyes, half angle", arm.eye)
    yield Dimension("pins", 2.0 * ball.pin_mm, "mm")
    yield Dimension("pins' holes in the arm", 2.0 * arm.pins[0].radius, "mm")
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
        yield _angle(f"{name} {k}: from the axis", math.acos(z))
        yield _angle(f"{name} {k}: azimuth", math.atan2(y, x))


def _lengths(whose: str, span_mm: tuple[float, float]) -> Iterator[Dimension]:
    for end, radius in zip(("inner", "outer"), span_mm, strict=True):
        yield Dimension(f"{whose} {end} radius", radius, "mm")


def _angle(name: str, value: float) -> Dimension:
    return Dimension(name, math.degrees(value), "deg")


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
