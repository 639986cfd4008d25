"""The crank arm of a spherical machine: a cap outside the wheel that carries the whole crank.

Every part that turns about an axis through the centre keeps its distance from the centre. So a
shell outside the wheel's shell never meets the wheel. The arm's boundary is the convex hull of its
hub, the locking sectors on its inner face, and an eye about each pin and bolt. Pins and bolts point
at the centre. The hub has flat faces and the bore; it sits in a round hole about the crank's axis.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.sphere import POLE, Cap, Region, convex_hull, dot, place
from geneva_cli.geometry.sphere_arcs import RoundHole, least_wall
from geneva_cli.kinds.spherical.ball import Ball, refuse_above, refuse_wide
from geneva_cli.kinds.spherical.regions import locked
from geneva_cli.parts.shafts.bores import Bore, bolt_radius, bore_of
from geneva_cli.parts.sizes import hub_and_eye, lock_bolt_directions, pin_hole
from geneva_cli.spec.defaults import eye_about, wall_min
from geneva_cli.spec.tables import Size


class CapArm(NamedTuple):
    """The arm in the crank's frame; radii in mm, angles in radians."""

    boundary: Region
    bore: Bore
    keyway: float  # azimuth about the crank's axis
    hub: float
    pins: tuple[RoundHole, ...]
    bolts: tuple[RoundHole, ...]  # equally many of each locking sector
    cap: float  # angle from the crank's axis to the edge, except at the eyes
    eye: float  # angle
    reach: float  # angle from the crank's axis to the farthest point
    wall: float  # the least wall between holes, and to the boundary, on the inner face, mm

    @property
    def holes(self) -> tuple[RoundHole, ...]:
        """All round holes: for the hub, the pins and the bolts."""
        return (RoundHole(POLE, self.hub), *self.pins, *self.bolts)


def crank_arm(ball: Ball, sectors: Sequence[Region], size: Size) -> CapArm:
    """Return the arm of a machine, with the locking sectors that it carries."""
    own = size.lock_bolts
    arm = _arm(ball, sectors, size, own or 0)
    if own is None and sectors:
        least = min(arm.wall, wall_min(size, ball.radius_mm) + 2.0 * size.edge_mm)
        bolted = (_arm(ball, sectors, size, count) for count in (2, 1))
        arm = next((one for one in bolted if one.wall >= least), arm)
    if arm.wall <= 0.0:
        text = "the round holes of the crank arm overlap, or cut an edge: reduce lock_bolt_mm, "
        text += "arm_hub_mm, pin_mm or lock_bolts, or change lock_bolt_circle_mm"
        raise GenevaError(text, ("size", "lock_bolts" if arm.bolts else "arm_hub_mm"))
    return arm


def _arm(ball: Ball, sectors: Sequence[Region], size: Size, bolts_each: int) -> CapArm:
    """Return the arm with so many bolts in each locking sector."""
    if not ball.arm_bore_mm:
        raise GenevaError("pin_mm = 0: there is no pin for an arm to carry", ("size", "pin_mm"))
    L, wall, (under, over) = ball.radius_mm, wall_min(size, ball.radius_mm), ball.arm_span_mm
    hole = pin_hole(size, ball.pin_mm)
    hub, eye = hub_and_eye(size, wall, hole, ball.arm_bore_mm, ball.passing_mm(ball.opening_mm))
    refuse_wide("arm_hub_mm", hub, under, over)
    most = 2.0 * L * (0.5 * math.pi - ball.arm)
    why = "the arm would cover more than half of the sphere"
    refuse_above("arm_eye_mm", 2.0 * eye, most, why)
    limit = under * math.sin(ball.arm - RoundHole(POLE, hole).angle(under))
    why = "the hub, about arm_bore_mm, cuts the pin's hole"
    refuse_above("arm_hub_mm", 2.0 * hub, 2.0 * limit, why)
    form = bore_of(size, "crank", ball.arm_bore_mm)
    pins = tuple(RoundHole(place(ball.arm, azimuth), hole) for azimuth in ball.rollers)
    bolts = _bolts(ball, sectors, size, bolts_each)
    cap, eye, bolted = ball.cap(hub, form.reach, wall), eye / L, wall + 2.0 * size.edge_mm
    caps = [Cap(POLE, cap), *(Cap(pin.axis, eye) for pin in pins)]
    caps += [Cap(b.axis, eye_about(b.radius, bolted) / under) for b in bolts]
    boundary, holes = convex_hull(caps), (RoundHole(POLE, hub), *pins, *bolts)
    walls = [hub - form.reach, least_wall(boundary, holes, under)]
    for k, sector in enumerate(sectors if bolts else []):
        of_sector = bolts[k * bolts_each : (k + 1) * bolts_each]
        walls.append(least_wall(sector, of_sector, ball.lock_span_mm[0]))
    keyway = next((0.5 * (a + b) for a, b in locked(ball)), 0.5 * ball.rollers[-1] + math.pi)
    reach = max(math.acos(dot(one.middle, POLE)) + one.angle for one in caps)
    return CapArm(boundary, form, keyway, hub, pins, bolts, cap, eye, reach, min(walls))


def _bolts(ball: Ball, sectors: Sequence[Region], size: Size, count: int) -> tuple[RoundHole, ...]:
    """Return the holes of so many bolts in each locking sector, evenly spaced and of one size."""
    L, own = ball.radius_mm, size.lock_bolt_circle_mm
    rims = [sector.boundary[0] for sector in sectors]
    inner = [math.pi - sector.boundary[2].angle for sector in sectors]
    widths = [(math.atan2(rim.start[1], rim.start[0]), rim.sweep) for rim in rims]
    rings = [(low, rim.angle) for low, rim in zip(inner, rims, strict=True)]
    directions = lock_bolt_directions(widths, count)
    half = min((0.5 * L * (b - a) for a, b in rings), default=0.0)
    asked = size.lock_bolts if directions else 0
    r = bolt_radius(size.lock_bolt_mm, L, half, "lock_bolt", asked)
    holes = []
    for (low, high), azimuths in zip(rings, directions, strict=False):
        far = 0.5 * (low + high) if own is None else math.asin(min(1.0, 0.5 * own / L))
        holes += [RoundHole(place(far, azimuth), r) for azimuth in azimuths if r]
    return tuple(holes)
