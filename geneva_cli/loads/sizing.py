"""Sizing of motor and flywheel: the cam-indexer formula, and the exact cycle."""

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.contact import QuantityValue
from geneva_cli.loads.instant import Instant, LoadQuantity
from geneva_cli.loads.load_case import inertia_kgm2, load_case, resisting_torques_Nm
from geneva_cli.loads.load_functions import LoadFunctions
from geneva_cli.loads.load_peaks import LoadSummary, load_peaks, load_summaries
from geneva_cli.motion.many import worst_peaks
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import motion_peaks
from geneva_cli.motion.timing import CamFactors, cam_factors
from geneva_cli.numerics.angles import DEGREE, omega, radians
from geneva_cli.numerics.arrays import Array, Number, array, parameter

# known without a load
KNOWN_UNLOADED = ("inertia_kgm2", "motor_rpm", "acceleration_rad_s2", "Am", "Vm", "Qm")
SUMS = ("energy_fluctuation_J", "flywheel_kgm2", "flywheel_to_add_kgm2", "motor_torque_rms_Nm")
FACTORS = ("velocity", "acceleration", "power")  # whose peaks give the factors of a motion
WHEEL_INERTIA = "wheel_inertia_kgm2"  # known from the parts, not from ``sizings``
# the keys without which a value is unknown
NEEDS = {
    "inertia_kgm2": "inertia_kgm2 in [load], or a [[mass]]",
    "friction_torque_Nm": "friction and radius_mm in [support]",
    "flywheel_kgm2": "speed_variation in [motor], and an input torque with a bound",
    "inertia_ratio": "inertia_kgm2 in [motor]",
    WHEEL_INERTIA: "a flat wheel that can be cut, and face_width_mm in [size]",
}


def sizing_needs(values: Mapping[str, float | None], lacks: Collection[str]) -> list[str]:
    """The keys that the missing values of a loaded design need; ``lacks`` are those of no use."""
    needs = list[str]()
    if values["motor_torque_max_Nm"] is None:
        needs.append("sizing: nothing bounds the input's torque, so no motor or flywheel suffices")
    unknown = [name for name in NEEDS if values[name] is None and name not in lacks]
    return needs + [f"{name}: needs {NEEDS[name]}" for name in unknown]


def sizings(mechanism: Mechanism, requested: Collection[str]) -> dict[str, Array]:
    """The ``requested`` values of ``sizing``, and perhaps more: (m,) or (1,); NaN if undefined."""
    whole, names = mechanism.under_load, set(requested)
    spec, case = whole.spec, load_case(whole)
    loaded, own = np.ravel(case.inertia_Nm + case.resists_Nm > 0.0), inertia_kgm2(spec)
    if not spec.is_loaded:
        names &= {*KNOWN_UNLOADED}
    values: dict[str, Number] = {
        "inertia_kgm2": _some(own),
        "motor_rpm": spec.drive.n_rpm * spec.motor.ratio,
        **_by_formula(whole),
    }
    if names & {*SUMS, "motor_torque_max_Nm"}:
        (torque,) = load_summaries(mechanism, ["input_torque_Nm"], bool(names & {*SUMS})).values()
        values |= _exact(whole, torque)
    if "inertia_ratio" in names:  # the wheel's inertia at its fastest over the motor's
        resting, others = whole.frame**2, max(0, spec.drive.wheels_on_carrier - 1)
        fastest = worst_peaks(whole, ["velocity"])["velocity"].max[:, None] + whole.frame
        turned = np.maximum(resting, fastest * fastest) + others * resting
        motor = _some(spec.motor.inertia_kgm2 * spec.motor.ratio**2)
        values["inertia_ratio"] = own * turned / motor
    return {
        name: np.ravel(row) if name in KNOWN_UNLOADED else np.where(loaded, np.ravel(row), np.nan)
        for name, row in values.items()
        if name not in whole.output.lacks
    }


def _some(x: Number) -> Array:
    """The number, with NaN in place of 0."""
    return np.where(np.asarray(x) > 0.0, x, np.nan)


def indexer_formula(
    factors: CamFactors,
    step_deg: float,
    motion_deg: float,
    n_rpm: float,
    load: tuple[float, float, float],
    service_factor: float,
) -> dict[str, float]:
    """The formula of cam-indexer makers for a wheel's step in an input angle at a speed.

    It assumes the greatest torque on the wheel during the whole motion, and the curve's factor Qm.
    ``load`` are the inertia, kg m², and the torques of friction and work, N m. The design torque
    counts the service factor, and so does the torque at the input.
    """
    t2, (inertia, friction, work) = motion_deg / (6.0 * n_rpm), load
    alpha = factors.Am * radians(step_deg) / (t2 * t2)
    total = inertia * alpha + friction + work
    design = service_factor * total
    return {
        "acceleration_rad_s2": alpha,
        "inertia_torque_Nm": inertia * alpha,
        "total_torque_Nm": total,
        "design_torque_Nm": design,
        "input_torque_Nm": step_deg / motion_deg * factors.Qm * design,
    }


def _by_formula(mechanism: Mechanism) -> dict[str, Number]:
    """The cam-indexer formula, for the engagement with the greatest torque at the input."""
    spec, fc = mechanism.spec, mechanism.spec.motor.service_factor
    work, friction = resisting_torques_Nm(spec)
    load, each = (inertia_kgm2(spec), friction, work), list[dict[str, float]]()
    for number, engagement in enumerate(mechanism.engagements):
        step, motion = spec.wheel.index_deg(number), engagement.motion_deg
        peaks = motion_peaks(engagement.motion, FACTORS)
        velocity, acceleration, power = (parameter(peaks[n].max[:, None]) for n in FACTORS)
        factors = cam_factors(velocity, acceleration, power, motion, step)
        row = factors._asdict() | indexer_formula(factors, step, motion, spec.drive.n_rpm, load, fc)
        # a carrier also turns the wheel's frame, whose torque need not be greatest there
        frame_Nm = abs(mechanism.frame) * fc * row["inertia_torque_Nm"]
        each.append(row | {"input_torque_Nm": row["input_torque_Nm"] + frame_Nm})
    best: dict[str, Number] = {**each[0]}
    for row in each[1:]:
        torque, most = (one["input_torque_Nm"] for one in (row, best))
        faster = row["acceleration_rad_s2"] > best["acceleration_rad_s2"]
        more = (torque > most) | ((torque == most) & faster)
        best = {name: np.where(more, row[name], best[name]) for name in row}
    losses = spec.load.efficiency * spec.motor.gear_efficiency
    return best | {
        "inertia_torque_Nm": _some(best["inertia_torque_Nm"]),
        "friction_torque_Nm": _some(friction),
        "power_W": omega(spec.drive.n_rpm) * best["input_torque_Nm"] / losses,
    }


def _exact(mechanism: Mechanism, torque: LoadSummary[Array]) -> dict[str, Number]:
    """Motor and flywheel from the exact cycle; NaN if the torque is unbounded."""
    motor, w = mechanism.spec.motor, omega(mechanism.spec.drive.n_rpm)
    eta, bounded = motor.gear_efficiency, np.isfinite(torque.max) & np.isfinite(torque.min)
    most, least = (np.where(bounded, x, np.nan)[:, None] for x in (torque.max, torque.min))
    driven = np.maximum(most / eta, -least * eta)
    out: dict[str, Number] = {"motor_torque_max_Nm": driven / motor.ratio}
    if torque.mean is None or torque.rms is None:
        return out
    square = np.where(bounded, torque.rms, np.nan) ** 2
    # A mean whose square is less than 1e-26 of the mean square is rounding, as for an inertia
    # alone.
    mean = np.where(torque.mean**2 > 1e-26 * square, torque.mean, 0.0 * square)
    # while the input runs, the mean torque is that of a period without its stops
    running = np.ravel(mechanism.lasting_deg / mechanism.period_deg)
    swing_J, back = fluctuations(mechanism, mean * running)
    energy = np.where(bounded, swing_J, np.nan)[:, None]
    # the part of the mean square where the wheel drives the input
    returned = (back / np.ravel(mechanism.lasting_deg * DEGREE))[:, None]
    spent = np.maximum(square[:, None] - returned, 0.0)
    out["energy_fluctuation_J"] = energy
    out["motor_torque_rms_Nm"] = np.sqrt(spent / eta**2 + returned * eta**2) / motor.ratio
    if motor.speed_variation is not None:
        whole = energy / (motor.speed_variation * w * w)
        out["flywheel_kgm2"] = whole
        # the motor has some inertia of its own, at the input shaft
        out["flywheel_to_add_kgm2"] = np.maximum(whole - motor.inertia_kgm2 * motor.ratio**2, 0.0)
    return out


class Unevenness(NamedTuple):
    """The input's torque less its mean, which is (m, 1)."""

    mean: Array

    def __call__(self, i: Instant) -> QuantityValue:
        """The quantity, and the margin that bounds it."""
        return QuantityValue(i.input_torque_Nm - self.mean, i.friction_margin)


def fluctuations(mechanism: Mechanism, mean: Array) -> tuple[Array, Array]:
    """The fluctuation of designs, from the means (m,) of their input torque: (m,) each.

    It is the greatest minus the least of the cumulated work less its mean line, J, and the integral
    over the period of the torque's square where the wheel drives. Motions are divided where the
    torque equals its mean. The mean of an unbounded torque must be infinite.
    """
    bounded = np.isfinite(mean)
    mean = np.where(bounded, mean, 0.0)[:, None]
    case, end, n = load_case(mechanism), None, len(mean)
    each, returned = [0.0 * mean], np.zeros(n)
    for engagement in mechanism.engagements:
        if end is not None:
            each.append(-mean * (engagement.mid_deg + engagement.entry_deg - end) * DEGREE)
        own: dict[str, LoadQuantity] = {"unevenness_Nm": Unevenness(mean)}
        load = LoadFunctions(engagement, case, own=own, more=("feeds", "wanted"))
        pieces = load.stretches()
        work, back = load.integrals(pieces, _work_and_returned, np.stack((bounded, bounded)))
        # a row for each design, padded with zeros
        number = np.arange(len(work)) - np.searchsorted(pieces.design, pieces.design)
        works = np.zeros((len(mean), int(number.max()) + 1))
        works[pieces.design, number] = np.where(bounded[pieces.design], work, 0.0)
        each.append(works)
        np.add.at(returned, pieces.design, back)
        end = engagement.mid_deg + engagement.exit_deg
    sums = np.cumsum(np.hstack(each), axis=1)
    energy = sums.max(axis=1) - sums.min(axis=1)
    return np.where(bounded, energy, np.inf), np.where(bounded, returned, np.inf)


def _work_and_returned(here: Instant, every: Sequence[LoadQuantity]) -> tuple[Array, Array]:
    """The input's torque less its mean, and the torque's square where the wheel drives."""
    back = array(0.5 * (1.0 - here.feeds) * here.input_torque_Nm.c[0])
    return array(every[0](here).value.c[0]), back * back


def kinetic_power_W(mechanism: Mechanism) -> Array:
    """Peak power that the inertia takes from the input, W, without friction: (m,)."""
    case = load_case(mechanism).lossless()._replace(resists_Nm=0.0)
    torque = load_peaks(mechanism, ("input_torque_Nm",), case=case)["input_torque_Nm"].max
    spec = mechanism.spec
    return torque * np.ravel(omega(spec.drive.n_rpm) / spec.load.efficiency)
