"""Racks of parallel slots: the linear Geneva, to which wheels of very many slots tend.

A rack is written as if it were driven through a pinion of the crank's radius R: its angle is the
travel over R, from -1 to 1 radian. So it needs no formulas of its own for loads. The unit of
length is R too, as no axis gives a centre distance: the crank's axis is at (1, 0), the roller is at
(0, 0) at mid-motion, and the slots run along x.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar

from geneva_cli.motion.compatible import Conflict, unset
from geneva_cli.motion.engagement import Slot
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.path_and_slot import AnchoredPath, StraightSlotMotion
from geneva_cli.motion.pivots import Pivot, PlaneMotion
from geneva_cli.motion.wheels.classic import HalfStep, PinPose, middle
from geneva_cli.motion.wheels.gearing import Gearing, Output, RollerPlace
from geneva_cli.numerics.arrays import Array, N
from geneva_cli.numerics.jet import Displacement, Jet, Number, Vector

# tables and keys that a rack lacks, which has no shaft
OF_A_SHAFT = (
    "load.inertia_kgm2 load.torque_Nm load.dwell_torque_Nm support tolerance product "
    "limits.index_play_max_deg limits.dwell_play_max_deg shaft.stiffness_Nm_rad "
    "shaft.damping_ratio shaft.wheel_diameter_mm shaft.wheel_overhang_mm shaft.wheel_span_mm"
)


class Linear(Gearing):
    """A rack of parallel slots: it moves by two crank radii a turn, and rests as long.

    ``z`` is the number of slots, 3 or more. The centre distance is the crank's radius.

    >>> Design(Linear(6)).timing.motion_deg
    180.0
    >>> Design(Linear(6)).timing.index_mm
    200.0
    """

    NAME: ClassVar[str] = "linear"
    USUAL_LOAD: ClassVar[dict[str, float]] = {"mass_kg": 4, "force_N": 30}
    FLAT: ClassVar[bool] = False
    DISTANCE: ClassVar[str] = "crank radius"
    LOCK: ClassVar[str] = "locking ring"
    TITLE: ClassVar[str] = "Geneva rack of {} slots"
    WORDS: ClassVar[str] = "rack of {0.z} parallel slots"

    def output(self, center_distance_mm: float) -> Output:
        """The travel, in millimetres."""
        R, radius_m, keys = center_distance_mm, center_distance_mm / 1000.0, "mass_kg or force_N"
        loads = (
            ("rack_speed_m_s", "omega_rad_s", radius_m),
            ("rack_acceleration_m_s2", "alpha_rad_s2", radius_m),
            ("rack_force_N", "wheel_torque_Nm", 1.0 / radius_m),
        )
        lacks = "omega_rad_s alpha_rad_s2 wheel_torque_Nm wheel_bearing_N inertia_kgm2 "
        lacks += "acceleration_rad_s2 inertia_torque_Nm friction_torque_Nm total_torque_Nm "
        lacks += "design_torque_Nm moment_Nms drag_Nm residual_deg windup_deg"
        named = loads, tuple(lacks.split()), "derivative of its travel over R"
        units = "rack_mm", "mm", R, "m", radius_m
        return Output("rack", *units, f"{keys} in [load]", *named, turns=False)

    def axes(self, L: float) -> tuple[Pivot, ...]:
        """Axis of the crank."""
        return (Pivot("crank axis", L, 0.0),)

    def plane_motion(self, center_distance_mm: float) -> PlaneMotion:
        """How the rack slides: by the crank's radius a radian."""
        return Sliding(center_distance_mm)

    def index_deg(self, i: int) -> float:
        """Step of the pinion, two radians, in degrees."""
        return math.degrees(2.0)

    def half_motion_deg(self, step: HalfStep) -> float:
        """Crank angle in degrees from entry to mid-motion: 90."""
        return 90.0

    def place(self, step: HalfStep, center_distance_mm: float) -> RollerPlace:
        """Place of a roller, which enters and leaves a slot beside the crank's axis."""
        poses = (
            PinPose(-90.0, -1.0, 1.0, (-1.0, 0.0), (0.0, 1.0)),
            middle(self.SIGN, 1.0, 0.0),
            PinPose(90.0, 1.0, 1.0, (1.0, 0.0), (0.0, -1.0)),
        )
        return RollerPlace(step, 90.0, poses, 1.0)

    def follow(
        self, path: AnchoredPath, place: RollerPlace, turn: Displacement
    ) -> tuple[Slot, StraightSlotMotion]:
        """Parallel slot for a roller's path, and the travel that follows."""
        return ParallelSlot(path), ParallelSlotMotion(path, 1.0)


class ParallelSlot(Slot):
    """A straight slot across the travel of its rack."""

    def __init__(self, path: AnchoredPath) -> None:
        self.path = path

    def place(self, input_deg: Number, order: int) -> Jet:
        """Position of the pin across the rack."""
        return self.path.nearest(input_deg, order)[0]

    def axis(self, input_deg: Number, order: int = 0) -> Vector:
        """Lever of the slot's normal about the pinion's axis, and the pin's place along it."""
        place = self.place(input_deg, order)
        return place * 0.0 + 1.0, place

    def play(self, clearance: Number) -> Number:
        """Free travel, for a clearance on either side of the roller."""
        return 2.0 * clearance

    def upright(self, input_deg: Number, order: int = 0) -> float:
        """0: a rack does not turn about the roller's axis."""
        return 0.0


class ParallelSlotMotion(StraightSlotMotion):
    """Travel of a rack whose slot follows the pin, over the crank's radius."""

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        """Travel from the pin's position across the slots; at rest at both ends."""
        _, across, ray = self.path.nearest(input_deg, order)
        return across + ray

    def rate(self, input_deg: Number, order: int = 2) -> Jet:
        """Speed of the pin across the slots."""
        return self.path.nearest(input_deg, order + 1)[1].derivative()


def guided(spec: Spec) -> bool:
    """True if a rack slides in a guide, which stands on the frame of its crank."""
    return not spec.output.turns and (spec.drive.direct or spec.drive.gears is not None)


def no_parts(spec: Spec) -> str:
    """The reason why frame and guide are not built; empty if they are."""
    if guided(spec):
        return ""
    text = f"frame and guide of a rack behind {spec.drive.WORDS} are not built: the crank's shaft "
    return text + "has no bearing between the rack above it and the input crank below it"


class Sliding(PlaneMotion):
    """The travel of a rack along y, by the crank's radius L a radian."""

    def into(self, points: Array, turn: Array) -> Array:
        """Return points, moved back along y."""
        import numpy as np

        return np.stack((points[..., 0] + 0.0 * turn, points[..., 1] - self.L * turn), axis=-1)

    def level(self, points: Array) -> Array:
        """Return the position across the rack, x."""
        return points[..., 0]

    def place(self, points: Array) -> Array:
        """Return the position along the rack, over the radius."""
        return points[..., 1] / self.L

    def outwards(self, points: Array) -> Array:
        """Return the x axis."""
        return 0.0 * points + (1.0, 0.0)

    def lever(self, level: N) -> N:
        """Return the radius, at any level."""
        return 0.0 * level + self.L

    def half_span(self, reach: float, level: float) -> float:
        """Return the disc's radius over the rack's."""
        return reach / self.L


def refuses(spec: Spec) -> Iterator[Conflict]:
    """Rules of a rack's load; and of tables and keys that only a wheel on a shaft has."""
    if not guided(spec):
        why = "is of the guide of a rack that a plain crank or gears drive"
        yield from unset(spec, "load.guide_friction", why)
    if spec.output.turns:
        why = "is a rack's; the load of a wheel is inertia_kgm2 and torque_Nm"
        yield from unset(spec, "load.mass_kg load.force_N", why)
        return
    its = "is for a wheel on a shaft, and not available for a rack"
    yield from unset(spec, OF_A_SHAFT, its)
    yield spec.mass, ("mass",), f"[[mass]] {its}: remove it"
