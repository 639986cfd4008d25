"""The sections of a report: one line each, in the order shown."""

from __future__ import annotations

from collections.abc import Callable

from geneva_cli.parts.proof import Proof
from geneva_cli.verdict.report import (
    cycle,
    inputs,
    loads,
    parts,
    parts_list,
    shocks,
    sizes,
    slot,
    stations,
    strength,
    tolerances,
    vibration,
)
from geneva_cli.verdict.report.values import Values

SECTIONS: tuple[Callable[[Proof], Values], ...] = (
    inputs.inputs,
    stations.stations,
    loads.greatest,
    cycle.cycle,
    shocks.shocks,
    slot.driven,
    vibration.vibration,
    sizes.sizes,
    parts.parts,
    parts_list.listed,
    tolerances.tolerances,
    strength.strong,
)
