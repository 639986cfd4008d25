"""The crank arm of a spherical machine: a cap outside of the wheel, which carries all of the crank.

All that turns about axes through one centre stays at its distance from there: a shell outside of
the wheel's never meets it. The arm's boundary is the belt round the locking sectors, which stand on
its inner face, its hub, and an eye about each pin and bolt. Pins and bolts point at the centre. The
hub, with flat faces and the bore, is in a round hole about the crank's axis.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.round_holes import RoundHole
from geneva_cli.curves.sphere import Region, dot, place
from geneva_cli.curves.sphere_arcs import Arcs
from geneva_cli.curves.sphere_hull import Cap, convex_hull
from geneva_cli.errors import GenevaError
from geneva_cli.parts.arm_sizes import arm_bore, bolts_between, eye_about, hub_and_eye, pin_hole
from geneva_cli.parts.keyways import ParallelKey, key, reach
from geneva_cli.parts.sphere.axles import refuse_wide
from geneva_cli.parts.sphere.crank import locked
from geneva_cli.parts.sphere.wheel import POLE

if TYPE_CHECKING:
    from geneva_cli.parts.sphere.shells import Shells


class CapArm(NamedTuple):
    """The arm in the crank's frame; radii in mm, angles in radians."""

    boundary: Region
    bore: float
    fitted: ParallelKey | None
    keyway: float  # its direction about the crank's axis
    hub: float
    pins: tuple[RoundHole, ...]
    bolts: tuple[RoundHole, ...]
    cap: float  # angle from the crank's axis, but for the eyes
    eye: float  # angle
    reach: float  # angle from the crank's axis of its farthest
    wall: float  # the least between two holes, or a hole and the boundary, on its inner face, mm

    @property
    def holes(self) -> tuple[RoundHole, ...]:
        """All round holes: the hub's, the pins' and the bolts'."""
        return (RoundHole(POLE, self.hub), *self.pins, *self.bolts)

    def bolts_of(self, sector: int, sectors: int) -> tuple[RoundHole, ...]:
        """The bolts of one of some locking sectors."""
        each = len(self.bolts) // sectors
        return self.bolts[sector * each : (sector + 1) * each]


def has_arm(found: Shells) -> bool:
    """Whether there is an arm: rollers on pins in a crank."""
    return found.assembly.given.spec.drive.CRANKED and found.ball.pin_mm > 0.0


def crank_arm(found: Shells) -> CapArm:
    """The arm of a machine.

    Raises GenevaError, naming the key, where the sizes leave no arm round the holes.
    """
    spec, ball = found.assembly.given.spec, found.ball
    if not has_arm(found):
        raise GenevaError("pin_mm = 0: there is no pin for an arm to carry", ("size", "pin_mm"))
    wall, under = found.sizes.wall_min, ball.arm_span_mm[0]
    hole = pin_hole(spec.size, ball.pin_mm)
    disc, room = 0.5 * (spec.size.crank_bore_mm or 0.0), ball.radius_mm * ball.arm - hole
    radius = arm_bore(spec, disc, ball.radius_mm, room)
    hub, eye = hub_and_eye(spec.size, wall, hole, radius, _passing(found))
    _refuse(found, hub, hole, eye)
    around = hub - reach(spec.size.crank_keyway, radius)  # the hub's wall
    pins = tuple(RoundHole(place(ball.arm, azimuth), hole) for azimuth in ball.rollers)
    screwed = bolts(found)
    round_hub = RoundHole(POLE, hub + max(around, wall)).angle(under)
    cap, eye = max(ball.lock, round_hub), eye / ball.radius_mm
    about = [Cap(POLE, cap)]
    about += [Cap(pin.axis, eye) for pin in pins]
    about += [Cap(b.axis, eye_about(b.radius, wall) / under) for b in screwed]
    middle = next((0.5 * (a + b) for a, b in locked(ball)), 0.5 * ball.rollers[-1] + math.pi)
    made = CapArm(
        boundary=convex_hull(about),
        bore=radius,
        fitted=key(spec.size.crank_keyway, radius),
        keyway=middle,
        hub=hub,
        pins=pins,
        bolts=screwed,
        cap=cap,
        eye=eye,
        reach=max(math.acos(dot(one.middle, POLE)) + one.angle for one in about),
        wall=0.0,
    )
    return made._replace(wall=min(around, _walls(made, found)))


def _passing(found: Shells) -> float:
    """The widest half of an eye that passes the wheel's hub, mm along the sphere."""
    ball = found.ball
    aside = RoundHole(POLE, ball.opening_mm).angle(ball.arm_span_mm[0])
    return ball.radius_mm * (ball.axes - ball.arm - aside)


def bolts(found: Shells) -> tuple[RoundHole, ...]:
    """The holes of the bolts that fix the locking sectors to the arm, evenly in each.

    Raises GenevaError where there are no sectors to fix.
    """
    size, ball = found.assembly.given.spec.size, found.ball
    rims = [sector.boundary[0] for sector in found.crank]
    widths = [(math.atan2(rim.start[1], rim.start[0]), rim.sweep) for rim in rims]
    r, directions = bolts_between(size, ball.radius_mm, widths)
    made = []
    for sector, at in zip(found.crank, directions, strict=False):
        rim, _, inner, _ = sector.boundary
        far = 0.5 * (math.pi - inner.angle + rim.angle)
        if size.lock_bolt_circle_mm is not None:
            far = math.asin(min(1.0, 0.5 * size.lock_bolt_circle_mm / ball.radius_mm))
        made += [RoundHole(place(far, azimuth), r) for azimuth in at]
    return tuple(made)


def _refuse(found: Shells, hub: float, hole: float, eye: float) -> None:
    """Raise GenevaError, naming the key, for an arm that does not fit on its sphere."""
    ball = found.ball
    under, over = ball.arm_span_mm
    refuse_wide("arm_hub_mm", hub, under, over)
    if ball.arm + eye / ball.radius_mm >= 0.5 * math.pi:
        raise GenevaError(
            f"arm_eye_mm = {2.0 * eye:g}: the arm would reach over half of the sphere; it "
            f"must be below {2.0 * ball.radius_mm * (0.5 * math.pi - ball.arm):.6g}",
            ("size", "arm_eye_mm"),
        )
    room = under * math.sin(ball.arm - RoundHole(POLE, hole).angle(under))
    if hub >= room:
        name = "arm_hub_mm" if found.assembly.given.spec.size.arm_hub_mm else "arm_bore_mm"
        raise GenevaError(
            f"arm_bore_mm, arm_hub_mm: the hub, {2.0 * hub:.6g} mm wide, runs into the pin's "
            f"hole; it must be below {2.0 * room:.6g}",
            ("size", name),
        )


def _walls(made: CapArm, found: Shells) -> float:
    """The least wall on the arm's inner face, and round bolts in the sectors, where it is least.

    Raises GenevaError where holes run into each other, or out of what they are in.
    """
    ball = found.ball
    least = least_wall(made.boundary, made.holes, ball.arm_span_mm[0])
    for k, sector in enumerate(found.crank if made.bolts else []):
        own = made.bolts_of(k, len(found.crank))
        least = min(least, least_wall(sector, own, ball.lock_span_mm[0]))
    if least <= 0.0:
        raise GenevaError(
            "the round holes of the crank arm run into each other, or out of the arm or its "
            "locking sectors: smaller ones of lock_bolt_mm, arm_hub_mm or pin_mm, fewer lock_bolts "
            "or another lock_bolt_circle_mm leave a wall",
            ("size", "lock_bolts" if made.bolts else "arm_hub_mm"),
        )
    return least


def least_wall(within: Region, holes: Sequence[RoundHole], sphere: float) -> float:
    """The least wall between holes, and between them and a boundary, on a sphere, mm."""
    angles = [hole.angle(sphere) for hole in holes]
    away, _ = Arcs(within.boundary).signed(np.array([hole.axis for hole in holes]))
    least = float((-away - angles).min())
    for (one, a), (other, b) in combinations(zip(holes, angles, strict=True), 2):
        apart = 2.0 * math.asin(min(1.0, 0.5 * math.dist(one.axis, other.axis)))
        least = min(least, apart - a - b)
    return sphere * least
