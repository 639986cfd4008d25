"""The loads as they are printed: a table of the cycle, its summary, and the standard motor."""

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import Notice
from geneva_cli.loads.contact import PRESSED
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.load_case import multiples
from geneva_cli.loads.load_peaks import LoadSummary, reported_peaks
from geneva_cli.table import Reading, Table, computed_table, record_table, rows_table

Answers: TypeAlias = Mapping[str, "float | None"]
SHOWN_QUANTITIES = (
    *("omega_rad_s", "alpha_rad_s2", "wheel_torque_Nm", "pin_force_N", "contact_stress_MPa"),
    *("sliding_m_s", "input_torque_Nm", "power_W", "wheel_bearing_N", "crank_bearing_N"),
    # what only some machines have stands behind the columns that scripts count
    *("pv_W_m2", "rack_speed_m_s", "rack_acceleration_m_s2", "rack_force_N", "guide_force_N"),
    *("wheel_near_bearing_N", "wheel_far_bearing_N", "crank_near_bearing_N", "crank_far_bearing_N"),
)
# Rated outputs of motors, kW, by IEC 60072-1; 3 and 4 kW, common in catalogues, by EN 50347.
RATED_kW = (
    *(0.06, 0.09, 0.12, 0.18, 0.25, 0.37, 0.55, 0.75, 1.1, 1.5, 2.2, 3.0, 4.0, 5.5, 7.5, 11.0),
    *(15.0, 18.5, 22.0, 30.0, 37.0, 45.0, 55.0, 75.0, 90.0, 110.0, 132.0, 160.0, 200.0, 250.0),
)


@lru_cache(maxsize=16)
def summaries(cycle: Cycle) -> Mapping[str, LoadSummary[float | None]]:
    """The summary of each quantity, by its name; None for an unbounded or unknown value."""
    known, none = cycle.extremes, [None] * len(LoadSummary._fields)
    out = {name: LoadSummary(*map(_finite, known.get(name, none))) for name in SHOWN_QUANTITIES}
    for name, (most, at_deg) in reported_peaks(cycle.machine).items():
        if name in out:
            one = {"max": _finite(most.item()), "max_at_deg": at_deg.item()}
            out[name] = out[name]._replace(**one)
    return out


def _finite(x: float | None) -> float | None:
    return x if x is not None and math.isfinite(x) else None


def reversals_deg(cycle: Cycle) -> list[float]:
    """Input angles at which the wheel's torque changes sign and the roller changes walls."""
    out = []
    for (one, before), (two, after) in zip(cycle.stretches, cycle.stretches[1:], strict=False):
        if one is two and before.drives != after.drives:
            out.append(cycle.mechanism.shown_deg(one.mid_deg + before.end))
    return out


def loads_table(
    cycle: Cycle, answers: Mapping[str, Answers], last: Mapping[str, object], for_people: bool
) -> Table:
    """The summary of the loads, then the ``answers`` of impact, sizing and life, then the last."""
    spec = cycle.mechanism.spec
    values: dict[str, object] = {"spec": spec.path, "title": spec.title}
    loads = summaries(cycle)
    if for_people:
        rows = [(name, *one) for name, one in loads.items() if any(v is not None for v in one)]
        table = rows_table(("quantity", *LoadSummary._fields), rows, mixed=True)
        # in order of importance, for a narrow window
        first = ("quantity", "max", "rms", "max_at_deg", "min", "mean")
        title = "max and min over the motions; mean and rms over the whole period"
        values["loads"] = table.replaced(reading=Reading(first, title))
    else:
        for name, one in loads.items():
            values |= {f"{name}.{key}": value for key, value in one._asdict().items()}
    values["reversals_deg"] = tuple(reversals_deg(cycle)) if cycle.is_loaded else None
    for group, own in answers.items():
        # a roller that changes no side has no impact to be shown
        if not for_people or own.get("jump", 0.0) is not None:
            values |= {f"{group}.{key}": value for key, value in own.items()}
    return record_table(values | dict(last))


class RecommendedMotor(NamedTuple):
    """A motor: the power needed from it, and the standard power that is enough."""

    formula_W: float  # by the cam-indexer formula, with the service factor and both efficiencies
    peak_W: float  # greatest over the exact cycle, behind the reducer, without the service factor
    rpm: float
    input_torque_Nm: float  # by the cam-indexer formula, with the service factor
    needed_W: float  # the greater of both powers
    rated_kW: float | None  # the least standard power that is enough; None if none is


def recommended_motor(sizing: Answers) -> RecommendedMotor | None:
    """The motor for the values of ``sizing``; None without a load, or for an unbounded one."""
    names = ("power_W", "motor_torque_max_Nm", "motor_rpm", "input_torque_Nm")
    formula_W, torque, rpm, with_factor = (sizing[name] for name in names)
    if formula_W is None or torque is None or rpm is None or with_factor is None:
        return None
    peak_W = torque * rpm * math.tau / 60.0
    needed = max(formula_W, peak_W)
    rated = next((rated for rated in RATED_kW if 1e3 * rated >= needed), None)
    return RecommendedMotor(formula_W, peak_W, rpm, with_factor, needed, rated)


def no_load(cycle: Cycle) -> str:
    """What a cycle without a load needs."""
    return f"no force is known: set {cycle.mechanism.spec.output.load_keys}"


def missing(cycle: Cycle) -> list[Notice]:
    """Notes on the keys that the missing quantities need."""
    if not cycle.is_loaded:
        return [Notice("not-known", no_load(cycle))]
    wide = cycle.case.hertz is not None
    out = [] if wide else [f"{name}: needs face_width_mm in [size]" for name in PRESSED]
    spec, guide = cycle.mechanism.spec, "guide_force_N"
    key = spec.drive.length_key
    unset = key and vars(spec.drive)[key] is None
    if unset and spec.wheel.FLAT and guide not in cycle.sources:
        needs = f"needs {key} in [drive]"
        out.append(f"{guide}, and the share of it in the crank's bearings: {needs}")
    unknown: dict[str, list[str]] = {}
    for name, (_, factor, needs) in multiples(cycle.mechanism).items():
        if factor is None:
            unknown.setdefault(needs, []).append(name)
    for needs, names in unknown.items():
        out.append(f"{', '.join(names)}: need{'s' * (len(names) == 1)} {needs}")
    return [Notice("not-known", text) for text in out]


def cycle_table(cycle: Cycle, samples: int) -> Table:
    """``samples`` rows, evenly spaced in the input angle over one period from the first entry."""
    from geneva_cli.motion.motion_table import check_samples, derivatives, inputs, times_s

    check_samples(samples)
    machine = cycle.mechanism
    known = [name for name in SHOWN_QUANTITIES if name in cycle.sources]
    names = ("time_s", "input_deg", machine.output.column, *SHOWN_QUANTITIES)

    def rows(begin: int, end: int) -> list[Any]:
        input_deg = inputs(machine, samples, begin, end)
        loads = dict(zip(known, cycle.states(input_deg, known), strict=True))
        turned = derivatives(machine, input_deg, (0,))[0] * machine.output.per_radian
        out = [times_s(machine, input_deg), input_deg, turned]
        for name in SHOWN_QUANTITIES:
            column: Any = loads.get(name, [None] * len(input_deg))
            if name in loads and not np.isfinite(column).all():
                column = [*map(_finite, column.tolist())]
            out.append(column)
        return out

    return computed_table(names, samples, rows)
