"""Remedies for failing checks of a stop."""

from __future__ import annotations

from geneva_cli.verdict.remedies import BLUNTER, OTHER_LOCK

REMEDIES = {
    "stop_turns": f"{OTHER_LOCK} roller_radius_mm*0.2",
    "stop_overlap_mm": f"{OTHER_LOCK} roller_radius_mm*0.2",
    "stop_stress_max_MPa": BLUNTER,
}
