"""The record of the sizes of a spherical machine, and what follows from them alone."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.parts.sizes import crank_reach_and_hub, wheel_bore, wheel_reach_and_hub
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.spec.tables import Size


class PartDoesNotFit(GenevaError):
    """Error for a part that does not fit, but would with a smaller roller."""


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
    mouth: float  # polar angle where a roller enters
    rim: float  # polar angle of the wheel's edge
    inner: float  # polar angle where the slotted ring ends towards its axis
    lock: float  # polar angle of the locking sectors' edge, 0 for none
    lock_mm: float  # distance of that edge from the crank's axis
    recess: float  # polar angle of the recess in the wheel, 0 for none
    span_mm: tuple[float, float]  # radii of the inner and outer face of wheel and rollers
    lock_span_mm: tuple[float, float]  # of the locking sectors
    arm_span_mm: tuple[float, float]  # of the crank arm
    bore_mm: float  # radius of the wheel's bore, 0 for none
    hub_mm: float  # radius of its hub, 0 for none
    pin_mm: float  # radius of the rollers' pins, 0 for none
    arm_bore_mm: float  # radius of the bore in the arm's hub, 0 without an arm
    about_crank_mm: float  # radius of the crank's shaft or hub inside the arm, 0 for none

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
    def between_slots(self) -> float:
        """The polar angle of the wheel's edge on the meridian between two slots."""
        return self.axes - self.recess if self.recess else self.rim

    @property
    def wall_mouth(self) -> float:
        """The polar angle at which a slot's middle leaves the rim."""
        return math.acos(math.cos(self.rim) / math.cos(self.half_width))

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

    def cap(self, hub_mm: float, bored_mm: float, wall_mm: float) -> float:
        """Return the angle of the arm's cap about its sectors, or about its hub and a wall.

        The wall is as thick as that of the hub, whose bore reaches to ``bored_mm``.
        """
        edge = hub_mm + max(hub_mm - bored_mm, wall_mm)
        return max(self.lock, math.asin(min(1.0, edge / self.arm_span_mm[0])))

    def shafts_end_mm(self, size: Size) -> float:
        """Return where shafts leave the parts that they carry: a distance from the centre."""
        hub = self.span_mm[1] + (size.wheel_hub_length_mm or 0.0) if self.hub_mm else 0.0
        return max(self.arm_span_mm[1], hub) + size.washer_mm

    def hub_length_mm(self, size: Size) -> float:
        """Return the length of the wheel's hub, by default out to the arm's face."""
        inside, outside = self.span_mm
        length = size.wheel_hub_length_mm
        return (self.arm_span_mm[1] if length is None else outside + length) - inside


def inner_edge(slot_end: float, roller: float, hole: float) -> float:
    """Return the polar angle where the slotted ring ends, between its slots and a hole."""
    return slot_end - roller if slot_end - roller > hole else 0.5 * (slot_end + hole)


def wheel_axle(spec: Spec, L: float, inside: float, slot_end: float) -> tuple[float, float]:
    """Return the radii of the wheel's bore and its hub, mm, 0 for none.

    ``inside`` is the radius of the wheel's inner sphere, ``slot_end`` the angle from its axis to
    the ends of its slots. Raises GenevaError, naming the key, where one of them cuts the slots.
    """
    end = inside * math.sin(min(slot_end, 0.5 * math.pi))
    bore = wheel_bore(spec, end, wall_min(spec.size, L), L)
    hub = hub_about(spec.size, L, bore, end)
    for key, radius in (("wheel_bore_mm", bore), ("wheel_hub_mm", hub)):
        if radius >= end:
            raise GenevaError(
                f"{key} = {2.0 * radius:g}: the slots reach this diameter; it must be below "
                f"{2.0 * end:.6g}, or the roller smaller",
                ("size", key),
            )
    return bore, hub


def hub_about(size: Size, L: float, bore: float, end: float) -> float:
    """Return the radius of the wheel's hub about a bore; ``end`` is that of the slots' ends.

    Where a default hub would leave no wall around the bore there is none: it is the bore's.
    """
    wall = wall_min(size, L)
    bored, hub = wheel_reach_and_hub(size, bore, wall, end)
    return bore if size.wheel_hub_mm is None and hub < bored + wall else hub


def crank_hub(size: Size, L: float) -> float:
    """Return the radius of the crank's hub inside the arm, mm; 0 unless the spec has one."""
    if not size.has_hub("crank"):
        return 0.0
    bore = 0.5 * (size.crank_bore_mm or 0.0)
    _, hub = crank_reach_and_hub(size, bore, wall_min(size, L))
    return hub if hub > bore else 0.0


def refuse_wide(key: str, radius: float, inner: float, outer: float) -> None:
    """Raise GenevaError for a hub with flat faces that is too wide for its curved shell."""
    flat = math.sqrt((outer - inner) * (outer + inner))
    if radius >= flat:
        raise GenevaError(
            f"{key} = {2.0 * radius:g}: a hub with flat faces this wide misses its shell, which "
            f"is {outer - inner:g} mm thick; it must be below {2.0 * flat:.6g}",
            ("size", key),
        )
