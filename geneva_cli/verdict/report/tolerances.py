"""What the deviations of ``[tolerance]`` do to the wheel's place, play and entry."""

from __future__ import annotations

from geneva_cli.parts.proof import Proof
from geneva_cli.spec.tables import Tolerance
from geneva_cli.verdict.report.values import Values

SAMPLES = 65536
NAMES = (
    *(
        f"{place}.{angle}_deg"
        for place in ("dwell_position", "motion_play")
        for angle in ("worst", "rss", "p997")
    ),
    "entry_jump.mean",
    "entry_jump.worst",
    "entry_jump.mouth_worst",
    "clearances.slot_needed_mm",
    "clearances.lock_needed_mm",
    "clearances.turns",
)


def tolerances(proof: Proof) -> Values:
    """The first lines of ``geneva tolerance``; None without tolerances."""
    given = proof.mechanism.spec.tolerance
    if given == Tolerance(distribution=given.distribution):
        return {f"tolerance.{name}": None for name in NAMES}
    from geneva_cli.verdict.tolerance.tables import tolerance_table

    answers = tolerance_table(proof.mechanism, proof, SAMPLES, 0).to_dict()
    return {f"tolerance.{name}": answers[name] for name in NAMES}
