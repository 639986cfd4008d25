"""What the motion costs: pin force, torque on the input shaft, contact stress, power.

The wheel needs the torque T = I epsilon + M_r; the formulas are in ``forces``. Lengths in metres,
forces in newtons.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.analysis.loads.carried import inertia_kgm2
from geneva_cli.analysis.loads.contact import Contact, contact, is_straight
from geneva_cli.analysis.loads.forces import (
    Forces,
    Greatest,
    Row,
    Setting,
    pressed,
    setting,
    sliding,
)
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.pitch_curve import retraces
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.roots import greatest_at
from geneva_cli.spec.tables import Limits

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


class State(NamedTuple):
    """The loads at one input angle, or at an array of them.

    Force and stress are infinite where nothing bounds them: where friction alone holds the wheel,
    at mid-motion of a slot across the way, and where the bearing wall ends in an edge.
    """

    torque_Nm: Number  # that the wheel needs
    pin_force_N: Number
    input_torque_Nm: Number
    contact_stress_MPa: Number | None  # None without a face width
    pressure_deg: Number


def state(mechanism: Mechanism, engagement: Engagement, input_deg: Number) -> State:
    """An engagement's loads at an input angle from its mid-motion, or at an array of angles.

    Of m designs at k angles (m, k), at one (m, 1); without the m what is alike in all.
    """
    import numpy as np

    given = setting(mechanism)
    x = np.atleast_1d(np.asarray(input_deg, dtype=float))
    at = contact(engagement, x, reactions=False)
    torque = array(at.acceleration.c[0]) * given.inertia_Nm + given.resists_Nm
    drives = np.copysign(1.0, torque)
    slides = np.copysign(1.0, sliding(at, drives, given.radius).c[0])
    bound = np.where(torque == 0.0, 0.0, np.inf)
    with np.errstate(all="ignore"):
        found = Forces(given, at, drives, slides)
        held = found.grip.c[0] > 0.0
        force = np.where(held, found.force.c[0], bound)
        free = np.equal(given.friction, 0.0)
        rubbed = np.where(held | free, found.shaft.c[0], bound)
        shaft = rubbed / np.where(rubbed > 0.0, given.efficiency, 1.0)
        stress = None
        if found.edge is not None and found.square is not None:
            square = np.where(held & (found.edge.c[0] > 0.0), found.square.c[0], bound)
            stress = np.sqrt(square)
    pressure: Array = np.degrees(np.arctan2(np.abs(at.aside.c[0]), at.lever.c[0])) + 0.0 * x
    every = (torque, force, shaft, pressure)
    if isinstance(input_deg, (int, float)) and all(value.ndim < 2 for value in every):
        one = None if stress is None else float(stress[0])
        return State(float(torque[0]), float(force[0]), float(shaft[0]), one, float(pressure[0]))
    return State(torque, force, shaft, stress, pressure)


def greatest(mechanism: Mechanism, quantity: str) -> Greatest:
    """The greatest size of a field of ``State`` over all engagements."""
    return _over_all(mechanism, setting(mechanism), quantity)


def _over_all(mechanism: Mechanism, given: Setting, quantity: str) -> Greatest:
    found = [(0.0, 0.0)]
    for engagement in mechanism.engagements:
        size, at_deg = _greatest(engagement, given)[quantity]
        found.append((size, mechanism.shown_deg(engagement.mid_deg + at_deg)))
    return Greatest(*greatest_at(found))


@lru_cache(maxsize=256)
def _greatest(engagement: Engagement, given: Setting) -> dict[str, Greatest]:
    """The greatest of each field of ``State``, at the engagement's own input angles."""
    from geneva_cli.analysis.loads.peaks import maxima

    def rows(at: Contact[Jet], drives: Number, slides: Number, _: Number) -> list[Row[Jet]]:
        found = Forces(given, at, drives, slides)
        grip = found.grip if given.friction else None
        slope = at.aside / at.lever
        out = [
            Row(found.torque * drives),
            Row(found.force, found.grip),
            Row(found.shaft * (1.0 / given.efficiency), grip),
            Row(-found.shaft, grip),
            Row(slope * slope),
        ]
        if found.square is not None:
            out.append(Row(found.square, pressed(grip, found.edge)))
        return out

    torque, force, driving, driven, slope, *square = maxima(engagement, given, rows)
    pressure = Greatest(math.degrees(math.atan(math.sqrt(slope.max))), slope.at_deg)
    if not is_straight(engagement) and not retraces(engagement):
        pressure = Greatest(90.0, 0.0)
    stress = Greatest(math.sqrt(square[0].max), square[0].at_deg) if square else Greatest(0.0, 0.0)
    shafts = sorted((driving, driven), key=lambda found: found.at_deg)
    return {
        "torque_Nm": torque,
        "pin_force_N": force,
        "input_torque_Nm": Greatest(*greatest_at(shafts)),
        "contact_stress_MPa": stress,
        "pressure_deg": pressure,
    }


def fastest_rpm(mechanism: Mechanism) -> float | None:
    """The highest input speed at which the limits on force, torque and stress hold.

    Infinite where they hold at any speed, or where there are none; None where no speed keeps them.
    """
    limits = load_limits(mechanism.spec.limits)
    if not any(limits):
        return math.inf
    inertia = inertia_kgm2(mechanism.spec)
    given = setting(mechanism)._replace(inertia_Nm=inertia)  # at 1 rad/s
    least = max(_slowness(engagement, given, limits) for engagement in mechanism.engagements)
    rpm = math.sqrt(1.0 / least) / omega(1.0) if least > 0.0 else math.inf
    # Speeds below it may be too low where inertia helps against the resistance, and this one too.
    w = omega(mechanism.spec.drive.n_rpm if math.isinf(rpm) else rpm)
    tried = given._replace(inertia_Nm=inertia * w * w)
    kept = all(
        _over_all(mechanism, tried, quantity).max <= limit * KEPT
        for quantity, limit in zip(LIMITED, limits, strict=True)
        if limit
    )
    return rpm if kept else None


@lru_cache(maxsize=256)
def _slowness(
    engagement: Engagement, given: Setting, limits: tuple[float | None, float | None, float | None]
) -> float:
    """The greatest of 1 / (highest speed that a place allows)²; infinite where it allows none.

    With the load q (T) = q1 T, of a factor q1 that no speed changes, and T = w² I a + M, the
    limit holds up to w² = (limit - q1 M) / (q1 I a).
    """
    import numpy as np

    from geneva_cli.analysis.loads.peaks import maxima

    force_max, torque_max, stress_max = limits
    unit = given._replace(inertia_Nm=0.0, resists_Nm=1.0)

    def rows(at: Contact[Jet], drives: Number, slides: Number, _: Number) -> list[Row[Jet]]:
        found = Forces(unit, at, drives, slides)
        needed = at.acceleration * given.inertia_Nm
        held: list[tuple[float, Jet]] = []
        if force_max:
            held.append((force_max, found.force))
        if torque_max:
            held.append((torque_max, found.shaft * (1.0 / given.efficiency)))
            held.append((torque_max, -found.shaft))
        if stress_max and found.square is not None:
            held.append((stress_max * stress_max, found.square))
        out = []
        for limit, factor in held:
            load = needed * factor
            left = limit - factor * given.resists_Nm
            # Where it is not driven any speed keeps the limit: there is room, and as much as beside
            # it, for at rest the load's sign is rounding.
            over = (np.asarray(load.c[0]) <= 0.0) & (np.asarray(left.c[0]) < 0.0)
            out.append(Row(load / left, Jet([np.where(over, -c, c) for c in left.c])))
        return out

    still = given._replace(resists_Nm=0.0)
    return max(found.max for found in maxima(engagement, still, rows))


KEPT = 1.0 + 1e-9  # a limit met at the fastest speed may be missed by rounding
LIMITED = ("pin_force_N", "input_torque_Nm", "contact_stress_MPa")


def load_limits(limits: Limits) -> tuple[float | None, float | None, float | None]:
    """The limits on the quantities in ``LIMITED``."""
    return limits.pin_force_max_N, limits.input_torque_max_Nm, limits.contact_stress_max_MPa


def kinetic_power_W(mechanism: Mechanism, power_invariant: float) -> float:
    """Peak power that the inertia takes from the input: I epsilon omega / eta."""
    spec = mechanism.spec
    w = omega(spec.drive.n_rpm)
    return inertia_kgm2(spec) * power_invariant * w**3 / spec.load.efficiency
