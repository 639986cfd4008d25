"""Quantities of many designs as arrays, by the names that they have in a report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import numpy as np

from geneva_cli.analysis.loads.cycle import Cycle
from geneva_cli.analysis.loads.loads import kinetic_power_W
from geneva_cli.analysis.loads.many import greatest_of_many, summaries_of_many
from geneva_cli.analysis.loads.means_many import means_of_many
from geneva_cli.analysis.loads.quantities import known_quantities
from geneva_cli.analysis.loads.summary import SHOWN, shares
from geneva_cli.analysis.peaks_many import QUANTITIES, worst_of_many
from geneva_cli.analysis.timing import timings
from geneva_cli.machine.engagement import Motion
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.study.sweep.part_columns import is_known, part_columns

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Number

Columns: TypeAlias = "dict[str, Array | float | None]"

# Of each peak: the power of the input's speed that makes a rate of its invariant, and the rate.
RATES = {
    "velocity": (1, "rad_s"),
    "acceleration": (2, "rad_s2"),
    "jerk": (3, "rad_s3"),
    "power": (3, "rad2_s3"),
}
# loads of which the report has the greatest size, and their names in the cycle
SIZED = {
    "torque_Nm": "wheel_torque_Nm",
    "pin_force_N": "pin_force_N",
    "input_torque_Nm": "input_torque_Nm",
    "contact_stress_MPa": "contact_stress_MPa",
}
SUMMED = ("min", "min_at_deg", "mean", "rms")  # of each quantity of the cycle
KINETIC = "loads.kinetic_power_W"
ENDS = {"acceleration": 2, "jerk": 3}  # derivatives of the wheel's angle


def in_arrays(names: Sequence[str]) -> bool:
    """Whether all these quantities can be worked out for arrays of designs.

    >>> in_arrays(["timing.dwell_s", "jerk.max"]), in_arrays(["sizes.ratio"])
    (True, False)
    """
    return all(
        _group(name) in ("timing", *QUANTITIES) or _is_load(name) or is_known(name)
        for name in names
    )


def _is_load(name: str) -> bool:
    table, _, rest = name.partition(".")
    quantity, _, told = rest.rpartition(".")
    sized = quantity in SIZED and told in ("max", "at_deg")
    return table == "loads" and (sized or (quantity in SHOWN and told in SUMMED) or name == KINETIC)


def _group(name: str) -> str:
    return name.partition(".")[0]


def columns(machine: Mechanism, names: Sequence[str], count: int) -> list[Array] | None:
    """Quantities of ``count`` designs in one machine, (count,) each; None if one is unknown.

    A value is infinite where nothing bounds it, and NaN where the design must be built alone.
    """
    groups = dict.fromkeys(_group(name) for name in names)
    found: Columns = {}
    if "timing" in groups:
        found |= _timing(machine)
    sought = [name for name in QUANTITIES if name in groups]
    if sought:
        found |= _peaks(machine, sought)
    if "loads" in groups:
        found |= _loads(machine, [name.split(".") for name in names if _group(name) == "loads"])
    found |= part_columns(machine, names)
    out = []
    for name in names:
        value = found.get(name)
        if value is None:
            return None
        out.append(np.broadcast_to(np.reshape(value, -1), (count,)))
    return out


def _loads(machine: Mechanism, asked: Sequence[Sequence[str]]) -> Columns:
    """The loads that are asked for and that all these designs have."""
    cycle = Cycle(machine)
    given = cycle.given
    loaded = np.ravel(given.inertia_Nm + given.resists_Nm > 0.0)
    lent = {n: source for n, (source, share, _) in shares(cycle).items() if share is not None}
    there = known_quantities(cycle)
    sized = dict.fromkeys(a[1] for a in asked if a[-1] in ("max", "at_deg"))
    sized = dict.fromkeys(q for q in sized if SIZED[q] in there)
    summed = dict.fromkeys(a[1] for a in asked if a[-1] in SUMMED)
    summed = dict.fromkeys(q for q in summed if lent.get(q, q) in there)
    # what no design of this machine has, as a contact stress without a width, is had at once
    values: Columns = {
        f"loads.{a[1]}.{a[-1]}": np.inf
        for a in asked
        if a[-1] in ("max", "at_deg") and SIZED[a[1]] not in there
    }
    if sized:
        greatest = greatest_of_many(machine, [SIZED[q] for q in sized])
        for q in sized:
            values[f"loads.{q}.max"], values[f"loads.{q}.at_deg"] = greatest[SIZED[q]]
    if summed:
        told = {a[-1] for a in asked} & {"mean", "rms"}
        ends = {a[-1] for a in asked if a[1] in summed} & (set(SUMMED) - {"mean", "rms"})
        sums = summaries_of_many if ends else means_of_many
        for q, one in sums(machine, list(summed), told).items():
            found = one._asdict()
            values |= {f"loads.{q}.{name}": found[name] for name in SUMMED if name in found}
    if ["loads", "kinetic_power_W"] in asked:
        power = worst_of_many(machine, ["power"])["power"].max
        kinetic: Any = kinetic_power_W(machine, cast("float", power[:, None]))
        values[KINETIC] = np.where(np.ravel(given.inertia_Nm) > 0.0, np.ravel(kinetic), np.nan)
    return {name: np.where(loaded, v, np.nan) for name, v in values.items() if v is not None}


def _timing(machine: Mechanism) -> Columns:
    """The timing of machines whose engagements are alike; nothing of others."""
    first, *others = timings(machine)
    return {} if others else {f"timing.{n}": v for n, v in first._asdict().items()}


def _peaks(machine: Mechanism, sought: Sequence[str]) -> Columns:
    w = omega(machine.spec.drive.n_rpm)
    values: Columns = {}
    for name, peak in worst_of_many(machine, sought).items():
        power, unit = RATES[name]
        rate = np.reshape(w**power, -1)
        values[f"{name}.max"] = peak.max
        values[f"{name}.at_deg"] = peak.at_deg
        values[f"{name}.max_{unit}"] = peak.max * rate
        if name in ENDS:
            entry, leaving = _ends(machine, ENDS[name])
            values[f"{name}.entry"], values[f"{name}.exit"] = entry, leaving
            values[f"{name}.entry_{unit}"] = entry * rate
    return values


def _ends(machine: Mechanism, order: int) -> list[Array]:
    """The greatest sizes of a derivative just after an entry, and just before an exit."""
    motions = [e.motion for e in machine.engagements]
    return [
        np.max(np.broadcast_arrays(*(_size(m, m.entry_deg, order) for m in motions)), axis=0),
        np.max(np.broadcast_arrays(*(_size(m, m.exit_deg, order) for m in motions)), axis=0),
    ]


def _size(motion: Motion, at_deg: Number, order: int) -> Array:
    return np.ravel(abs(motion(at_deg, order).arrays()[order]))
