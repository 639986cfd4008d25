"""The parts that ``geneva profile`` writes."""

from __future__ import annotations

from geneva_cli.errors import GenevaError, nearest
from geneva_cli.mechanism import Mechanism
from geneva_cli.table import Table

PARTS = ("slot", "gears", "groove")
SAMPLES_MAX = 1_000_000


def part_table(mechanism: Mechanism, part: str, tolerance_mm: float, samples: int | None) -> Table:
    """A part's points: for a chord tolerance, or ``samples`` evenly in the input angle.

    Raises GenevaError for a part that is not known, or that the machine does not have.
    """
    if samples is not None and not 2 <= samples <= SAMPLES_MAX:
        raise GenevaError(f"--samples {samples}: must be at least 2, at most {SAMPLES_MAX}")
    if part == "slot":
        from geneva_cli.profile import profile_table

        return profile_table(mechanism, tolerance_mm, samples)
    if part == "gears":
        from geneva_cli.gears import gears_table

        return gears_table(mechanism, samples)
    if part == "groove":
        from geneva_cli.groove import groove_table

        return groove_table(mechanism, samples)
    raise GenevaError(f"--part {part}: it must be one of {', '.join(PARTS)}{nearest(part, PARTS)}")
