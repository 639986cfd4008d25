"""The rollers on the crank: the place of each, and the step of the wheel that it drives."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError, refuse
from geneva_cli.kinematics.wheels.classic import refuse_jam
from geneva_cli.kinematics.wheels.gearing import Gearing, RollerPlace
from geneva_cli.kinematics.wheels.poses import HalfStep

if TYPE_CHECKING:
    from geneva_cli.kinematics.drive import Drive


ANGLES_KEY = ("drive", "roller_angles_deg")


def places(wheel: Gearing, drive: Drive, L: float) -> list[RollerPlace]:
    """Rollers of a machine with straight slots, in the order in which they move the wheel.

    Rollers that move the wheel alike are returned as one. Raises GenevaError if rollers would jam.
    """
    m = drive.rollers
    if wheel.steps:
        return _unequal(wheel, L)
    one = wheel.place(wheel.step, L)
    if drive.roller_angles_deg:
        return _at_angles(drive.roller_angles_deg, one)
    refuse_jam(m, 2.0 * one.half_motion_deg, wheel.SIGN < 0.0)
    return [one._replace(crank_deg=360.0 * j / m) for j in range(1 if drive.ALIKE else m)]


def _at_angles(angles: tuple[float, ...], one: RollerPlace) -> list[RollerPlace]:
    """Rollers at the angles of the spec, each gap wide enough for half of both adjacent motions."""
    if list(angles) != sorted(set(angles)) or angles[0] != 0.0 or angles[-1] >= 360.0:
        raise GenevaError("roller_angles_deg must rise from 0 to below 360", ANGLES_KEY)
    motion = 2.0 * one.half_motion_deg
    for a, b in zip(angles, (*angles[1:], 360.0), strict=True):
        refuse(b - a < motion, partial(_too_near, a, b, motion))
    refuse(
        motion * len(angles) >= 360.0,
        lambda: GenevaError(
            f"{len(angles)} motions of {motion:.6g} deg each leave no dwell in a turn", ANGLES_KEY
        ),
    )
    return [one._replace(crank_deg=a) for a in angles]


def _too_near(a: float, b: float, motion: float) -> GenevaError:
    return GenevaError(
        f"the rollers at {a:g} and {b % 360.0:g} deg jam: each motion takes "
        f"{motion:.6g} deg, and they are {b - a:.6g} deg apart",
        ANGLES_KEY,
    )


def _unequal(wheel: Gearing, L: float) -> list[RollerPlace]:
    """Rollers on different arms, R_i = L sin b_i, with equal dwells between their motions."""
    rollers, steps = [], wheel.steps
    for degrees in steps:
        p, q = degrees.as_integer_ratio()
        rollers.append(wheel.place(HalfStep(p, 360 * q), L))
    total = math.fsum(2.0 * f.half_motion_deg for f in rollers)
    if not total < 360.0:
        raise GenevaError(
            f"the {len(steps)} motions together take {total:.6g} deg of a turn and leave no dwell: "
            "use a shorter pattern or fewer slots",
            ("wheel", "steps_deg"),
        )
    dwell = (360.0 - total) / len(steps)
    out, at = [], 0.0
    for i, place in enumerate(rollers):
        if i:
            at += rollers[i - 1].half_motion_deg + dwell + place.half_motion_deg
        out.append(place._replace(crank_deg=at))
    return out
