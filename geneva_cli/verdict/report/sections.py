"""The sections of a report: one line each, in the order shown.

A line says too whether its section makes the parts of the machine, or turns them, which may take
seconds: whoever wants only what is quick leaves it out.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

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


class Section(NamedTuple):
    """A part of the report: its values by their names, and whether it makes parts for them."""

    values: Callable[[Proof], Values]
    makes_parts: bool = False


SECTIONS = (
    Section(inputs.inputs),
    Section(stations.stations),
    Section(loads.greatest),
    Section(cycle.cycle),
    Section(shocks.shocks),
    Section(slot.driven),
    Section(vibration.vibration),
    Section(sizes.sizes),
    Section(parts.parts, makes_parts=True),
    Section(parts_list.listed, makes_parts=True),
    Section(tolerances.tolerances, makes_parts=True),
    Section(strength.strong),
)
