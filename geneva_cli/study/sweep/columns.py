"""The quantities of many designs at once, by the names that one design's report gives them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.analysis.loads.forces import setting
from geneva_cli.analysis.loads.many import LOADS, are_smooth, greatest_of_many
from geneva_cli.analysis.peaks_many import QUANTITIES, worst_of_many
from geneva_cli.analysis.timing import timings
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import omega

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

Columns: TypeAlias = "dict[str, Array | float | None]"

# Of each peak: the power of the input's speed that makes a rate of its invariant, and the rate.
RATES = {
    "velocity": (1, "rad_s"),
    "acceleration": (2, "rad_s2"),
    "jerk": (3, "rad_s3"),
    "power": (3, "rad2_s3"),
}
# what the report calls the loads whose greatest size it tells
SIZED = {name.removeprefix("wheel_"): name for name in LOADS}
ENDS = {"acceleration": 2, "jerk": 3}  # derivatives of the wheel's angle


def known(names: Sequence[str]) -> bool:
    """Whether all these quantities are had for arrays of designs.

    >>> known(["timing.dwell_s", "jerk.max"]), known(["sizes.ratio"])
    (True, False)
    """
    return all(_group(name) in ("timing", *QUANTITIES) or _load(name) for name in names)


def _load(name: str) -> str | None:
    """The load whose greatest size, or its place, is meant."""
    words = name.split(".")
    told = len(words) == 3 and words[0] == "loads" and words[2] in ("max", "at_deg")
    return SIZED.get(words[1]) if told else None


def _group(name: str) -> str:
    return name.partition(".")[0]


def columns(machine: Mechanism, names: Sequence[str], count: int) -> list[Array] | None:
    """The quantities of a machine of so many designs, (count,) each; None where one has none."""
    groups = dict.fromkeys(_group(name) for name in names)
    found: Columns = {}
    if "timing" in groups:
        found |= _timing(machine)
    sought = [name for name in QUANTITIES if name in groups]
    if sought:
        found |= _peaks(machine, sought)
    carried = list(dict.fromkeys(load for name in names if (load := _load(name))))
    if carried:
        found |= _loads(machine, carried)
    out = []
    for name in names:
        value = found.get(name)
        if value is None:
            return None
        out.append(np.broadcast_to(np.reshape(value, -1), (count,)))
    return out


def _loads(machine: Mechanism, carried: Sequence[str]) -> Columns:
    """Of straight slots without friction, and designs that all have a load."""
    given = setting(machine)
    if not (are_smooth(machine) and np.all(given.inertia_Nm + given.resists_Nm > 0.0)):
        return {}
    found = greatest_of_many(machine, carried)
    values: Columns = {}
    for short, name in SIZED.items():
        if name in found:
            values[f"loads.{short}.max"] = found[name].max
            values[f"loads.{short}.at_deg"] = found[name].at_deg
    return values


def _timing(machine: Mechanism) -> Columns:
    """Of machines whose engagements are alike: others have no one timing."""
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
            entry = _entry(machine, ENDS[name])
            values[f"{name}.entry"] = entry
            values[f"{name}.entry_{unit}"] = entry * rate
    return values


def _entry(machine: Mechanism, order: int) -> Array:
    """The greatest size of a derivative just after an entry."""
    motions = [e.motion for e in machine.engagements]
    found = [np.ravel(abs(m(m.entry_deg, order).arrays()[order])) for m in motions]
    greatest: Array = np.max(np.broadcast_arrays(*found), axis=0)
    return greatest
