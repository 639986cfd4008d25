"""Wheel and crank of a spherical machine as regions of its sphere, and the crank's arm.

The wheel's axis is z, and its first slot is on the azimuth 0. The slot's walls are the circles that
its roller's cone touches, with a round at its end. The rim is a circle about the wheel's axis, the
recesses are circles about the crank's. Locking sectors and rollers are in the crank's frame: its
axis is z, and the first roller is on the azimuth 0.

The arm is a cap outside the wheel that carries the whole crank: what turns about an axis through
the centre keeps its distance from it. Its boundary is the convex hull of its hub, the locking
sectors on its inner face, and an eye about each pin and bolt, which point at the centre. The hub
has flat faces and the bore; it sits in a round hole about the crank's axis.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.geometry import sphere
from geneva_cli.geometry.sphere import (
    POLE,
    Cap,
    Region,
    Rotation,
    SphereArc,
    Vector,
    opposite,
    place,
)
from geneva_cli.geometry.sphere_arcs import RoundHole, azimuth, least_wall, polar
from geneva_cli.kinds.spherical.ball import Ball, refuse_above, refuse_wide
from geneva_cli.motion.pivots import turned_points
from geneva_cli.numerics.arrays import Array, within_half_turn
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.outlines.crank_outline import widest
from geneva_cli.parts.shafts.bores import Bore, bolt_radius, bore_of
from geneva_cli.parts.sizes import Span, hub_and_eye, lock_bolt_directions, pin_hole
from geneva_cli.spec.defaults import eye_about, wall_min
from geneva_cli.spec.tables import Size

QUARTER = 0.5 * math.pi


def wheel_regions(ball: Ball) -> list[Region]:
    """Return the wheel: a region for each slot, up to the next, and the cap that closes the ring.

    A ring without a hole for shaft or hub stays open.
    """
    inner = min(ball.inner, 1.0) if ball.opening_mm else ball.inner  # radian: far from the edge
    regions = list[Region]()
    for k in range(ball.z):
        middle = place(0.5 * (inner + ball.rim), 2 * k * ball.half_step)
        regions.append(_ring(edge(ball, k), inner, meridians(ball, k), middle))
    if ball.opening_mm:
        regions.append(Region(tuple(one.boundary[-2].back for one in regions), POLE))
    return regions


def _ring(outer: list[SphereArc], inner: float, sides: Span, middle: Vector) -> Region:
    """Return the region between an outer edge and a circle, by the azimuths of its sides."""
    start, end = (place(inner, a) for a in sides)
    left, right = ((-math.sin(a), math.cos(a), 0.0) for a in sides)
    inwards = SphereArc(opposite(right), QUARTER, outer[-1].end, end)
    back = SphereArc(opposite(POLE), math.pi - inner, end, start)
    return Region((*outer, inwards, back, SphereArc(left, QUARTER, start, outer[0].start)), middle)


def meridians(ball: Ball, slot: int) -> Span:
    """Return the azimuths half-way to both adjacent slots; the last slot is next to the first."""
    return (2 * slot - 1) * ball.half_step, (2 * ((slot + 1) % ball.z) - 1) * ball.half_step


def edge(ball: Ball, slot: int = 0) -> list[SphereArc]:
    """Return the edge about a slot, from the meridian before it to the next one."""
    b, w, corner, at = ball.half_step, ball.half_width, ball.corner, 2 * slot * ball.half_step
    low, high = start, end = [place(ball.between_slots, a) for a in meridians(ball, slot)]
    if ball.recess:
        low, high = (place(ball.rim, at + side * (b - ball.opened)) for side in (-1.0, 1.0))
    mouths = [place(ball.rim, at + side * corner) for side in (-1.0, 1.0)]
    middle, across = place(ball.bottom, at), (-math.sin(at), math.cos(at), 0.0)
    c, s = math.cos(w), math.sin(w)
    ends = [sphere.combined(middle, c, across, side * s) for side in (-1.0, 1.0)]
    arcs = [
        SphereArc(POLE, ball.rim, low, mouths[0]),
        SphereArc(opposite(across), QUARTER - w, mouths[0], ends[0]),
        SphereArc(opposite(middle), math.pi - w, ends[0], ends[1]),
        SphereArc(across, QUARTER - w, ends[1], mouths[1]),
        SphereArc(POLE, ball.rim, mouths[1], high),
    ]
    if ball.recess:
        before, after = (opposite(place(ball.axes, a)) for a in meridians(ball, slot))
        arcs.insert(0, SphereArc(before, math.pi - ball.recess, start, low))
        arcs.append(SphereArc(after, math.pi - ball.recess, high, end))
    return arcs


def edge_points(ball: Ball, each: int = 200) -> Array:
    """Return points along the edge of the whole wheel, (n, 3), ``each`` on every arc."""
    fractions = np.arange(each) / each
    one = np.concatenate([arc.at(arc.sweep * fractions)[0] for arc in edge(ball)])
    angle = 2.0 * ball.half_step * np.arange(ball.z)  # of each slot
    return turned_points(np.tile(one, (ball.z, 1)), np.repeat(angle, len(one)))


def sectors(ball: Ball) -> list[Region]:
    """Return the locking sectors of the crank, outside the region that the wheel sweeps."""
    spare = min(0.25 * (ball.recess - ball.lock) + 0.1 * ball.roller, 0.1 * ball.lock)
    # A sector's inner edge is a fifth of its outer one, or farther out where the wheel needs that.
    least, most = 0.2 * ball.lock, (1.0 - 0.05) * ball.lock  # a thinner ring would hold nothing
    spans = locked(ball)
    if not spans:
        return []
    levels, places = swept(ball)
    near = levels < ball.lock * (1.0 - SAME_ANGLE)

    def sector(start: float, end: float) -> Region:
        middle, turns = 0.5 * (start + end), np.array(ball.rollers)[:, None, None]
        off = np.abs(within_half_turn(places + turns - middle)).min(axis=0)
        # a point that is near at one position counts at the adjacent ones too
        off = np.pad(np.where(near, off, math.inf), ((1, 1), (0, 0)), constant_values=math.inf)
        off = np.minimum.reduce((off[:-2], off[1:-1], off[2:]))

        def nearest(half: float) -> float:
            """Return the polar angle that the wheel leaves free, over half a range of azimuths."""
            reached = float(levels[off < half * (1.0 - SAME_ANGLE)].max(initial=0.0))
            return max(min(ball.lock, reached) + spare, least)

        half = widest(0.5 * (end - start), lambda half: nearest(half) <= most)
        if half is None:
            text = "the wheel sweeps over the whole locking sector: another lock_radius_mm may "
            raise GenevaError(text + "leave part of it; 0 omits it", ("size", "lock_radius_mm"))
        low, sides = nearest(half), (middle - half, middle + half)
        rim = SphereArc(POLE, ball.lock, *(place(ball.lock, a) for a in sides))
        return _ring([rim], low, sides, POLE)

    return [sector(*span) for span in spans]


def locked(ball: Ball) -> list[tuple[float, float]]:
    """Return the azimuths about the crank's axis, from and to, between which the crank locks."""
    if not ball.lock:
        return []
    pairs = zip(ball.rollers, (*ball.rollers[1:], ball.rollers[0] + math.tau), strict=True)
    spans = [(a + ball.half_motion, b - ball.half_motion) for a, b in pairs]
    return [(a, b) for a, b in spans if b - a > SAME_ANGLE]


def at_mid_motion(ball: Ball) -> Rotation:
    """Return the crank's frame in the wheel's frame, with the first roller at mid-motion."""
    axis, ahead = place(ball.axes, 0.0), place(ball.axes - QUARTER, 0.0)
    return ahead, sphere.cross(axis, ahead), axis


def swept(ball: Ball) -> tuple[Array, Array]:
    """Return the paths of points of the wheel's edge in the crank's frame, in the first motion.

    These are polar angles from the crank's axis and azimuths about it, radians, one row for each
    position, of points that come within the locking edge.
    """
    frame, wheel = np.array(at_mid_motion(ball)), edge_points(ball, 100)
    # the wheel turns by half a step either way: the position nearest to the crank's axis counts
    off = np.maximum(np.abs(azimuth(wheel)) - ball.half_step, 0.0)
    nearest = math.sin(ball.axes) * np.hypot(wheel[:, 0], wheel[:, 1]) * np.cos(off)
    nearest += math.cos(ball.axes) * wheel[:, 2]
    wheel = wheel[nearest > math.cos(ball.lock) - SAME_ANGLE]
    turns = np.linspace(-ball.half_motion, ball.half_motion, 361)
    pins = turned_points(np.array(place(ball.arm, 0.0)), -turns) @ frame
    # the wheel's slot is under the roller
    seen = wheel @ (turned_points(np.eye(3), azimuth(pins)[:, None]) @ frame.T)
    # the limit is below the locking edge's angle, so that points along the edge do not count
    comes = seen[..., 2].max(axis=0) > math.cos((1.0 - 0.5 * SAME_ANGLE) * ball.lock)
    return polar(seen[:, comes]), azimuth(seen[:, comes]) + turns[:, None]


class CapArm(NamedTuple):
    """The arm in the crank's frame; radii in mm, angles in radians."""

    boundary: Region
    bore: Bore
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
    text = "the round holes of the crank arm overlap, or cut an edge: reduce lock_bolt_mm, "
    text += "arm_hub_mm, pin_mm or lock_bolts, or change lock_bolt_circle_mm"
    refuse_size(arm.wall <= 0.0, "lock_bolts" if arm.bolts else "arm_hub_mm", text)
    return arm


def _arm(ball: Ball, sectors: Sequence[Region], size: Size, bolts_each: int) -> CapArm:
    """Return the arm with so many bolts in each locking sector."""
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
    keyway = next((0.5 * (a + b) for a, b in locked(ball)), 0.5 * ball.rollers[-1] + math.pi)
    form = bore_of(size, "crank", ball.arm_bore_mm)._replace(direction=keyway)
    pins = tuple(RoundHole(place(ball.arm, turn), hole) for turn in ball.rollers)
    bolts = _bolts(ball, sectors, size, bolts_each)
    (*_, cap), eye, bolted = ball.arm_radii(size), eye / L, wall + 2.0 * size.edge_mm
    caps = [Cap(POLE, cap), *(Cap(pin.axis, eye) for pin in pins)]
    caps += [Cap(b.axis, eye_about(b.radius, bolted) / under) for b in bolts]
    boundary, holes = sphere.convex_hull(caps), (RoundHole(POLE, hub), *pins, *bolts)
    walls = [hub - form.reach, least_wall(boundary, holes, under)]
    for k, sector in enumerate(sectors if bolts else []):
        of_sector = bolts[k * bolts_each : (k + 1) * bolts_each]
        walls.append(least_wall(sector, of_sector, ball.lock_span_mm[0]))
    reach = max(math.acos(sphere.dot(one.middle, POLE)) + one.angle for one in caps)
    return CapArm(boundary, form, hub, pins, bolts, cap, eye, reach, min(walls))


def _bolts(ball: Ball, sectors: Sequence[Region], size: Size, count: int) -> tuple[RoundHole, ...]:
    """Return the holes of so many bolts in each locking sector, evenly spaced and of one size."""
    L, own = ball.radius_mm, size.lock_bolt_circle_mm
    edges = [(one.boundary[0], math.pi - one.boundary[2].angle) for one in sectors]
    widths = [(math.atan2(rim.start[1], rim.start[0]), rim.sweep) for rim, _ in edges]
    directions = lock_bolt_directions(widths, count)
    half = min((0.5 * L * (rim.angle - low) for rim, low in edges), default=0.0)
    asked = size.lock_bolts if directions else 0
    r = bolt_radius(size.lock_bolt_mm, L, half, "lock_bolt", asked)
    holes = []
    for (rim, low), azimuths in zip(edges, directions, strict=False):
        far = 0.5 * (low + rim.angle) if own is None else math.asin(min(1.0, 0.5 * own / L))
        holes += [RoundHole(place(far, turn), r) for turn in azimuths if r]
    return tuple(holes)
