"""Timing and peaks of designs, and motion of their products."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import numpy as np

from geneva_cli.loads.product import product_motion
from geneva_cli.motion.many import worst_peaks
from geneva_cli.motion.peak_search import QUANTITIES, PeakArray
from geneva_cli.motion.timing import timings
from geneva_cli.motion.wheels.gearing import Output
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import Array, N, Number
from geneva_cli.verdict.quantities.groups import Columns, Designs
from geneva_cli.verdict.quantities.quantity_rows import RATES

ENDS = ("entry", "exit")  # how the names begin of quantities at the ends of a motion


def timing(of: Designs) -> Columns:
    """The timing that is equal in all engagements; infinite for values that differ.

    The work coefficient k_r of one roller is phi/(2 pi - phi), for a motion phi.
    """
    each = timings(of.machine)
    out = {name: _shared([getattr(one, name) for one in each]) for name in each[0]._fields}
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
    requested = {name: own for name in QUANTITIES if (own := of.requested(name))}
    # values at the ends need no search
    sought = [n for n, own in requested.items() if any(not x.startswith(ENDS) for x in own)]
    found, unknown = worst_peaks(of.machine, sought), PeakArray(*np.full((2, 1), np.nan))
    w, output = np.ravel(omega(of.spec.drive.n_rpm)), of.machine.output
    flat = np.ravel(output.rate_per_radian)  # one for each design
    output = output._replace(rate_per_radian=cast("float", flat))
    out: dict[str, Number | None] = {}
    engagements = of.machine.engagements
    for name in requested:
        ends: list[Array] = []
        # the greatest jumps at an entry, and at an exit, with their signs; sizes of derivatives
        order = {"velocity": 1, "acceleration": 2, "jerk": 3}.get(name, 0)
        for k, end in enumerate(ENDS if order else ()):
            each = list[Number]()
            for one in engagements:
                at = one.motion(getattr(one, f"{end}_deg"), order).derivatives()[order]
                each.append(one.jumps[k] if order == 1 else abs(at))
            rows = np.stack(np.broadcast_arrays(*map(np.ravel, each)))
            i = abs(rows).argmax(axis=0)[None]
            ends.append(np.take_along_axis(rows, i, axis=0)[0])
        out |= peak_values(name, output, w, found.get(name, unknown), ends)
    return out


def peak_values(
    name: str, output: Output, w: N, peak: Sequence[N], ends: Sequence[N]
) -> dict[str, N | None]:
    """The quantities of a peak, by their whole names; None for rates in the other output's unit.

    ``w`` is the input's speed, ``peak`` the greatest size and its input angle, ``ends`` the sizes
    just after entry and just before exit, if requested.

    >>> from geneva_cli import Design, External
    >>> wheel = Design(External(6)).mechanism.output
    >>> peak_values("velocity", wheel, 2.0, (1.0, 0.0), ())["velocity.max_rad_s"]
    2.0
    """
    power, of_unit, end = RATES[name]
    scale = w**power * output.rate_per_radian**of_unit
    most, at_deg = peak
    out: dict[str, N | None] = {f"{name}.max": most, f"{name}.at_deg": at_deg}
    own = {unit: scale if unit == output.rate_unit else None for unit in ("rad", "m")}
    for unit, size in own.items():
        out[f"{name}.max_{unit}{end}"] = None if size is None else most * size
    if ends:
        out[f"{name}.entry"], out[f"{name}.exit"] = ends
    if name == "acceleration":
        for unit, size in own.items():
            out[f"{name}.entry_{unit}{end}"] = None if size is None else ends[0] * size
    return out


def index_gained(of: Designs) -> Columns:
    """The wheel angle beyond its rest at which a roller as built leaves the rim, degrees."""
    built = of.machine.engagements[0].built  # all rollers leave alike
    return {"index_gained_deg": np.degrees(np.ravel(np.nan if built is None else built.gained))}


def product(of: Designs) -> Columns:
    """The product's motion; none without its place."""
    return product_motion(of.machine)
