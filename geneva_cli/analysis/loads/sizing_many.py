"""What must be bought for many designs: the values of ``sizing`` for each.

>>> import numpy as np
>>> from geneva_cli import External, Load
>>> from geneva_cli.machine.many import many
>>> from geneva_cli.machine.spec import Spec
>>> spec = Spec(External(6), load=Load(inertia_kgm2=2.0, friction=0.1))
>>> found = many(spec, {"load.torque_Nm": np.array([0.0, 20.0])})
>>> sizings_of_many(found.machine, ["motor_torque_rms_Nm"])["motor_torque_rms_Nm"].round(4)
array([26.8019, 28.3356])
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, cast

import numpy as np

from geneva_cli.analysis.loads.carried import inertia_kgm2, support_torque_Nm
from geneva_cli.analysis.loads.fluctuation import NOUGHT, flywheel_kgm2
from geneva_cli.analysis.loads.fluctuation_many import swings_of_many
from geneva_cli.analysis.loads.forces import setting
from geneva_cli.analysis.loads.many import summaries_of_many
from geneva_cli.analysis.loads.means import TORQUE
from geneva_cli.analysis.loads.sizing import (
    flywheel_to_add_kgm2,
    greatest_form,
    greatest_motor_torque_Nm,
    inertia_ratio,
    rms_motor_torque_Nm,
)
from geneva_cli.analysis.peaks_many import peaks_of_many
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import parameter

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.numerics.jet import Array

CARRIED = ("inertia_kgm2", "motor_rpm")
FACTORS = ("acceleration_rad_s2", "Am", "Vm", "Qm")  # known without a load
FORM = (
    *("inertia_torque_Nm", "friction_torque_Nm", "total_torque_Nm", "design_torque_Nm"),
    *("input_torque_Nm", "power_W"),
)
SUMS = ("energy_fluctuation_J", "flywheel_kgm2", "flywheel_to_add_kgm2", "motor_torque_rms_Nm")
ENDS = ("motor_torque_max_Nm", "input_torque_ratio")
ROTOR = ("inertia_ratio", "coasting_speed_share")
# all but the wheel's own inertia, which is its outline's
NAMES = (*CARRIED, *FACTORS, *FORM, *SUMS, *ENDS, *ROTOR)


def sizings_of_many(mechanism: Mechanism, asked: Collection[str] = NAMES) -> dict[str, Array]:
    """Values of ``Sizing`` by their names, (m,) each, or (1,) of what is the same in all.

    NaN where a design has none. Those of ``NAMES`` that are asked for are among them.
    """
    spec, given, names = mechanism.spec, setting(mechanism), set(asked)
    loaded = np.ravel(given.inertia_Nm + given.resists_Nm > 0.0)
    found: dict[str, Number] = {}
    if names & set(CARRIED):
        rpm = spec.drive.n_rpm * spec.motor.gear_ratio
        found |= {"inertia_kgm2": _some(inertia_kgm2(spec)), "motor_rpm": rpm}
    if names & {*FACTORS, *FORM, "input_torque_ratio"}:
        found |= _form(mechanism)
    if names & {*SUMS, *ENDS}:
        found |= _exact(mechanism, names, found.get("input_torque_Nm"))
    if names & set(ROTOR):
        found |= _rotor(mechanism)
    known = (*CARRIED, *FACTORS)
    return {
        name: np.ravel(row) if name in known else np.where(loaded, np.ravel(row), np.nan)
        for name, row in found.items()
    }


def _some(x: Number) -> Array:
    """NaN for 0."""
    return np.where(np.asarray(x) > 0.0, x, np.nan)


def _peaks(mechanism: Mechanism, *names: str) -> list[tuple[float, ...]]:
    """Of each engagement the greatest of these quantities, (m, 1)."""
    every = [peaks_of_many(engagement.motion, names) for engagement in mechanism.engagements]
    return [tuple(parameter(one[name].max[:, None]) for name in names) for one in every]


def _form(mechanism: Mechanism) -> dict[str, Number]:
    """The makers' form, for the engagement with the greatest torque at the input."""
    spec, w = mechanism.spec, setting(mechanism).speed_rad_s
    peaks = _peaks(mechanism, "velocity", "acceleration", "power")
    form, factors = greatest_form(mechanism, cast("list[tuple[float, float, float]]", peaks))
    return {
        "acceleration_rad_s2": form.alpha,
        **factors._asdict(),
        "inertia_torque_Nm": _some(form.Ti),
        "friction_torque_Nm": _some(support_torque_Nm(spec)),
        "total_torque_Nm": form.Tt,
        "design_torque_Nm": form.Te,
        "input_torque_Nm": form.Tc,
        "power_W": w * form.Tc / (spec.load.efficiency * spec.motor.gear_efficiency),
    }


def _exact(
    mechanism: Mechanism, names: Collection[str], form_torque: Number | None
) -> dict[str, Number]:
    """What the exact cycle says of motor and flywheel; NaN where nothing bounds the torque."""
    motor, w = mechanism.spec.motor, setting(mechanism).speed_rad_s
    summed = bool(set(SUMS) & set(names))
    found = summaries_of_many(mechanism, [TORQUE], ("mean", "rms") if summed else ())[TORQUE]
    bounded = np.isfinite(found.max) & np.isfinite(found.min)
    most, least = (np.where(bounded, x, np.nan)[:, None] for x in (found.max, found.min))
    out: dict[str, Number] = {"motor_torque_max_Nm": greatest_motor_torque_Nm(motor, most, least)}
    if form_torque is not None:
        size = np.maximum(most, -least)
        out["input_torque_ratio"] = form_torque / _some(size)
    if found.mean is None or found.rms is None:
        return out
    square = np.where(bounded, found.rms, np.nan) ** 2
    # of inertia alone the mean is nothing but rounding
    mean = np.where(found.mean**2 > NOUGHT * square, found.mean, 0.0 * square)
    swings = swings_of_many(mechanism, mean)
    energy = np.where(bounded, swings.energy_J, np.nan)[:, None]
    returned = swings.returned / np.ravel(mechanism.period_deg * DEGREE)
    out["energy_fluctuation_J"] = energy
    out["motor_torque_rms_Nm"] = rms_motor_torque_Nm(motor, square[:, None], returned[:, None])
    if motor.speed_variation is not None:
        whole = flywheel_kgm2(parameter(energy), motor.speed_variation, w)
        out["flywheel_kgm2"] = whole
        out["flywheel_to_add_kgm2"] = flywheel_to_add_kgm2(motor, whole)
    return out


def _rotor(mechanism: Mechanism) -> dict[str, Number]:
    """The wheel's inertia against the motor's own, where that is known."""
    own = mechanism.spec.motor.inertia_kgm2
    peaks = np.broadcast_arrays(*[peak for (peak,) in _peaks(mechanism, "velocity")])
    with np.errstate(all="ignore"):
        ratio = inertia_ratio(mechanism.spec, cast("Array", np.max(peaks, axis=0)))
    known = np.asarray(own) > 0.0
    return {name: np.where(known, x, np.nan) for name, x in zip(ROTOR, ratio, strict=True)}
