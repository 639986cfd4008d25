"""Remedies for failing checks of a stop."""

from __future__ import annotations

from geneva_cli.verdict.changes import Change
from geneva_cli.verdict.remedies import BLUNTER, OTHER_LOCK, SMALLER

REMEDIES: dict[str, tuple[Change, ...]] = {
    **dict.fromkeys(("stop_turns", "stop_overlap_mm"), (*OTHER_LOCK, SMALLER)),
    "stop_stress_max_MPa": BLUNTER,
}
