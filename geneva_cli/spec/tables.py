"""The spec's tables and keys: type, default, range and meaning, one line each.

A key that is a Python keyword ends in an underscore here. ``None`` means: derived from the rest.
"""

from __future__ import annotations

import os
from typing import Annotated, NamedTuple

from geneva_cli.spec.rules import FINITE, LENGTH, NOT_NEGATIVE, POSITIVE, SPEED, Z_MAX, OneOf, Range

Z_USUAL = 24  # above it the slots leave little of a wheel: a warning


class Wheel(NamedTuple):
    """``[wheel]``."""

    z: Annotated[int, Range(3, Z_MAX), "number of slots"]
    gearing: Annotated[
        str, OneOf(("external", "internal", "spherical")), "where the crank turns"
    ] = "external"
    axes_deg: Annotated[
        float, Range(0.0, 180.0, "()"), "spherical: angle between the two shafts"
    ] = 90.0
    offset_mm: Annotated[
        float, LENGTH, "how far the slots' axes miss the wheel's centre; > 0 enters gently"
    ] = 0.0
    steps_deg: Annotated[
        tuple[float, ...] | None, Range(0.0, 360.0, "()"), "unequal steps, a repeating pattern"
    ] = None
    held_by: Annotated[
        str | None,
        OneOf(("brake", "detent", "pin")),
        "what holds the wheel at rest, where no locking disc does",
    ] = None


class Drive(NamedTuple):
    """``[drive]``: the keys common to all kinds."""

    kind: Annotated[str, None, "what turns the crank"] = "crank"
    n_rpm: Annotated[float, SPEED, "speed of the input shaft, constant"] = 60.0
    rollers: Annotated[int, Range(1, Z_MAX), "rollers on the crank, m"] = 1
    roller_angles_deg: Annotated[
        tuple[float, ...] | None, Range(0.0, 360.0, "[)"), "where they stand, if not evenly"
    ] = None


class Motion(NamedTuple):
    """``[motion]``: present when the motion is given and the slots are solved for."""

    law: Annotated[str | None, None, "motion law of curved slots (`geneva laws`)"] = None
    lambda_: Annotated[float, Range(-10.0, 10.0), "shape of the sine-group law"] = 0.0
    file: Annotated[str | None, None, "CSV of u,s points for the law `table`"] = None
    alpha0_deg: Annotated[float, FINITE, "extra dwell angle of the crank"] = 0.0
    ratio: Annotated[
        float | str | None, Range(0.0, 1.0, "()"), 'R/L of curved slots, or "matched"'
    ] = None


class Size(NamedTuple):
    """``[size]``."""

    center_distance_mm: Annotated[
        float, POSITIVE, "centre distance L (spherical: the sphere's radius)"
    ] = 100.0
    roller_radius_mm: Annotated[float | None, POSITIVE, "roller radius r; L/20 if not given"] = None
    slot_clearance_mm: Annotated[float, NOT_NEGATIVE, "per side, roller to slot"] = 0.0
    lock_clearance_mm: Annotated[float, NOT_NEGATIVE, "per side, locking disc to wheel"] = 0.0
    face_width_mm: Annotated[float | None, POSITIVE, "length of the roller's line of contact"] = (
        None
    )
    wheel_radius_mm: Annotated[
        float | None, POSITIVE, "rim of the wheel (inside: of its opening); where a roller enters"
    ] = None
    wheel_outer_radius_mm: Annotated[
        float | None,
        POSITIVE,
        "internal: the outside of the wheel; a roller's width past the slots",
    ] = None
    slot_bottom_clearance_mm: Annotated[
        float | None, NOT_NEGATIVE, "straight slots: deepest roller to the slot's end; r/20"
    ] = None
    lock_radius_mm: Annotated[
        float | None,
        NOT_NEGATIVE,
        "locking disc, 0 for none; leaves a horn as thick as r if it can",
    ] = None
    relief: Annotated[
        str | None, OneOf(("arc", "sector")), "cut of the locking disc; what clears"
    ] = None
    relief_clearance_mm: Annotated[
        float | None, NOT_NEGATIVE, "wheel to the bottom of the relief; L/200"
    ] = None
    wall_min_mm: Annotated[
        float | None, NOT_NEGATIVE, "least wall that `check` lets pass; L/200"
    ] = None
    wheel_bore_mm: Annotated[float | None, NOT_NEGATIVE, "diameter of the wheel's bore"] = None
    wheel_hub_mm: Annotated[
        float | None, NOT_NEGATIVE, "diameter of the wheel's hub on the roller's side"
    ] = None
    crank_bore_mm: Annotated[
        float | None,
        NOT_NEGATIVE,
        "diameter of the crank's bore; 0: no shaft through the wheel's plane",
    ] = None
    crank_hub_mm: Annotated[
        float | None, NOT_NEGATIVE, "diameter of the crank's hub in the wheel's plane"
    ] = None
    pin_mm: Annotated[float | None, NOT_NEGATIVE, "diameter of the roller's pin; r"] = None


class Load(NamedTuple):
    """``[load]``."""

    inertia_kgm2: Annotated[float, NOT_NEGATIVE, "of everything the wheel turns"] = 0.0
    torque_Nm: Annotated[float, NOT_NEGATIVE, "torque that resists motion"] = 0.0
    efficiency: Annotated[float, Range(0.0, 1.0, "(]"), "eta of the wheel"] = 1.0
    friction: Annotated[float, NOT_NEGATIVE, "roller against slot, coefficient"] = 0.0
    youngs_modulus_GPa: Annotated[float, POSITIVE, "of roller and wheel"] = 210.0
    poisson_ratio: Annotated[float, Range(0.0, 0.5), "of roller and wheel"] = 0.3


class Limits(NamedTuple):
    """``[limits]``: what ``geneva check`` holds the design against."""

    velocity_max: Annotated[float | None, POSITIVE, "invariant"] = None
    acceleration_max: Annotated[float | None, POSITIVE, "invariant"] = None
    acceleration_entry_max: Annotated[float | None, POSITIVE, "invariant"] = None
    jerk_max: Annotated[float | None, POSITIVE, "invariant"] = None
    pin_force_max_N: Annotated[float | None, POSITIVE, "roller on slot"] = None
    input_torque_max_Nm: Annotated[float | None, POSITIVE, "on the input shaft"] = None
    pressure_angle_max_deg: Annotated[float | None, Range(0.0, 90.0, "(]"), "of the slot"] = None
    contact_stress_max_MPa: Annotated[float | None, POSITIVE, "Hertz, line contact"] = None


class Spec(NamedTuple):
    """A whole spec, as read from a file or put together from options."""

    wheel: Wheel
    drive: Drive = Drive()
    kind: NamedTuple | None = None  # the drive's own keys
    motion: Motion = Motion()
    size: Size = Size()
    load: Load = Load()
    limits: Limits = Limits()
    title: str = ""
    path: str = ""  # of the file, for messages and for the files it names

    def beside(self, name: str) -> str:
        """The path of a file that the spec names, relative to the spec itself."""
        return os.path.join(os.path.dirname(self.path), name)

    @property
    def files(self) -> tuple[str, ...]:
        """The files that the design is read from, which no output may replace."""
        named = [self.motion.file, getattr(self.kind, "ratio_file", None)]
        return (self.path, *[self.beside(name) for name in named if name])

    @property
    def roller_radius_mm(self) -> float:
        """The roller's radius r, by default L/20."""
        given = self.size.roller_radius_mm
        return self.size.center_distance_mm / 20.0 if given is None else given
