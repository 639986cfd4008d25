"""Straight slots: the plain crank, also with offset slots, and drives in front of the crank.

A side-crank, gears and a planet with the roller have one roller: several would move the wheel
differently. On a sphere the angle between the shafts determines the motion.

A natural motion phi_2 is that of the plain crank, 180 deg - 2b outside and 180 deg + 2b inside;
phi_1 is the required one. All angles are input angles in degrees. Sources: the law of sines in the
coulisse's triangle (formula (1) of Polyudov and Kandyak, "Kinematics of the Maltese cross mechanism
with a side-crank drive"), and the focal property of equal ellipses.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from geneva_cli.drives.crank import Crank
from geneva_cli.drives.epicyclic import Epicyclic
from geneva_cli.drives.gears import EllipticalGears
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.drives.transmission import Transmission
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.registry import families_of_kinds
from geneva_cli.motion.wheels.classic import half_motion_deg, rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import DEGREE, sin_cos_pi
from geneva_cli.numerics.arrays import Array
from geneva_cli.study.synth.families.family import Family, is_compatible, natural_deg
from geneva_cli.study.target import AllowedSpan, Target

AXES = AllowedSpan(1.0, 179.0)  # angles between the shafts of a spherical wheel, degrees
MOST = 0.9999  # greatest |A| and eccentricity: beyond, the drive nearly stops or jumps


def side_crank(natural_deg: float, motion_deg: float) -> float:
    """A = sin((phi_1 - phi_2)/2) / sin(phi_2/2), which increases with the motion.

    Infinite if no A makes a motion of this length.
    """
    turn = 0.5 * (motion_deg - natural_deg) * DEGREE  # angle between input crank and coulisse
    if not abs(turn) < 0.5 * math.pi:
        return math.copysign(math.inf, turn)
    return math.sin(turn) / math.sin(0.5 * natural_deg * DEGREE)


def axes(z: int, motion_deg: float) -> float:
    """Angle between a spherical wheel's shafts, degrees: cos S = cot b cot(phi_1/2).

    It follows from cos(phi_1/2) = tan th / tan S and sin th = sin S sin b (th: the crank's cone).
    The code uses sin S as well, so that small angles keep their digits: -cos(phi_1/2 + b)
    cos(phi_1/2 - b) is the square of sin S sin b sin(phi_1/2). The angle increases with the motion,
    from 0 for that of parallel shafts outside, 180 deg - 2b, to 180 for that inside.
    """
    a, (b, (_, cos_b)) = 0.5 * motion_deg * DEGREE, (math.pi / z, sin_cos_pi(1, z))
    square = -math.cos(a + b) * math.cos(a - b)
    if square <= 0.0:
        return 0.0 if motion_deg < 180.0 else 180.0
    return math.atan2(math.sqrt(square), math.cos(a) * cos_b) / DEGREE


def eccentricity(natural_deg: float, motion_deg: float) -> float:
    """Eccentricity of equal ellipses: tan(phi_1/4) = (1+e)/(1-e) tan(phi_2/4).

    It is negative in the quick phase. Solved for e: sin((phi_1 - phi_2)/4) / sin((phi_1 +
    phi_2)/4), which holds for phi_2 above 180 too.
    """
    quarter = 0.25 * DEGREE
    return math.sin((motion_deg - natural_deg) * quarter) / math.sin(
        (motion_deg + natural_deg) * quarter
    )


class _InFront(NamedTuple):
    """A drive before the crank: its key, and its parameter by the plain motion and a motion."""

    drive: Transmission
    key: str
    parameter: Callable[[float, float], float]
    low: float = -MOST
    high: float = MOST

    def keys(self, at: Array) -> dict[str, Array]:
        """The key of parameters (n,); of gears the sign of the eccentricity is the phase."""
        return {self.key: at if self.low * self.high else abs(at)}


SLOW, QUICK = (EllipticalGears(eccentricity=0.1, phase=phase) for phase in ("slow", "quick"))
IN_FRONT = (
    _InFront(SideCrank(A=0.0), "drive.A", side_crank),
    _InFront(SLOW, "drive.eccentricity", eccentricity, low=0.0),
    _InFront(QUICK, "drive.eccentricity", eccentricity, high=0.0),
)


def straight(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """The families with straight slots."""
    for wheel in wheels:
        for m in _natural_rollers(target, natural_deg(wheel)):
            yield Family(target.machine(wheel, Crank(rollers=m)))
            if m == 1:
                yield from planets(target, wheel)
        yield from driven(target, wheel)
        kinds = families_of_kinds("straight") if target.rollers in (None, 1) else ()
        for kind in (*families_of_kinds("wheel", wheel.NAME), *kinds):
            yield from kind(target, wheel)


def _natural_rollers(target: Target, natural: float) -> list[int]:
    """The numbers of rollers for which the plain crank's motion is allowed."""
    several = [target.rollers] if target.rollers else range(1, rollers_max(natural) + 1)
    return [m for m in several if target.motions(m, natural).allows(natural)]


def offset_slots(target: Target, wheel: Gearing) -> Iterator[Family]:
    """Offset slots, which miss the wheel's centre by a tenth of L, for a gentler entry.

    With bounds or another goal, every other offset is possible too.
    """
    tenth = 0.1
    for m in _natural_rollers(target, natural_deg(wheel)):
        spec = target.machine(wheel, Crank(rollers=m))
        keys = partial(_offset, spec)
        yield Family(spec, keys, tenth, tenth)
        if target.bounds or target.sort:
            widest = MOST * wheel.step.sin_cos[1] ** 2
            yield Family(spec, keys, -widest, widest, tenth, 0.0)


def _offset(spec: Spec, at: Array) -> dict[str, Array]:
    """The key of offsets over L; with a given crank radius, L = R / (sin b cos d) grows with it."""
    L = spec.given_distance_mm
    if spec.size.derived_distance_mm is None:
        return {"wheel.offset_mm": L * at}
    return {"wheel.offset_mm": L * at / np.sqrt(1.0 - (at / spec.wheel.step.sin_cos[1]) ** 2)}


def planets(target: Target, wheel: Gearing) -> Iterator[Family]:
    """A roller on a planet: without a jump at entry, and with a free crank of the planet."""
    z = wheel.z
    if z not in (3, 4, 6):
        return

    for fixed in ("sun", "ring"):
        shockless = target.machine(wheel, Epicyclic(planet_ratio="shockless", fixed=fixed))
        if not is_compatible(shockless):
            return
        yield Family(shockless)
        l, teeth = sin_cos_pi(1, z)[0], 2 * z // (z - 2)
        c = 1.0 + teeth if fixed == "sun" else 1.0 - teeth
        least = -l / (1.0 + c if c > 0.0 else teeth) * (1.0 - 1e-6)
        most = l / (c * c - 1.0) * (1.0 - 1e-9)
        spec = shockless.with_("drive.planet_ratio", most)
        yield Family(spec, lambda at: {"drive.planet_ratio": at}, least, most, known=0.0)


def driven(target: Target, wheel: Gearing) -> Iterator[Family]:
    """Changes of the plain crank's motion by a drive in front of it."""
    natural = natural_deg(wheel)
    motion = target.free_motions(1, natural) if target.rollers in (None, 1) else None
    if motion is None or (motion.exact and motion.allows(natural)):
        return
    known = 0.0 if motion.allows(natural) else math.nan
    for one in IN_FRONT:
        span = AllowedSpan(*(one.parameter(natural, x) for x in motion))
        span = span.within(AllowedSpan(one.low, one.high))
        if not span.empty:
            spec = target.machine(wheel, one.drive)
            if one.parameter is eccentricity:  # gears are as far apart as wheel and crank
                spec = spec.with_("drive.gear_distance_mm", spec.given_distance_mm)
            yield Family(spec, one.keys, *span, 0.0, known)


def inclined(target: Target, wheel: Gearing) -> Iterator[Family]:
    """Plain cranks on shafts that are not at right angles."""
    z = wheel.z
    least = 2.0 * half_motion_deg(1.0, 1, z)
    for m in [target.rollers] if target.rollers else range(1, rollers_max(least) + 1):
        free = target.free_motions(m, 180.0)
        if free is None or (free.exact and free.allows(180.0)):
            continue
        span = AllowedSpan(*(axes(z, x) for x in free)).within(AXES)
        if not span.empty:
            known = 90.0 if free.allows(180.0) else math.nan
            spec = target.machine(wheel, Crank(rollers=m))
            yield Family(spec, lambda at: {"wheel.axes_deg": at}, *span, 90.0, known)
