"""Loads of many designs as arrays: greatest sizes, least values, means."""

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
from geneva_cli.analysis.peaks_many import worst_of_many
from geneva_cli.machine.mechanism import Mechanism

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array

Columns: TypeAlias = "dict[str, Array | float | None]"

# loads of which the report has the greatest size, and their names in the cycle
SIZED = {
    "torque_Nm": "wheel_torque_Nm",
    "pin_force_N": "pin_force_N",
    "input_torque_Nm": "input_torque_Nm",
    "contact_stress_MPa": "contact_stress_MPa",
}
SUMMED = ("min", "min_at_deg", "mean", "rms")  # of each quantity of the cycle
KINETIC = "loads.kinetic_power_W"


def is_load(name: str) -> bool:
    """Whether a quantity is one of these."""
    table, _, rest = name.partition(".")
    quantity, _, told = rest.rpartition(".")
    sized = quantity in SIZED and told in ("max", "at_deg")
    return table == "loads" and (sized or (quantity in SHOWN and told in SUMMED) or name == KINETIC)


def load_columns(machine: Mechanism, names: Sequence[str]) -> Columns:
    """The loads of these names that all these designs have."""
    asked = [name.split(".") for name in names]
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
