"""The spec's tables and keys: type, default, range and meaning, one line each.

A key that is a Python keyword ends in an underscore here. ``None`` means: derived from the rest.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

from geneva_cli.spec.rules import NOT_NEGATIVE, POSITIVE, OneOf, Range
from geneva_cli.spec.schema import Table

DISTANCE_MM = 100.0  # the centre distance of a spec that gives none
Z_DRAWN = 360  # slots of a wheel that is drawn: one a degree
Z_USUAL = 24  # above it the slots leave little of a wheel: a warning


@dataclass(frozen=True)
class Size(Table):
    """``[size]``."""

    TABLE: ClassVar[str] = "size"

    center_distance_mm: Annotated[
        float | None,
        POSITIVE,
        "centre distance L (spherical: the sphere's radius), 100; linkages solve for it",
    ] = None
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


@dataclass(frozen=True)
class Load(Table):
    """``[load]``."""

    TABLE: ClassVar[str] = "load"

    inertia_kgm2: Annotated[float, NOT_NEGATIVE, "of everything the wheel turns"] = 0.0
    torque_Nm: Annotated[float, NOT_NEGATIVE, "torque that resists motion"] = 0.0
    efficiency: Annotated[float, Range(0.0, 1.0, "(]"), "eta of the wheel"] = 1.0
    friction: Annotated[float, NOT_NEGATIVE, "roller against slot, coefficient"] = 0.0
    youngs_modulus_GPa: Annotated[float, POSITIVE, "of roller and wheel"] = 210.0
    poisson_ratio: Annotated[float, Range(0.0, 0.5), "of roller and wheel"] = 0.3


@dataclass(frozen=True)
class Limits(Table):
    """``[limits]``: what ``geneva check`` holds the design against."""

    TABLE: ClassVar[str] = "limits"

    velocity_max: Annotated[float | None, POSITIVE, "invariant"] = None
    acceleration_max: Annotated[float | None, POSITIVE, "invariant"] = None
    acceleration_entry_max: Annotated[float | None, POSITIVE, "invariant"] = None
    jerk_max: Annotated[float | None, POSITIVE, "invariant"] = None
    pin_force_max_N: Annotated[float | None, POSITIVE, "roller on slot"] = None
    input_torque_max_Nm: Annotated[float | None, POSITIVE, "on the input shaft"] = None
    pressure_angle_max_deg: Annotated[float | None, Range(0.0, 90.0, "(]"), "of the slot"] = None
    contact_stress_max_MPa: Annotated[float | None, POSITIVE, "Hertz, line contact"] = None
