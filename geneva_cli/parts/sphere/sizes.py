"""The sizes of a spherical wheel and its crank: angles at the sphere's centre, in radians.

All walls lead to the centre, and so does the roller, a cone. Its radius, slots and clearances are
arcs of the sphere, of the radius ``center_distance_mm``; radii of the lock and the bore are from
their axes.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.curves.sphere import Vector, place
from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.rollers import places
from geneva_cli.parts.sizes import lock_between, require_lock_between, thicknesses
from geneva_cli.spec.tables import Z_DRAWN

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
    inner: float  # where its shell ends towards its axis
    lock: float  # of the locking sectors, 0 for none
    recess: float  # the same in the wheel
    thickness_mm: float  # of the shells, half of it within the sphere

    @property
    def half_step(self) -> float:
        """Half an index of the wheel."""
        return math.pi / self.z

    @property
    def span_mm(self) -> tuple[float, float]:
        """Radii of the shells' inner and outer face."""
        half = 0.5 * self.thickness_mm
        return self.radius_mm - half, self.radius_mm + half

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
    first, *others = places(spec)
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
    bore = size.wheel_bore_mm
    inner = math.asin(min(1.0, 0.5 * bore / L)) if bore else bottom - w - roller
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
        thickness_mm=thicknesses(size, L).wheel,
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


def _refuse(found: Ball) -> None:
    L, b = found.radius_mm, found.half_step
    if found.bottom <= 0.0 or math.sin(found.bottom) * math.sin(b) <= math.sin(found.half_width):
        raise NoRoom(
            "the slots meet beside their ends: roller_radius_mm, slot_clearance_mm and "
            "slot_bottom_clearance_mm are too large for so many slots",
            ("size", "roller_radius_mm"),
        )
    if not 0.0 < found.inner < found.bottom - found.half_width:
        most = 2.0 * L * math.sin(max(0.0, found.bottom - found.half_width))
        raise GenevaError(
            "the wheel's shell must have an opening about its axis, and the slots reach down to "
            f"it: wheel_bore_mm must be above 0 and below {most:.6g}, or the roller smaller",
            ("size", "wheel_bore_mm"),
        )
    if found.opened() + found.corner() > (1.0 - LEAST_HORN) * b:
        raise NoRoom(
            "no horn is left between slot and recess at the rim: a smaller lock_radius_mm may "
            "leave one",
            ("size", "roller_radius_mm"),
        )
    if found.thickness_mm >= L:
        raise GenevaError(
            f"wheel_thickness_mm = {found.thickness_mm:g}: half of it lies within the sphere of "
            f"{L:g} mm; it must be below {L:g}",
            ("size", "wheel_thickness_mm"),
        )
