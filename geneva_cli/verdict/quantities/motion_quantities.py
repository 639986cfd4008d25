"""Timing and peaks of designs, and motion of their products."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geneva_cli.loads.product import product_motion
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.many import worst_peaks
from geneva_cli.motion.peak_search import QUANTITIES, PeakArray
from geneva_cli.motion.timing import Timing, timings
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import Array, Number
from geneva_cli.verdict.quantities.groups import Columns, Designs
from geneva_cli.verdict.quantities.quantity_rows import RATES

ENDS = ("entry", "exit")  # how the names begin of quantities at the ends of a motion


def timing(of: Designs) -> Columns:
    """The timing that is equal in all engagements; infinite for values that differ."""
    return shared_timing(timings(of.machine))


def shared_timing(each: Sequence[Timing]) -> dict[str, Array | None]:
    """The timing that is equal in some engagements; infinite for values that differ.

    The work coefficient k_r of one roller is phi/(2 pi - phi), for a motion phi.
    """
    out = {name: _shared([getattr(one, name) for one in each]) for name in Timing._fields}
    motion = out["motion_deg"]
    assert motion is not None  # every engagement has one
    rest = np.where(motion < 360.0, 360.0 - motion, np.nan)
    return out | {"k_r": motion / rest}


def input_stop(of: Designs) -> Columns:
    """How the input stops in each dwell, and what the rotor's inertia asks of brake and start.

    The roller is out of its slot meanwhile, so that the wheel and its load are at rest. There are
    no torques and no energy without the rotor's inertia, and no torque of an abrupt stop.
    """
    drive, motor = of.spec.drive, of.spec.motor
    w, stops = omega(drive.n_rpm), len(of.machine.engagements)  # in a period
    cycle_s = of.machine.lasting_deg / (6.0 * drive.n_rpm * stops)  # on average
    inertia = _positive(motor.inertia_kgm2 * motor.ratio**2)
    brake_deg, start_deg = drive.brake_and_start_deg
    energy = 0.5 * inertia * w * w
    values: dict[str, Number] = {
        "stands_s": drive.stands_s,
        "brake_deg": brake_deg,
        "start_deg": start_deg,
        "inertia_kgm2": inertia,
        "brake_torque_Nm": inertia * w / _positive(drive.brake_s),
        "start_torque_Nm": inertia * w / _positive(drive.start_s),
        "energy_J": energy,
        "power_W": energy / cycle_s,
    }
    stopped = 0.0 * _positive(drive.stop_s)
    return {name: np.ravel(value + stopped) for name, value in values.items()}


def _positive(value: Number) -> Array:
    """A number, NaN where it is not above 0."""
    return np.where(np.asarray(value) > 0.0, value, np.nan)


def _shared(values: Sequence[Number | None]) -> Array | None:
    """A value that is equal in all engagements, infinite where it differs; None if one lacks it."""
    known = [value for value in values if value is not None]
    if len(known) < len(values):
        return None
    first, *others = np.broadcast_arrays(*map(np.ravel, known))
    # Rounding makes a value differ between engagements by up to 1e-12 of it.
    equal = [np.isclose(other, first, rtol=1e-12, atol=0.0) for other in others]
    return np.where(np.all(equal, axis=0), first, np.inf)


def peaks(of: Designs) -> Columns:
    """The greatest velocity, acceleration, jerk and power, their sizes at the ends, and the jumps.

    The jumps are those of the velocity, NaN for a roller that misses its slot's axis.
    """
    return peaks_among(of, of.machine.engagements)


def peaks_among(of: Designs, engagements: Sequence[Engagement]) -> dict[str, Number | None]:
    """The quantities of ``peaks`` among some engagements; None for rates in the other unit."""
    requested = {name: own for name in QUANTITIES if (own := of.requested(name))}
    # values at the ends need no search
    sought = [n for n, own in requested.items() if any(not x.startswith(ENDS) for x in own)]
    unknown = PeakArray(*np.full((2, 1), np.nan))
    found, output = worst_peaks(of.machine, sought, engagements), of.machine.output
    # one for each design
    w, per_radian = np.ravel(omega(of.spec.drive.n_rpm)), np.ravel(output.rate_per_radian)
    out: dict[str, Number | None] = {}
    for name in requested:
        most, at_deg = found.get(name, unknown)
        values: dict[str, Array] = {"max": most, "at_deg": at_deg}
        # the greatest jumps at an entry, and at an exit, with their signs; sizes of derivatives
        order = {"velocity": 1, "acceleration": 2, "jerk": 3}.get(name, 0)
        for k, end in enumerate(ENDS if order else ()):
            each = list[Number]()
            for one in engagements:
                at = one.motion(getattr(one, f"{end}_deg"), order).derivatives()[order]
                each.append(one.jumps[k] if order == 1 else abs(at))
            rows = np.stack(np.broadcast_arrays(*map(np.ravel, each)))
            i = abs(rows).argmax(axis=0)[None]
            values[end] = np.take_along_axis(rows, i, axis=0)[0]
        power, of_unit, unit = RATES[name]
        scale = w**power * per_radian**of_unit
        for value in ("max", "entry") if name == "acceleration" else ("max",):
            values[f"{value}_{output.rate_unit}{unit}"] = values[value] * scale
        out |= {f"{name}.{value}": row for value, row in values.items()}
    return out


def index_gained(of: Designs) -> Columns:
    """The wheel angle beyond its rest at which a roller as built leaves the rim, degrees."""
    built = of.machine.engagements[0].built  # all rollers leave alike
    return {"index_gained_deg": np.degrees(np.ravel(np.nan if built is None else built.gained))}


def product(of: Designs) -> Columns:
    """The product's motion; none without its place."""
    return product_motion(of.machine)
