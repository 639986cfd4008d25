"""Quantities of many designs as arrays, by the names that they have in a report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.analysis.peaks_many import QUANTITIES, worst_of_many
from geneva_cli.analysis.timing import timings
from geneva_cli.machine.engagement import Motion
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.spec.load_named import load_named

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
# What tells whether a quantity that is not of the motion is one of its own, and what has these:
# they are imported where one is asked for.
OTHERS = {
    "study.sweep.load_columns:is_load": "study.sweep.load_columns:load_columns",
    "study.sweep.part_columns:is_known": "study.sweep.part_columns:part_columns",
}
ENDS = {"acceleration": 2, "jerk": 3}  # derivatives of the wheel's angle


def in_arrays(names: Sequence[str]) -> bool:
    """Whether all these quantities can be worked out for arrays of designs.

    >>> in_arrays(["timing.dwell_s", "jerk.max"]), in_arrays(["sizes.ratio"])
    (True, False)
    """
    return all(
        is_motion(name) or any(load_named(known)(name) for known in OTHERS) for name in names
    )


def is_motion(name: str) -> bool:
    """Whether a quantity follows from the wheel's motion alone."""
    return _group(name) in ("timing", *QUANTITIES)


def _group(name: str) -> str:
    return name.partition(".")[0]


def columns(machine: Mechanism, names: Sequence[str], count: int) -> list[Array] | None:
    """Quantities of ``count`` designs in one machine, (count,) each; None if one is unknown.

    A value is infinite where nothing bounds it, and NaN where the design must be built alone.
    """
    found, out = known_columns(machine, names), []
    for name in names:
        value = found.get(name)
        if value is None:
            return None
        out.append(np.broadcast_to(np.reshape(value, -1), (count,)))
    return out


def known_columns(machine: Mechanism, names: Sequence[str]) -> Columns:
    """Those of the quantities that the designs in one machine have, (m,) each, or one number."""
    groups = dict.fromkeys(_group(name) for name in names)
    found: Columns = {}
    if "timing" in groups:
        found |= _timing(machine)
    sought = [name for name in QUANTITIES if name in groups]
    if sought:
        found |= _peaks(machine, sought)
    for known, of in OTHERS.items():
        others = [name for name in names if not is_motion(name) and load_named(known)(name)]
        if others:
            found |= load_named(of)(machine, others)
    return found


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
