"""What must be bought: the index-drive makers' form beside the exact cycle, motor and flywheel."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.analysis.cam_factors import CamFactors, cam_factors
from geneva_cli.analysis.loads.carried import inertia_kgm2, support_torque_Nm
from geneva_cli.analysis.loads.fluctuation import fluctuation_J, flywheel_kgm2
from geneva_cli.analysis.loads.makers_form import Load, MakersForm, makers_form
from geneva_cli.analysis.loads.means import DRIVEN, TORQUE, means_of
from geneva_cli.analysis.loads.quantities import KINETIC, ends_of, ends_of_each
from geneva_cli.analysis.peaks import velocity_peak

if TYPE_CHECKING:
    from geneva_cli.analysis.loads.cycle import Cycle
    from geneva_cli.spec.tables import Motor


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
    mechanism, spec = cycle.mechanism, cycle.mechanism.spec
    friction, w = support_torque_Nm(spec), cycle.given.speed_rad_s
    load = Load(inertia_kgm2(spec), friction, spec.load.torque_Nm, spec.motor.service_factor)
    best: tuple[MakersForm, CamFactors] | None = None
    for number, engagement in enumerate(mechanism.engagements):
        step, motion = mechanism.index_deg(number), engagement.motion_deg
        closed_peak = engagement.motion.closed_peak
        velocity, acceleration, power = (
            found.size
            if (found := closed_peak(invariant))
            else _greatest(cycle, quantity, number) / unit
            for invariant, quantity, unit in (
                ("velocity", "omega_rad_s", w),
                ("acceleration", "alpha_rad_s2", w * w),
                ("power", KINETIC, w * w * w),
            )
        )
        factors = cam_factors(velocity, acceleration, power, motion, step)
        form = makers_form(factors, step, motion, spec.drive.n_rpm, load)
        if best is None or (form.Tc, form.alpha) > (best[0].Tc, best[0].alpha):
            best = form, factors
    assert best is not None  # a machine has engagements
    form, factors = best
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
        own = motor.inertia_kgm2 * motor.gear_ratio**2
        out |= {"flywheel_kgm2": whole, "flywheel_to_add_kgm2": max(whole - own, 0.0)}
    # The reducer takes its share where it drives and where it is driven. At constant speed the
    # rotor's own inertia takes no torque.
    eta, ratio = motor.gear_efficiency, motor.gear_ratio
    returned = means[DRIVEN].square
    spent = max(means[TORQUE].square - returned, 0.0)
    out["motor_torque_max_Nm"] = max(torque.max / eta, -torque.min * eta) / ratio
    out["motor_torque_rms_Nm"] = math.sqrt(spent / eta**2 + returned * eta**2) / ratio
    size = max(torque.max, -torque.min)
    if form_torque and size:
        out["input_torque_ratio"] = form_torque / size
    return out, []


def _inertias(cycle: Cycle, motor: Motor) -> dict[str, float | None]:
    """What the motor feels of the wheel's inertia where it turns fastest, against its own.

    Left to coast without losses, I_input w²/2 + I psi1² w²/2 stays: w = w0/sqrt(1 + mu psi1²).
    """
    if not motor.inertia_kgm2:
        return {}
    fastest = max(velocity_peak(engagement).max for engagement in cycle.mechanism.engagements)
    felt = inertia_kgm2(cycle.mechanism.spec) * (fastest / motor.gear_ratio) ** 2
    mu = felt / motor.inertia_kgm2
    return {"inertia_ratio": mu, "coasting_speed_share": 1.0 / math.sqrt(1.0 + mu)}
