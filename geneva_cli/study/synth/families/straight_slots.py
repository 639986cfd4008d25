"""Straight slots: the plain crank, also with offset slots, and drives in front of the crank.

A side-crank, gears and a planet with the roller have one roller: several would move the wheel
differently. On a sphere the angle between the shafts determines the motion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from geneva_cli.drives.crank import Crank
from geneva_cli.drives.elliptical_gears import EllipticalGears
from geneva_cli.drives.epicyclic import Epicyclic
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.records import families_of_kinds
from geneva_cli.motion.wheels.classic import half_motion_deg, rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import sin_cos_pi
from geneva_cli.study.spans import AllowedSpan
from geneva_cli.study.synth.families import closed
from geneva_cli.study.synth.families.family import (
    Family,
    allowed_motions,
    allows,
    center_distance_mm,
    closed_span,
    is_compatible,
    machine,
    natural_deg,
    only,
    rollers,
)
from geneva_cli.study.target import Target


def straight(target: Target, wheel: Gearing) -> Iterator[Family]:
    """The families with straight slots."""
    natural = natural_deg(wheel)
    for m in rollers(target, natural):
        motion = allowed_motions(target, m, natural)
        if allows(motion, natural):
            yield only(plain(target, wheel, m))
            yield from offset_slots(target, wheel, m)
            if m == 1:
                yield from planets(target, wheel)
    yield from driven(target, wheel)
    if target.rollers in (None, 1):
        for kind in families_of_kinds("straight"):
            yield from kind(target, wheel)


def plain(target: Target, wheel: Gearing, m: int) -> Spec:
    """The plain crank."""
    natural = natural_deg(wheel)
    return machine(target, wheel, lambda n: Crank(n_rpm=n, rollers=m), m, natural)


def offset_slots(target: Target, wheel: Gearing, m: int) -> Iterator[Family]:
    """Offset slots, which miss the wheel's centre by a tenth of L, for a gentler entry.

    With bounds or another goal, every other offset is possible too.
    """
    if "offset_mm" not in wheel.as_dict():
        return
    make = partial(_offset, plain(target, wheel, m))
    tenth = 0.1
    yield Family(make, tenth, tenth)
    if target.limits or target.sort:
        widest = closed.PARAMETER_MAX * wheel.step.sin_cos[1] ** 2
        yield Family(make, -widest, widest, known=0.0, plain=tenth)


def _offset(spec: Spec, fraction: float) -> Spec:
    """A spec with slots offset by a fraction of the centre distance."""
    return spec.with_("wheel.offset_mm", spec.given_distance_mm * fraction)


def planets(target: Target, wheel: Gearing) -> Iterator[Family]:
    """A roller on a planet: without a jump at entry, and with a free crank of the planet."""
    z = wheel.z
    if z not in (3, 4, 6):
        return
    for fixed in ("sun", "ring"):
        make = partial(_on_planet, target, wheel, fixed)
        shockless = make("shockless")
        if not is_compatible(shockless):
            return
        yield only(shockless)
        l, teeth = sin_cos_pi(1, z)[0], 2 * z // (z - 2)
        c = 1.0 + teeth if fixed == "sun" else 1.0 - teeth
        least = -l / (1.0 + c if c > 0.0 else teeth)
        inside = least * (1.0 - 1e-6), l / (c * c - 1.0) * (1.0 - 1e-9)
        yield Family(make, *inside, known=0.0)


def _on_planet(target: Target, wheel: Gearing, fixed: str, ratio: float | str) -> Spec:
    """A roller on a planet with a given ratio."""

    def drive(n: float) -> Epicyclic:
        return Epicyclic(planet_ratio=ratio, fixed=fixed, n_rpm=n)

    return machine(target, wheel, drive, 1, natural_deg(wheel))


def driven(target: Target, wheel: Gearing) -> Iterator[Family]:
    """Changes of the plain crank's motion: a drive in front of it, or the angle of the shafts."""
    natural = natural_deg(wheel)
    has_one = target.rollers in (None, 1)
    motion = closed_span(allowed_motions(target, 1, natural), 1) if has_one else None
    if motion is not None and not (motion.exact and allows(motion, natural)):
        plain_too = 0.0 if allows(motion, natural) else math.nan
        limits = AllowedSpan(-closed.PARAMETER_MAX, closed.PARAMETER_MAX)
        for make, parameter in ((side_crank, closed.side_crank), (gears, closed.eccentricity)):
            span = AllowedSpan(*(parameter(natural, x) for x in motion)).within(limits)
            if not span.empty:
                yield Family(partial(make, target, wheel), *span, known=plain_too, plain=0.0)
    if "axes_deg" in wheel.as_dict():
        yield from _inclined(target, wheel)


def _inclined(target: Target, wheel: Gearing) -> Iterator[Family]:
    """Plain cranks on shafts that are not at right angles."""
    z = wheel.z
    least = 2.0 * half_motion_deg(1.0, 1, z)
    for m in [target.rollers] if target.rollers else range(1, rollers_max(least) + 1):
        free = closed_span(allowed_motions(target, m, 180.0), m)
        if free is None or (free.exact and allows(free, 180.0)):
            continue
        span = AllowedSpan(*(closed.axes(z, x) for x in free)).within(closed.AXES)
        if not span.empty:
            right = 90.0 if allows(free, 180.0) else math.nan
            yield Family(partial(_on_axes, target, wheel, m), *span, known=right, plain=90.0)


def _on_axes(target: Target, wheel: Gearing, m: int, axes: float) -> Spec:
    """A plain crank on shafts at a given angle, degrees."""
    inclined, motion = wheel.with_key("axes_deg", axes), closed.axes_motion(wheel.z, axes)
    return machine(target, inclined, lambda n: Crank(n_rpm=n, rollers=m), m, motion)


def side_crank(target: Target, wheel: Gearing, A: float) -> Spec:
    """A side-crank in front of a wheel, with one roller."""
    motion = closed.side_crank_motion(natural_deg(wheel), A)
    return machine(target, wheel, lambda n: SideCrank(A=A, n_rpm=n), 1, motion)


def gears(target: Target, wheel: Gearing, e: float) -> Spec:
    """Elliptical gears in front of a wheel, in the phase given by the sign of e.

    Their axes are as far apart as the wheel's and the crank's: gears grow with the machine.
    """
    size, phase = closed.phased(e)
    distance = center_distance_mm(target) or EllipticalGears.gear_distance_mm

    def drive(n: float) -> EllipticalGears:
        return EllipticalGears(eccentricity=size, phase=phase, gear_distance_mm=distance, n_rpm=n)

    return machine(target, wheel, drive, 1, closed.gears_motion(natural_deg(wheel), e))
