"""The horns of racks, between slot and recess."""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.linear.rack import rack_sizes
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.verdict.part_sizes import as_numbers, batched
from geneva_cli.verdict.quantities.designs import Designs
from geneva_cli.verdict.quantities.horns import Horns


def rack_horns(of: Designs) -> Horns:
    """Return the horns of racks; sizes are NaN for one without a lock, or that cannot be cut."""
    return Horns(of, batched([_horn(machine) for machine in of.each], as_numbers))


def _horn(machine: Mechanism) -> tuple[float, float] | None:
    try:
        sizes = rack_sizes(machine)
    except GenevaError:  # the check of the parts reports the error
        return None
    return (sizes.half_width, sizes.recess) if sizes.lock else None
