"""The rollers on the crank: the place of each, and the step of the wheel that it drives."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError, refuse_text
from geneva_cli.motion.wheels.classic import refuse_jam
from geneva_cli.motion.wheels.gearing import Gearing, RollerPlace
from geneva_cli.motion.wheels.poses import HalfStep

if TYPE_CHECKING:
    from geneva_cli.motion.drive import Drive

ANGLES_KEY = ("drive", "roller_angles_deg")


def places(wheel: Gearing, drive: Drive, L: float) -> list[RollerPlace]:
    """Rollers of a machine with straight slots, in the order in which they move the wheel.

    Rollers that move the wheel alike are returned as one. Raises GenevaError if rollers would jam.
    """
    if not wheel.steps:
        return alike(wheel, drive, wheel.place(wheel.step, L))
    # on different arms: R_i = L sin b_i
    rollers = [wheel.place(HalfStep.of_deg(0.5 * step), L) for step in wheel.steps]
    _refuse_no_dwell(rollers, ("wheel", "steps_deg"))
    if drive.roller_angles_deg:
        return _at_angles(drive.roller_angles_deg, rollers)
    # placed so that the dwells between their motions are equal
    total = math.fsum(2.0 * one.half_motion_deg for one in rollers)
    dwell, at, out = (360.0 - total) / len(rollers), 0.0, rollers[:1]
    for before, one in pairwise(rollers):
        at += before.half_motion_deg + dwell + one.half_motion_deg
        out.append(one._replace(crank_deg=at))
    return out


def alike(wheel: Gearing, drive: Drive, one: RollerPlace) -> list[RollerPlace]:
    """Rollers of a machine that all pass the slots as ``one`` does, as ``places`` returns them."""
    m, angles = drive.rollers, drive.roller_angles_deg
    if angles:
        return _at_angles(angles, [one] * len(angles))
    refuse_jam(m, 2.0 * one.half_motion_deg, wheel.SIGN < 0.0)
    return [one._replace(crank_deg=360.0 * j / m) for j in range(drive.motions)]


def _at_angles(angles: tuple[float, ...], rollers: list[RollerPlace]) -> list[RollerPlace]:
    """Rollers at the angles of the spec, each gap wide enough for half of both adjacent motions."""
    if list(angles) != sorted(set(angles)) or angles[0] != 0.0 or angles[-1] >= 360.0:
        raise GenevaError("roller_angles_deg must rise from 0 to below 360", ANGLES_KEY)
    text = (
        "the rollers at {a:g} and {b:g} deg jam: half of both motions takes {motions:.6g} deg, and "
        "they are {apart:.6g} deg apart"
    )

    following = (*angles[1:], 360.0), (*rollers[1:], rollers[0])
    for a, one, b, after in zip(angles, rollers, *following, strict=True):
        motions = one.half_motion_deg + after.half_motion_deg
        values = {"a": a, "b": b % 360.0, "motions": motions, "apart": b - a}
        refuse_text(b - a < motions, ANGLES_KEY, text, **values)
    _refuse_no_dwell(rollers, ANGLES_KEY)
    return [one._replace(crank_deg=a) for a, one in zip(angles, rollers, strict=True)]


def _refuse_no_dwell(rollers: list[RollerPlace], key: tuple[str, str]) -> None:
    """Raise GenevaError if the motions of all rollers take a whole turn."""
    total = sum(2.0 * one.half_motion_deg for one in rollers)
    text = "the {count} motions together take {total:.6g} deg of a turn and leave no dwell: use "
    text += "fewer rollers, or a shorter pattern of steps"
    refuse_text(total >= 360.0, key, text, count=len(rollers), total=total)
