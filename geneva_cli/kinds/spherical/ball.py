"""The sizes of a spherical wheel and its crank: angles at the sphere's centre, in radians.

All walls lead to the centre, and so does the surface of the roller, a cone. Its radius, the slots
and the clearances are arcs on the sphere of radius ``center_distance_mm``; radii of lock and bores
are distances from their axes. Below the wheel on a plane is outside the wheel here.
"""

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import value_or
from geneva_cli.parts import sizes
from geneva_cli.parts.assembly import assembly
from geneva_cli.parts.machine_sizes import lock_between
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.spec.defaults import wall_min
from geneva_cli.spec.tables import Z_DRAWN, Size


class BallLengths(NamedTuple):
    """Arc lengths on the sphere, mm; ``rim`` is a distance from the wheel's axis."""

    roller: float
    half_width: float
    rim: float
    arm: float
    horn: float
    lock: float


class Ball(NamedTuple):
    """The sizes of a spherical machine, whose slots are meridians.

    Polar angles are from the wheel's axis; for parts of the crank they are from the crank's axis.
    """

    radius_mm: float  # of the sphere
    z: int
    axes: float  # between the shafts
    arm: float  # of the rollers, from the crank's axis
    half_motion: float  # crank angle from entry to mid-motion
    rollers: tuple[float, ...]  # azimuths about the crank's axis
    roller: float  # half angle of its cone
    half_width: float  # of the slots
    bottom: float  # polar angle of the centre of the slot's round end
    bottom_mm: float  # clearance of the deepest roller from that end
    mouth: float  # polar angle where a roller enters
    rim: float  # polar angle of the wheel's edge
    lock: float  # polar angle of the locking sectors' edge, 0 for none
    recess: float  # polar angle of the recess in the wheel, 0 for none
    span_mm: tuple[float, float]  # radii of the inner and outer face of wheel and rollers
    lock_span_mm: tuple[float, float]  # of the locking sectors
    arm_span_mm: tuple[float, float]  # of the crank arm
    bore_mm: float  # radius of the wheel's bore, 0 for none
    hub_mm: float  # radius of its hub, 0 for none
    pin_mm: float  # radius of the rollers' pins, 0 for none
    arm_bore_mm: float  # radius of the bore in the arm's hub, 0 without an arm

    @property
    def lengths(self) -> BallLengths:
        """The sizes as lengths."""
        L = self.radius_mm
        arcs = L * self.roller, L * self.half_width, L * math.sin(self.rim), L * math.sin(self.arm)
        return BallLengths(*arcs, L * self.horn, L * self.lock)

    @property
    def half_step(self) -> float:
        """Half a step of the wheel."""
        return math.pi / self.z

    @property
    def opening_mm(self) -> float:
        """The radius of the round hole about the wheel's axis; 0 where its ring stays open."""
        return max(self.bore_mm, self.hub_mm)

    @property
    def slot_end(self) -> float:
        """The polar angle up to which the slots reach inwards."""
        return self.bottom - self.half_width

    @property
    def slot_end_mm(self) -> float:
        """The distance of the slots' ends from the axis, on the inner face."""
        return self.span_mm[0] * math.sin(min(self.slot_end, 0.5 * math.pi))

    @property
    def inner(self) -> float:
        """The polar angle where the slotted ring ends, between its slots and the hole."""
        hole = math.asin(min(1.0, self.opening_mm / self.span_mm[0]))
        end = self.slot_end
        return end - self.roller if end - self.roller > hole else 0.5 * (end + hole)

    @property
    def between_slots(self) -> float:
        """The polar angle of the wheel's edge on the meridian between two slots."""
        return self.axes - self.recess if self.recess else self.rim

    @property
    def horn(self) -> float:
        """The wall between a slot and a recess, as an angle."""
        return self.arm - self.half_width - self.recess

    @property
    def corner(self) -> float:
        """The azimuth of the slot's corner at the rim, from the slot's middle."""
        return math.asin(math.sin(self.half_width) / math.sin(self.rim))

    @property
    def opened(self) -> float:
        """Half the azimuth over which a recess opens the rim, 0 without a recess."""
        if not self.recess:
            return 0.0
        c = math.cos(self.recess) - math.cos(self.rim) * math.cos(self.axes)
        return math.acos(c / (math.sin(self.rim) * math.sin(self.axes)))

    def passing_mm(self, opening_mm: float) -> float:
        """Return the radius of the largest eye that passes the wheel's hub, mm on the sphere."""
        opening = math.asin(min(1.0, opening_mm / self.arm_span_mm[0]))
        return self.radius_mm * (self.axes - self.arm - opening)

    def arm_radii(self, size: Size) -> tuple[float, float, float, float]:
        """Return how far the arm's bore reaches, radii of its hub and eyes, mm, and of its cap.

        The cap, an angle, is about the locking sectors, or about the hub and a wall.
        """
        wall, bore = wall_min(size, self.radius_mm), self.arm_bore_mm
        bored, hole = reach_or_bore(size, "crank", bore), sizes.hole_radius(size, self.pin_mm)
        hub = sizes.arm_hub(size, bored, bore, wall)
        eye = sizes.arm_eye(size, hole, wall, self.passing_mm(self.opening_mm))
        edge = hub + max(hub - bored, wall)
        cap = max(self.lock, math.asin(min(1.0, edge / self.arm_span_mm[0])))
        return bored, hub, eye, cap

    def shafts_end_mm(self, size: Size) -> float:
        """Return where shafts leave the parts that they carry: a distance from the centre."""
        hub = self.span_mm[1] + (size.wheel_hub_length_mm or 0.0) if self.hub_mm else 0.0
        return max(self.arm_span_mm[1], hub) + size.washer_mm

    def hub_length_mm(self, size: Size) -> float:
        """Return the length of the wheel's hub, by default out to the arm's face."""
        inside, outside = self.span_mm
        length = size.wheel_hub_length_mm
        return (self.arm_span_mm[1] if length is None else outside + length) - inside


def usual_ball(mechanism: Mechanism, thickness_mm: float | None) -> Ball:
    """Return the sizes without a load, for a thickness of the wheel, or else its default."""
    spec, L, r = mechanism.spec, mechanism.center_distance_mm, mechanism.roller_radius_mm
    size, z, allowed = spec.size, spec.wheel.z, spec.size.allowances
    _refuse_undrawn(spec)
    where, axes = assembly(mechanism, flat=False), math.radians(spec.wheel.own_sizes["axes_deg"])
    engagement = where.motions[0].engagement
    mouth, deepest = (float(engagement.slot(x, 0)[0].c[0]) for x in (engagement.entry_deg, 0.0))
    roller = r / L
    arm, w = axes - deepest, roller + allowed.slot_clearance_mm / L
    bottom_mm = value_or(size.slot_bottom_clearance_mm, max(allowed.slot_clearance_mm, r / 20.0))
    bottom = deepest - bottom_mm / L
    # the roller touches the wall that faces the crank's axis at the foot of the perpendicular
    rim = math.acos(math.cos(mouth) * math.cos(w))
    text = "the slots meet near their ends: reduce roller_radius_mm, slot_clearance_mm or "
    text += f"slot_bottom_clearance_mm, or use fewer than {z} slots"
    meet = bottom <= 0.0 or math.sin(bottom) * math.sin(math.pi / z) <= math.sin(w)
    refuse_size(meet, "roller_radius_mm", text)
    thick = sizes.drawn_thicknesses(size.replace(wheel_thickness_mm=thickness_mm), L)
    inside, outside = L - 0.5 * thick.wheel, L + 0.5 * thick.wheel
    under = outside + allowed.pin_gap_mm  # the arm's inner face, on which the sectors stand
    why = "the part would reach inwards to the sphere's centre"
    refuse_above("wheel_thickness_mm", thick.wheel, L, why)
    refuse_above("lock_thickness_mm", thick.lock, under, why)
    pin = sizes.pin_radius(size, r)
    thin = min(thick.wheel, thick.lock, thick.arm)
    sizes.refuse_pin_and_edges(size, pin, inside * math.sin(roller), thin)
    # the locking sectors' edge is between the wheel's rim and the rollers
    limit, least = arm - w - allowed.lock_clearance_mm / L, abs(axes - rim)
    lock = _lock(spec, L, least, limit, roller) if spec.has_lock else 0.0
    space = L * arm - sizes.hole_radius(size, pin)
    bored = sizes.arm_bore(spec, 0.0, L, space) if spec.drive.crank and pin else 0.0
    rollers = tuple(math.radians(one.mid) for one in where.rollers)
    crank = axes, arm, math.radians(engagement.exit_deg), rollers
    slots = roller, w, bottom, bottom_mm, mouth, rim
    locks = lock, lock + allowed.lock_clearance_mm / L if lock else 0.0
    spans = (inside, outside), (under - thick.lock, under), (under, under + thick.arm)
    end = inside * math.sin(min(bottom - w, 0.5 * math.pi))  # of the slots, from the axis
    bore = sizes.wheel_bore(spec, end, wall_min(size, L), L)
    hub = hub_about(size, L, bore, end)
    why = "the slots of this roller reach this diameter"
    refuse_above("wheel_bore_mm", 2.0 * bore, 2.0 * end, why)
    refuse_above("wheel_hub_mm", 2.0 * hub, 2.0 * end, why)
    ball = Ball(L, z, *crank, *slots, *locks, *spans, bore, hub, pin, bored)
    text = "the wheel's middle is not open: the slots end within a roller's width of its axis; "
    text += "set a wheel_bore_mm or reduce the roller"
    refuse_size(ball.inner <= 0.0, "wheel_bore_mm", text)
    # a horn thinner than a thousandth of half a step counts as none
    text = "no horn is left between slot and recess at the rim: reduce lock_radius_mm"
    thin = ball.opened + ball.corner > (1.0 - 1e-3) * ball.half_step
    refuse_size(thin, "lock_radius_mm", text)
    return ball


def _refuse_undrawn(spec: Spec) -> None:
    """Raise GenevaError for too many slots, and for keys of parts that a sphere does not have."""
    if spec.wheel.z > Z_DRAWN:
        text = f"z = {spec.wheel.z}: parts are drawn up to {Z_DRAWN} slots"
        raise GenevaError(text, ("wheel", "z"))
    for key in ("crank_bore_mm", "crank_hub_mm", "crank_hub_length_mm", "dial_bolts"):
        text = f"{key}: a sphere's crank has its bore and hub in the arm (arm_bore_mm, "
        text += f"arm_hub_mm), and its wheel no dial; remove {key}"
        refuse_size(vars(spec.size)[key], key, text)


def _lock(spec: Spec, L: float, least: float, limit: float, roller: float) -> float:
    """Return the polar angle of the locking sectors' edge, between two others."""
    low, high = (L * math.sin(max(0.0, x)) for x in (least, limit))
    text = f"the locking sector does not fit: lock_radius_mm must be above {low:.4g} to reach "
    text += f"the rim, but the roller limits it to {high:.4g}; 0 omits it"
    refuse_size(limit <= least, "lock_radius_mm", text)
    own = spec.size.lock_radius_mm
    if own is None:
        return lock_between(None, least, limit, roller)
    return math.asin(lock_between(own, low, high, 0.0) / L)


def hub_about(size: Size, L: float, bore: float, end: float) -> float:
    """Return the radius of the wheel's hub about a bore; ``end`` is that of the slots' ends."""
    wall = wall_min(size, L)
    bored, hub = sizes.reach_and_hub(size, "wheel", bore, wall, end)
    return bore if size.wheel_hub_mm is None and hub < bored + wall else hub


def flat_radius(inner: float, outer: float) -> float:
    """Return the radius of the widest flat face in a shell."""
    return math.sqrt((outer - inner) * (outer + inner))


def refuse_wide(key: str, radius: float, inner: float, outer: float) -> None:
    """Raise GenevaError for a hub with flat faces that is too wide for its curved shell."""
    why = f"a hub with flat faces this wide misses its shell, which is {outer - inner:g} mm thick"
    refuse_above(key, 2.0 * radius, 2.0 * flat_radius(inner, outer), why)


def refuse_above(key: str, value: float, most: float, why: str) -> None:
    """Raise GenevaError for a size that is not below the most that its parts leave, mm."""
    refuse_size(value >= most, key, f"{why}; it must be below {most:.6g}", value)
