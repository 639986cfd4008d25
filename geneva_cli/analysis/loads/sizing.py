"""What must be bought: the index-drive makers' form beside the exact cycle, motor and flywheel."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.analysis.cam_factors import CamFactors, cam_factors
from geneva_cli.analysis.loads.carried import inertia_kgm2, support_torque_Nm
from geneva_cli.analysis.loads.fluctuation import fluctuation_J, flywheel_kgm2
from geneva_cli.analysis.loads.makers_form import MakersForm, ShaftLoad, makers_form
from geneva_cli.analysis.loads.means import DRIVEN, TORQUE, means_of
from geneva_cli.analysis.loads.quantities import KINETIC, ends_of, ends_of_each
from geneva_cli.analysis.peaks import velocity_peak
from geneva_cli.numerics.arrays import choose_record, larger, library

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geneva_cli.analysis.loads.cycle import Cycle
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.machine.spec import Spec
    from geneva_cli.numerics.arrays import N
    from geneva_cli.spec.tables import Motor


WHEEL = "wheel_inertia_kgm2"  # which parts know, and ``sizing`` does not


class Sizing(NamedTuple):
    """None where a value needs what is not given, or nothing bounds the input's torque."""

    inertia_kgm2: float | None = None  # of all that the wheel turns, at its shaft
    wheel_inertia_kgm2: float | None = None  # of the wheel itself, from its outline
    # the makers' form, of the engagement with the greatest torque at the input
    acceleration_rad_s2: float | None = None
    inertia_torque_Nm: float | None = None
    friction_torque_Nm: float | None = None  # of the support
    total_torque_Nm: float | None = None
    design_torque_Nm: float | None = None  # with the service factor
    input_torque_Nm: float | None = None
    power_W: float | None = None  # at the motor, losses of wheel and reducer included
    Am: float | None = None
    Vm: float | None = None
    Qm: float | None = None
    # of the exact cycle
    energy_fluctuation_J: float | None = None
    flywheel_kgm2: float | None = None  # in all, at the input shaft, for the speed variation
    motor_rpm: float | None = None
    motor_torque_max_Nm: float | None = None
    motor_torque_rms_Nm: float | None = None
    inertia_ratio: float | None = None  # greatest inertia that the motor feels, over its own
    flywheel_to_add_kgm2: float | None = None  # the same less the motor's own, seen at the input
    coasting_speed_share: float | None = None  # least speed without drive or losses, over greatest
    input_torque_ratio: float | None = None  # the form's over the exact cycle's greatest


def sizing(cycle: Cycle) -> tuple[dict[str, float | None], list[str]]:
    """The values of ``Sizing`` by their names, and what would give those that are None."""
    spec = cycle.mechanism.spec
    inertia = inertia_kgm2(spec) or None
    out = _form(cycle)._asdict()
    out |= {"inertia_kgm2": inertia, "motor_rpm": spec.drive.n_rpm * spec.motor.gear_ratio}
    if not cycle.is_loaded:
        return out, []
    exact, needs = _exact(cycle, out["input_torque_Nm"])
    out |= exact
    if inertia is None:
        needs.append("inertia_kgm2: needs inertia_kgm2 in [load], or a [[mass]]")
    if out["friction_torque_Nm"] is None:
        needs.append("friction_torque_Nm: needs friction and radius_mm in [support]")
    if spec.motor.speed_variation is None:
        needs.append("flywheel_kgm2, flywheel_to_add_kgm2: need speed_variation in [motor]")
    if not spec.motor.inertia_kgm2:
        needs.append("inertia_ratio, coasting_speed_share: need inertia_kgm2 in [motor]")
    return out, needs


def _form(cycle: Cycle) -> Sizing:
    """The makers' form, for the engagement with the greatest torque at the input."""
    spec, w = cycle.mechanism.spec, cycle.given.speed_rad_s
    friction = support_torque_Nm(spec)
    peaks = []
    for number, engagement in enumerate(cycle.mechanism.engagements):
        closed_peak = engagement.motion.closed_peak
        velocity, acceleration, power = (
            found.max
            if (found := closed_peak(invariant))
            else _greatest(cycle, quantity, number) / unit
            for invariant, quantity, unit in (
                ("velocity", "omega_rad_s", w),
                ("acceleration", "alpha_rad_s2", w * w),
                ("power", KINETIC, w * w * w),
            )
        )
        peaks.append((velocity, acceleration, power))
    form, factors = greatest_form(cycle.mechanism, peaks)
    out = Sizing(acceleration_rad_s2=form.alpha, **factors._asdict())
    if not cycle.is_loaded:
        return out
    lost = spec.load.efficiency * spec.motor.gear_efficiency
    return out._replace(
        inertia_torque_Nm=form.Ti or None,
        friction_torque_Nm=friction or None,
        total_torque_Nm=form.Tt,
        design_torque_Nm=form.Te,
        input_torque_Nm=form.Tc,
        power_W=w * form.Tc / lost,
    )


def greatest_form(
    mechanism: Mechanism, peaks: Sequence[tuple[float, float, float]]
) -> tuple[MakersForm, CamFactors]:
    """The makers' form with the greatest torque at the input, and its motion's factors.

    ``peaks`` are each engagement's greatest velocity, acceleration, and product of both, as
    invariants.
    """
    spec = mechanism.spec
    load = ShaftLoad(
        inertia_kgm2(spec),
        support_torque_Nm(spec),
        spec.load.torque_Nm,
        spec.motor.service_factor,
    )
    every = []
    for number, (engagement, peak) in enumerate(zip(mechanism.engagements, peaks, strict=True)):
        step, motion = mechanism.index_deg(number), engagement.motion_deg
        factors = cam_factors(*peak, motion, step)
        every.append((makers_form(factors, step, motion, spec.drive.n_rpm, load), factors))
    best, *others = every
    for other in others:
        (one, _), (two, _) = best, other
        more = (two.Tc > one.Tc) | ((two.Tc == one.Tc) & (two.alpha > one.alpha))
        best = choose_record(more, other, best)
    return best


def _greatest(cycle: Cycle, quantity: str, engagement: int) -> float:
    """The greatest size of a quantity over one of the motions."""
    found = ends_of_each(cycle, quantity)[engagement]
    return max(found.max, -found.min)


def _exact(cycle: Cycle, form_torque: float | None) -> tuple[dict[str, float | None], list[str]]:
    """What the exact cycle says of motor and flywheel; that nothing bounds it, where that is so."""
    motor, w = cycle.mechanism.spec.motor, cycle.given.speed_rad_s
    (torque,) = ends_of(cycle, TORQUE)
    means = means_of(cycle)
    out: dict[str, float | None] = _inertias(cycle, motor)
    if TORQUE not in means or not math.isfinite(means[TORQUE].square):
        return out, ["sizing: nothing bounds the input's torque, so no motor or flywheel suffices"]
    swing = fluctuation_J(cycle)
    out["energy_fluctuation_J"] = swing
    if motor.speed_variation is not None:
        whole = flywheel_kgm2(swing, motor.speed_variation, w)
        out |= {"flywheel_kgm2": whole, "flywheel_to_add_kgm2": flywheel_to_add_kgm2(motor, whole)}
    squares = means[TORQUE].square, means[DRIVEN].square
    out["motor_torque_max_Nm"] = greatest_motor_torque_Nm(motor, torque.max, torque.min)
    out["motor_torque_rms_Nm"] = rms_motor_torque_Nm(motor, *squares)
    size = max(torque.max, -torque.min)
    if form_torque and size:
        out["input_torque_ratio"] = form_torque / size
    return out, []


def greatest_motor_torque_Nm(motor: Motor, most: N, least: N) -> N:
    """Of the input's greatest and least torque that which is more at the motor.

    The reducer takes its share where it drives and where it is driven. At constant speed the
    rotor's own inertia takes no torque.
    """
    eta = motor.gear_efficiency
    return larger(most / eta, -least * eta) / motor.gear_ratio


def rms_motor_torque_Nm(motor: Motor, square: N, returned: N) -> N:
    """Of the means of the square of the input's torque, and of that where the wheel drives it."""
    eta = motor.gear_efficiency
    spent = larger(square - returned, 0.0 * square)
    mean = spent / eta**2 + returned * eta**2
    return library(mean).sqrt(mean) / motor.gear_ratio


def flywheel_to_add_kgm2(motor: Motor, whole: N) -> N:
    """What the flywheel in all needs besides the motor's own inertia, seen at the input."""
    left = whole - motor.inertia_kgm2 * motor.gear_ratio**2
    return larger(left, 0.0 * left)


def _inertias(cycle: Cycle, motor: Motor) -> dict[str, float | None]:
    if not motor.inertia_kgm2:
        return {}
    fastest = max(velocity_peak(engagement).max for engagement in cycle.mechanism.engagements)
    ratio, share = inertia_ratio(cycle.mechanism.spec, fastest)
    return {"inertia_ratio": ratio, "coasting_speed_share": share}


def inertia_ratio(spec: Spec, fastest: N) -> tuple[N, N]:
    """What the motor feels of the wheel's inertia where it turns fastest, against its own.

    ``fastest`` is the greatest velocity psi1. Left to coast without losses, I_input w²/2 +
    I psi1² w²/2 stays: w = w0/sqrt(1 + mu psi1²), which is the second number's w/w0.
    """
    turn = fastest / spec.motor.gear_ratio
    mu = inertia_kgm2(spec) * (turn * turn) / spec.motor.inertia_kgm2
    return mu, 1.0 / library(mu).sqrt(1.0 + mu)
