"""The sizes of the horns of racks, for one machine or a batch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError
from geneva_cli.outlines.rack import rack_sizes
from geneva_cli.verdict.part_sizes import number_columns

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geneva_cli.machine.mechanism import Mechanism


def rack_horns(machines: Sequence[Mechanism]) -> tuple[float, float] | None:
    """Half the slot's width and the recess's radius of racks, (m, 1); None if none has a lock.

    They are NaN for a rack without a lock, and for one that cannot be cut.
    """
    columns = number_columns([_horn(machine) for machine in machines])
    return (columns[0], columns[1]) if columns else None


def _horn(machine: Mechanism) -> tuple[float, float] | None:
    try:
        sizes = rack_sizes(machine)
    except GenevaError:  # the check of the parts reports the error
        return None
    return (sizes.half_width, sizes.recess) if sizes.lock else None
