"""The sizes of a spherical wheel and its crank: angles at the sphere's centre, in radians.

All walls lead to the centre, and so does the roller, a cone. Its radius, slots and clearances are
arcs of the sphere, of the radius ``center_distance_mm``; radii of the lock and of bores are from
their axes. What lies below the wheel on a plane is outside of it here: a height above the wheel's
lower face is a distance inwards from its outer sphere.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.curves.sphere import Vector, place
from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.rollers import places
from geneva_cli.parts.sizes import (
    Thicknesses,
    lock_between,
    pin_radius,
    require_lock_between,
    thicknesses,
)
from geneva_cli.parts.sphere.axles import about_crank, wheel_axle
from geneva_cli.spec.tables import Z_DRAWN, Size

LEAST_HORN = 1e-3  # of the roller's angle: a horn at the rim thinner than this is none


class NoRoom(GenevaError):
    """Raised where there is no room for a part, which a smaller roller leaves."""


class Ball(NamedTuple):
    """Of a machine whose slots are meridians.

    Polar angles are from the wheel's axis, and about the crank from the crank's.
    """

    radius_mm: float  # of the sphere
    z: int
    axes: float  # between the shafts
    arm: float  # of the rollers, from the crank's axis
    half_motion: float  # crank angle from entry to mid-motion
    rollers: tuple[float, ...]  # where they are about the crank's axis
    roller: float  # half angle of its cone
    half_width: float  # of the slots
    bottom: float  # of the slot's last round, its polar angle
    mouth: float  # where a roller enters
    rim: float  # the wheel's edge
    inner: float  # where its slotted ring ends towards its axis
    lock: float  # of the locking sectors, 0 for none
    recess: float  # the same in the wheel
    span_mm: tuple[float, float]  # radii of the wheel's inner and outer face, and the rollers'
    lock_span_mm: tuple[float, float]  # of the locking sectors'
    arm_span_mm: tuple[float, float]  # of the crank arm's
    bore_mm: float  # radius of the wheel's bore, 0 for none
    hub_mm: float  # of its hub, likewise
    pin_mm: float  # of the rollers' pins, likewise
    about_crank_mm: float  # of what of the crank's shaft and hub is beside the wheel

    @property
    def half_step(self) -> float:
        """Half an index of the wheel."""
        return math.pi / self.z

    @property
    def opening_mm(self) -> float:
        """The radius of the round hole about the wheel's axis; 0 where its ring stays open."""
        return max(self.bore_mm, self.hub_mm)

    def out(self, height_mm: float) -> float:
        """The distance from the centre of a height above the wheel's lower face."""
        return self.span_mm[1] - height_mm

    @property
    def slot_width_deg(self) -> float:
        """Between the walls of a slot, seen from the sphere's centre."""
        return math.degrees(2.0 * self.half_width)

    def corner(self) -> float:
        """The azimuth of the slot's corner at the rim, from its middle."""
        return math.asin(math.sin(self.half_width) / math.sin(self.rim))

    def opened(self) -> float:
        """Half the azimuth over which a recess opens the rim, 0 for none."""
        if not self.recess:
            return 0.0
        c = math.cos(self.recess) - math.cos(self.rim) * math.cos(self.axes)
        return math.acos(c / (math.sin(self.rim) * math.sin(self.axes)))

    def crank_axis(self, azimuth: float) -> Vector:
        """The crank's axis at an azimuth about the wheel's."""
        return place(self.axes, azimuth)


def ball(mechanism: Mechanism, roller_mm: float | None = None) -> Ball:
    """The sizes of a machine on a sphere; with another roller than its own, if one is named.

    Raises GenevaError, naming the key, where they leave no wheel or no lock.
    """
    spec, L = mechanism.spec, mechanism.center_distance_mm
    size, z = spec.size, spec.wheel.z
    if z > Z_DRAWN:
        raise GenevaError(f"z = {z}: parts are drawn up to {Z_DRAWN} slots", ("wheel", "z"))
    first, *others = places(spec.wheel, spec.drive, spec.given_distance_mm)
    arm = math.atan2(first.ratio, first.cone)
    engagement = mechanism.engagements[0]
    mouth, deepest = (float(engagement.slot(x, 0)[0].c[0]) for x in (engagement.entry_deg, 0.0))
    axes = deepest + arm
    radius_mm = mechanism.roller_radius_mm if roller_mm is None else roller_mm
    roller = radius_mm / L
    w = roller + size.allowances.slot_clearance_mm / L
    gap = size.slot_bottom_clearance_mm
    usual = max(size.allowances.slot_clearance_mm, radius_mm / 20.0)
    bottom = deepest - (usual if gap is None else gap) / L
    # the roller touches the wall that faces the crank's axis at the foot of the perpendicular
    rim = math.acos(math.cos(mouth) * math.cos(w))
    _refuse_slots(bottom, w, z)
    thick, pin = thicknesses(size, L), pin_radius(size, radius_mm)
    _refuse_thick(thick, size, L, roller, pin)
    inside, outside = L - 0.5 * thick.wheel, L + 0.5 * thick.wheel
    under = outside + size.pin_gap_mm  # the arm's inner face, on which the sectors stand
    room = bottom - w
    bore, hub = wheel_axle(size, L, inside, room)
    hole = math.asin(max(bore, hub) / inside)
    inner = room - roller if room - roller > hole else 0.5 * (room + hole)
    lock = _lock(mechanism, arm - w, abs(axes - rim), roller)
    many = spec.drive.rollers
    turns = [p.crank_deg for p in (first, *others)]
    if len(turns) == 1:
        turns = [360.0 * i / many for i in range(many)]
    found = Ball(
        radius_mm=L,
        z=z,
        axes=axes,
        arm=arm,
        half_motion=math.radians(first.half_motion_deg),
        rollers=tuple(math.radians(t) for t in turns),
        roller=roller,
        half_width=w,
        bottom=bottom,
        mouth=mouth,
        rim=rim,
        inner=inner,
        lock=lock,
        recess=lock + size.allowances.lock_clearance_mm / L if lock else 0.0,
        span_mm=(inside, outside),
        lock_span_mm=(under - thick.lock, under),
        arm_span_mm=(under, under + thick.arm),
        bore_mm=bore,
        hub_mm=hub,
        pin_mm=pin,
        about_crank_mm=about_crank(size),
    )
    _refuse(found)
    return found


def _lock(mechanism: Mechanism, room: float, least: float, roller: float) -> float:
    """The locking sectors' angle from the crank's axis; its sine is ``lock_radius_mm`` over L.

    As on a plane: a horn as thick as the roller's radius, or a fifth of the room.
    """
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    if size.lock_radius_mm == 0.0 or not mechanism.spec.drive.LOCKS:
        return 0.0
    room -= size.allowances.lock_clearance_mm / L
    low, high = (L * math.sin(max(0.0, x)) for x in (least, room))
    if room <= least:
        raise NoRoom(
            f"no room for a locking sector: it would have to reach {low:.4g} mm from the crank's "
            f"axis, to the rim, and the roller leaves {high:.4g} mm; lock_radius_mm = 0 leaves it "
            "out, where the wheel is held in another way",
            ("size", "lock_radius_mm"),
        )
    if size.lock_radius_mm is None:
        return lock_between(least, room, roller)
    require_lock_between(size.lock_radius_mm, low, high)
    return math.asin(size.lock_radius_mm / L)


def _refuse_slots(bottom: float, w: float, z: int) -> None:
    if bottom <= 0.0 or math.sin(bottom) * math.sin(math.pi / z) <= math.sin(w):
        raise NoRoom(
            "the slots meet beside their ends: roller_radius_mm, slot_clearance_mm and "
            "slot_bottom_clearance_mm are too large for so many slots",
            ("size", "roller_radius_mm"),
        )


def _refuse(found: Ball) -> None:
    if found.inner <= 0.0:
        raise NoRoom(
            "the wheel has no bore, and no opening about its axis: the slots' ends are no farther "
            "from it than a roller's width; a wheel_bore_mm, or a smaller roller, is needed",
            ("size", "wheel_bore_mm"),
        )
    if found.opened() + found.corner() > (1.0 - LEAST_HORN) * found.half_step:
        raise NoRoom(
            "no horn is left between slot and recess at the rim: a smaller lock_radius_mm may "
            "leave one",
            ("size", "roller_radius_mm"),
        )


def _refuse_thick(thick: Thicknesses, size: Size, L: float, roller: float, pin_mm: float) -> None:
    if thick.wheel >= L:
        raise GenevaError(
            f"wheel_thickness_mm = {thick.wheel:g}: half of it lies within the sphere of "
            f"{L:g} mm; it must be below {L:g}",
            ("size", "wheel_thickness_mm"),
        )
    most = L + 0.5 * thick.wheel + size.pin_gap_mm
    if thick.lock >= most:
        raise GenevaError(
            f"lock_thickness_mm = {thick.lock:g}: the locking sectors reach inwards from the arm, "
            f"{most:g} mm from the sphere's centre; it must be below that",
            ("size", "lock_thickness_mm"),
        )
    thin = (L - 0.5 * thick.wheel) * math.sin(roller)
    if pin_mm >= thin:
        raise GenevaError(
            f"pin_mm = {2.0 * pin_mm:g}: it must be below {2.0 * thin:.6g}, the diameter of the "
            "roller's cone where it is thinnest",
            ("size", "pin_mm"),
        )
