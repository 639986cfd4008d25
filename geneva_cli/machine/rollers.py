"""Which roller moves the wheel when: the rollers on the crank, and the steps that they make."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine import kinds
from geneva_cli.machine.wheels import poses as gearing
from geneva_cli.machine.wheels.classic import half_motion_deg, refuse_jam
from geneva_cli.machine.wheels.offset_slot import skew
from geneva_cli.spec.tables import Spec

AXES_MIN = 1e-6  # degrees
A_MAX = 1.0 - 0.999e-12  # of a side-crank's offset, and of the eccentricity of ellipses
LOADED = ("pin_force_max_N", "input_torque_max_Nm", "contact_stress_max_MPa")  # limits on loads


class Place(NamedTuple):
    """One roller: the crank angle at which it crosses the line of centres, and its step."""

    crank_deg: float
    step: gearing.Step
    half_motion_deg: float
    reach_deg: float  # farthest from the line of centres that its crank moves the wheel
    ratio: float  # of its arm to the centre distance
    offset: float  # of its slot, in units of the centre distance


def places(spec: Spec) -> list[Place]:
    """The rollers of a machine with straight slots, in the order in which they move the wheel.

    Rollers that move the wheel alike are given once. Raises GenevaError where they would jam.
    """
    wheel, drive = spec.wheel, spec.drive
    m = drive.rollers
    if wheel.steps_deg:
        return _unequal(spec)
    step = gearing.Step(1, wheel.z)
    one = _place(spec, 0.0, step)
    if drive.roller_angles_deg:
        return _at_angles(spec, one)
    refuse_jam(m, 2.0 * one.half_motion_deg, wheel.gearing)
    alike = drive.kind == "crank"
    return [one._replace(crank_deg=360.0 * j / m) for j in range(1 if alike else m)]


def _place(spec: Spec, crank_deg: float, step: gearing.Step) -> Place:
    wheel = spec.wheel
    if wheel.gearing == "spherical":
        ball = gearing.sphere(step, wheel.axes_deg)
        half = ball.half_motion_deg
        return Place(crank_deg, step, half, half, ball.sin_th, 0.0)
    e = wheel.offset_mm / spec.size.center_distance_mm
    if e:
        try:
            entry, _, exit_ = skew(step, e).poses
        except ValueError:
            # b + |d| < 90 degrees means |e| < 1 - l; at the limit e = cos b sin d, d = 90 deg - b
            limit = step.sin_cos[1] ** 2 * spec.size.center_distance_mm
            raise GenevaError(
                f"offset_mm = {wheel.offset_mm:g}: the roller cannot enter such a slot without "
                f"shock; its size must be below {limit:.6g}",
                ("wheel", "offset_mm"),
            ) from None
        half = half_motion_deg("external", *step)
        reach = max(-entry.crank_deg, exit_.crank_deg)
        return Place(crank_deg, step, half, reach, exit_.slope[0], e)
    half = half_motion_deg(wheel.gearing, *step)
    return Place(crank_deg, step, half, half, step.sin_cos[0], 0.0)


def _at_angles(spec: Spec, one: Place) -> list[Place]:
    """Rollers at given angles: each gap must leave room for half of both motions beside it."""
    angles = spec.drive.roller_angles_deg or ()
    key = ("drive", "roller_angles_deg")
    if list(angles) != sorted(set(angles)) or angles[0] != 0.0 or angles[-1] >= 360.0:
        raise GenevaError("roller_angles_deg must rise from 0 to below 360", key)
    motion = 2.0 * one.half_motion_deg
    for a, b in zip(angles, (*angles[1:], 360.0), strict=True):
        if b - a < motion:
            raise GenevaError(
                f"the rollers at {a:g} and {b % 360.0:g} deg jam: their motions take "
                f"{motion:.6g} deg, and there are {b - a:.6g} between them",
                key,
            )
    if motion * len(angles) >= 360.0:
        raise GenevaError(f"{len(angles)} motions of {motion:.6g} deg leave no dwell at all", key)
    return [one._replace(crank_deg=a) for a in angles]


def _unequal(spec: Spec) -> list[Place]:
    """Rollers of different arms, R_i = L sin b_i, with equal dwells between their motions."""
    steps = spec.wheel.steps_deg or ()
    found = []
    for degrees in steps:
        p, q = degrees.as_integer_ratio()
        found.append(_place(spec, 0.0, gearing.Step(p, 360 * q)))
    total = math.fsum(2.0 * f.half_motion_deg for f in found)
    if not total < 360.0:
        raise GenevaError(
            f"the {len(steps)} motions take {total:.6g} deg of a turn together and leave no dwell; "
            "fewer rollers (a shorter pattern), or fewer slots, are needed",
            ("wheel", "steps_deg"),
        )
    dwell = (360.0 - total) / len(steps)
    out, at = [], 0.0
    for i, place in enumerate(found):
        if i:
            at += found[i - 1].half_motion_deg + dwell + place.half_motion_deg
        out.append(place._replace(crank_deg=at))
    return out


def refuse_layout(spec: Spec) -> None:
    """Raise GenevaError for keys that make no sense together, saying why."""
    wheel, drive = spec.wheel, spec.drive
    given = spec.motion.law is not None
    path = kinds.own_path(drive.kind)
    if wheel.axes_deg != 90.0 and wheel.gearing != "spherical":
        raise GenevaError(
            'axes_deg goes with gearing = "spherical": other wheels have parallel shafts',
            ("wheel", "axes_deg"),
        )
    if spec.limits.contact_stress_max_MPa is not None and spec.size.face_width_mm is None:
        raise GenevaError(
            "contact_stress_max_MPa needs the length of the line of contact: set face_width_mm "
            "in [size]",
            ("limits", "contact_stress_max_MPa"),
        )
    if not (spec.load.inertia_kgm2 or spec.load.torque_Nm):
        for key in LOADED:
            if getattr(spec.limits, key) is not None:
                raise GenevaError(
                    f"{key} needs a load, and without one there is nothing to limit: set "
                    "inertia_kgm2 or torque_Nm in [load]",
                    ("limits", key),
                )
    A = getattr(spec.kind, "A", None)
    if A is not None and abs(A) > A_MAX:
        raise GenevaError(
            f"A = {A!r}: so near to 1 the motion is rounding; its size must be at most 1 - 1e-12",
            ("drive", "A"),
        )
    e = getattr(spec.kind, "eccentricity", None)
    if e is not None and e > A_MAX:
        raise GenevaError(
            f"eccentricity = {e!r}: so near to 1 the motion is rounding; it must be at most "
            "1 - 1e-12",
            ("drive", "eccentricity"),
        )
    if not AXES_MIN <= wheel.axes_deg <= 180.0 - AXES_MIN:
        raise GenevaError(
            f"axes_deg = {wheel.axes_deg:g}: the shafts are parallel but for rounding; it must be "
            f'at least {AXES_MIN:g} away from 0 and 180, or the gearing "external" or "internal"',
            ("wheel", "axes_deg"),
        )
    if wheel.offset_mm and wheel.gearing != "external":
        raise GenevaError(
            f'offset slots are for external wheels; with gearing = "{wheel.gearing}" set '
            "offset_mm = 0",
            ("wheel", "offset_mm"),
        )
    if wheel.offset_mm and wheel.steps_deg:
        raise GenevaError("offset_mm with steps_deg: choose one of them", ("wheel", "offset_mm"))
    if given and (wheel.offset_mm or wheel.steps_deg):
        key = "offset_mm" if wheel.offset_mm else "steps_deg"
        raise GenevaError(
            f"{key} shapes straight slots; with a law the slots are solved for (remove one)",
            ("wheel", key),
        )
    if path and (wheel.offset_mm or wheel.steps_deg or drive.roller_angles_deg):
        raise GenevaError(
            f'kind = "{drive.kind}" has one roller and radial slots: remove offset_mm, steps_deg '
            "and roller_angles_deg",
            ("drive", "kind"),
        )
    if path and wheel.gearing not in ("external", *(("internal",) if drive.kind == "cam" else ())):
        raise GenevaError(
            f'kind = "{drive.kind}" drives an external wheel, not gearing = "{wheel.gearing}"',
            ("wheel", "gearing"),
        )
    if given and wheel.gearing == "spherical":
        raise GenevaError(
            "curved slots are flat; a spherical wheel has straight ones (remove law)",
            ("motion", "law"),
        )
    if path and drive.rollers > 1 and drive.kind != "cam":
        raise GenevaError(f'kind = "{drive.kind}" carries one roller', ("drive", "rollers"))
    if path and given and drive.kind != "cam":
        raise GenevaError(
            f'kind = "{drive.kind}" gives the roller its path, and the slots are straight; a law '
            "would be one too many",
            ("motion", "law"),
        )
    _refuse_rollers(spec, given)
    if wheel.steps_deg:
        _refuse_steps(spec)
    several = drive.rollers > 1 or drive.roller_angles_deg or wheel.steps_deg
    if several and kinds.turns(spec) > 1:
        where = "rollers" if drive.rollers > 1 else "kind"
        raise GenevaError(f'kind = "{drive.kind}" carries one roller', ("drive", where))


def _refuse_rollers(spec: Spec, given: bool) -> None:
    drive = spec.drive
    count = len(spec.wheel.steps_deg or drive.roller_angles_deg or ())
    if count and drive.rollers not in (1, count):
        raise GenevaError(
            f"rollers = {drive.rollers}, but there are {count} "
            f"{'steps' if spec.wheel.steps_deg else 'angles'} for them; leave rollers out",
            ("drive", "rollers"),
        )
    if given and drive.roller_angles_deg:
        raise GenevaError(
            "roller_angles_deg is for straight slots; remove the law or the angles",
            ("drive", "roller_angles_deg"),
        )
    if given and drive.rollers > 1 and drive.kind not in ("crank", "cam"):
        raise GenevaError(
            f"{drive.rollers} rollers on a {drive.kind} move the wheel differently, so one curved "
            "slot cannot serve them all; use rollers = 1, or straight slots (no law)",
            ("drive", "rollers"),
        )


def _refuse_steps(spec: Spec) -> None:
    """The pattern must close over the wheel."""
    steps, z = spec.wheel.steps_deg or (), spec.wheel.z
    key = ("wheel", "steps_deg")
    if spec.wheel.gearing != "external":
        raise GenevaError("unequal steps are for external wheels", key)
    if spec.drive.roller_angles_deg:
        raise GenevaError("steps_deg places the rollers itself; remove roller_angles_deg", key)
    if z % len(steps):
        raise GenevaError(
            f"z = {z} is no multiple of the pattern's {len(steps)} steps; "
            f"{_multiples(z, len(steps))} would be",
            key,
        )
    turn = math.fsum(steps) * z / len(steps)
    if abs(turn - 360.0) > 1e-9:
        raise GenevaError(
            f"the pattern, {z // len(steps)} times over the wheel, adds up to {turn:.12g} deg; it "
            f"must be 360, so its steps {360.0 * len(steps) / z:.12g}",
            key,
        )
    if max(steps) >= 180.0:
        raise GenevaError(f"a step of {max(steps):g} deg is out of reach; below 180", key)


def _multiples(z: int, n: int) -> str:
    """The multiples of n on both sides of z that are numbers of slots."""
    near = [m for m in (z // n * n, (z // n + 1) * n) if m >= 3]
    return " or ".join(str(m) for m in near)
