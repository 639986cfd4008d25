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
    "warnings",
)


def tolerances(proof: Proof) -> Values:
    """The first lines of ``geneva tolerance``, and its warnings; None without tolerances."""
    mechanism = proof.mechanism
    given = mechanism.spec.tolerance
    if given == Tolerance(distribution=given.distribution):
        return {f"tolerance.{name}": None for name in NAMES}
    from geneva_cli.verdict.tolerance.tables import tolerance_table

    # at some radius: micrometres are not among them
    L = mechanism.center_distance_mm
    answers = tolerance_table(mechanism, proof, SAMPLES, 0, L).to_dict()
    return {f"tolerance.{name}": answers[name] for name in NAMES}
